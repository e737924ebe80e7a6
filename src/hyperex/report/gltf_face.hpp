// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Internal to the room: parts common to all glTF files of a scanned face, apart from the motion of
// the skin.
#include <tiny_gltf.h>

#include <string>
#include <vector>

#include "hyperex/anatomy/teeth/teeth.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/report/face_backing.hpp"
#include "hyperex/report/gltf_parts.hpp"
#include "hyperex/report/skin_view.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::report {

/// Numbers of nodes; -1: none.
struct FaceNodes {
  int eye_R = -1, eye_L = -1, upper_teeth = -1, lower_teeth = -1;
};

/// A model with one node, "face", for mesh 0, which is still empty.
void begin_face(tinygltf::Model& model);

/// The skin at rest with its material, the first of the model. Without a texture or colours of the
/// scan it has those of complexion() in `tone`.
tinygltf::Primitive skin_primitive(tinygltf::Model& model, GltfArrays& arrays, const SkinView& view,
                                   const simulate::Performance& performance, const io::Scan& scan,
                                   face::SkinTone tone);

/// Colours of vertices as glTF's COLOR_0, from sRGB with 3 or 4 channels, the fourth of which is
/// not used; -1 where there are none.
int add_colours(
    GltfArrays& arrays,
    const Eigen::Matrix<std::uint8_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>& srgb);

/// A material that is no metal. `colour`: linear, RGBA.
tinygltf::Material plain_material(const char* name, std::vector<double> colour, double roughness);

/// Nodes eye_R and eye_L, which turn about their centres. `skin`: at rest; its lids shade the eyes
/// (light_on_eyes()), and that shade turns with them.
void add_eyes(tinygltf::Model& model, GltfArrays& arrays, const std::vector<Eyeball>& eyeballs,
              const TriMesh& skin, FaceNodes& nodes);

/// Nodes upper_teeth and lower_teeth with crowns and gum, the lower one with the tongue too.
/// `forward`: the direction in which the face looks; parts farther back are darker.
void add_teeth(tinygltf::Model& model, GltfArrays& arrays, const anatomy::Teeth& teeth,
               const Vec3& forward, FaceNodes& nodes);

/// Puts all nodes into one scene.
void end_face(tinygltf::Model& model);

}  // namespace hyperex::report
