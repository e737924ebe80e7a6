// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/render/camera.hpp"

namespace hyperex::render {

/// Letters that say where the subject's own sides lie in a picture: R and L at its upper corners,
/// and in profile, where both sides lie in one place, that of the side which is seen, in between.
struct SideMarks {
  std::string at_left = {}, in_middle = {}, at_right = {};  ///< of the picture; empty: none
};

/// `subjects_left`: the way from the subject's right to its left in the camera's world; of any
/// length > 0. The pages of the web folder mark their views by the same rule.
SideMarks side_marks(const Camera& camera, const Vec3& subjects_left = Vec3::UnitX());

}  // namespace hyperex::render
