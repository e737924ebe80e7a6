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

/// Pockets behind openings that share a material.
struct PocketGroup {
  std::vector<Opening> openings;
  TriMesh at_rest;  ///< all pockets, one after the other
  bool lit = true;
};

/// The pockets of the mouth, the nostrils and other holes, and those of the eyes; a group without
/// openings is left out. The light is part of their colours. The former are lit none the less:
/// programs that trace light let it through what is unlit, onto teeth and tongue. The latter are
/// unlit: lit, the corner beside an eyeball, where little light comes, would be black.
std::vector<PocketGroup> pocket_groups(const std::vector<Opening>& openings,
                                       const Points& skin_rest);

/// Appends the pockets as primitives of the skin's mesh, one for each group, because they move with
/// its poses.
void add_pockets(tinygltf::Model& model, GltfArrays& arrays, tinygltf::Mesh& skin,
                 const std::vector<PocketGroup>& groups);

/// Morph targets of the pockets for those of the skin. `skin`: after add_pockets(). `jaws`: the jaw
/// in each target; empty: it does not move.
void add_pocket_targets(tinygltf::Mesh& skin, GltfArrays& arrays,
                        const std::vector<PocketGroup>& groups, const Points& skin_rest,
                        const PoseTargets& targets, const std::vector<Eigen::Affine3d>& jaws);

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
