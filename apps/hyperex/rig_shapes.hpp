// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/rig/face_rig.hpp"

namespace hyperex::cli {

/// What there is to say of each shape behind its displacement: how far eyes turn, lips, recipes.
/// The shapes have ARKit's names.
std::vector<std::string> remarks_on_shapes(const rig::FaceRig& made,
                                           const std::vector<rig::Recipe>& recipes);

/// Prints the list of shapes. `remarks`: one for each. `bytes`: of `file`.
void print_shapes(const rig::FaceRig& made, const std::vector<std::string>& remarks,
                  const std::string& file, double bytes);

}  // namespace hyperex::cli
