// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Inside the room: what the glTF files of a scanned face have in common, beside their skin's
// motion.
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

/// The skin at rest with its material, the first of the model.
tinygltf::Primitive skin_primitive(tinygltf::Model& model, GltfArrays& arrays, const SkinView& view,
                                   const simulate::Performance& performance, const io::Scan& scan);

/// The pockets of all openings for a skin at `points`, one after the other.
TriMesh pockets(const std::vector<Opening>& openings, const Points& points);

/// Dark pockets behind the openings: a part of the skin's mesh, as they go along with its poses.
/// Unlit, as on the page: no light falls into a mouth.
tinygltf::Primitive cavity_primitive(tinygltf::Model& model, GltfArrays& arrays,
                                     const std::vector<Opening>& openings, const TriMesh& mesh);

/// Morph targets of the pockets for those of the skin: `pocket_part` is the cavity_primitive() of
/// `openings`, and `at_rest` its points.
void add_pocket_targets(tinygltf::Primitive& pocket_part, GltfArrays& arrays,
                        const std::vector<Opening>& openings, const Points& skin_rest,
                        const Points& at_rest, const PoseTargets& targets);

/// Nodes eye_R and eye_L in the colours of the report's (web/src/replay/face/backing.ts), turned
/// about their centres.
void add_eyes(tinygltf::Model& model, GltfArrays& arrays, const std::vector<Eyeball>& eyeballs,
              FaceNodes& nodes);

/// Nodes upper_teeth and lower_teeth with crowns and gum.
void add_teeth(tinygltf::Model& model, GltfArrays& arrays, const anatomy::Teeth& teeth,
               FaceNodes& nodes);

/// Puts all nodes into one scene.
void end_face(tinygltf::Model& model);

}  // namespace hyperex::report
