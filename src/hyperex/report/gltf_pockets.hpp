// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Internal to the room: the pockets behind the openings of a skin in glTF files.
#include <tiny_gltf.h>

#include <vector>

#include "hyperex/report/face_backing.hpp"
#include "hyperex/report/gltf_parts.hpp"

namespace hyperex::report {

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

}  // namespace hyperex::report
