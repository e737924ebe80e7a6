// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/render/camera.hpp"

namespace hyperex::render {

/// Letters that mark the subject's own sides in a picture: R and L at its upper corners. In
/// profile, where both sides lie behind each other, there is one letter in the middle: that of the
/// visible side.
struct SideMarks {
  std::string at_left = {}, in_middle = {}, at_right = {};  ///< of the picture; empty: none
};

/// `subjects_left`: direction from the subject's right to its left, in world coordinates; any
/// length > 0. The pages of the folder web use the same rule.
SideMarks side_marks(const Camera& camera, const Vec3& subjects_left = Vec3::UnitX());

}  // namespace hyperex::render
