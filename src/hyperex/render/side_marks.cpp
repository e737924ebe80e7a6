// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/render/side_marks.hpp"

namespace hyperex::render {

SideMarks side_marks(const Camera& camera, const Vec3& subjects_left) {
  // Share of the breadth of the face that the picture must show: within 20 degrees of the profile
  // there is no room for both letters.
  constexpr double least_breadth = 0.35;
  const Vec3 seen = camera.axes() * subjects_left.normalized();
  if (seen.x() >= least_breadth) return {.at_left = "R", .at_right = "L"};
  if (seen.x() <= -least_breadth) return {.at_left = "L", .at_right = "R"};
  return {.in_middle = seen.z() > 0 ? "L" : "R"};
}

}  // namespace hyperex::render
