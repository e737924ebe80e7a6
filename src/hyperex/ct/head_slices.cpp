// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/head_slices.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "hyperex/render/canvas.hpp"

namespace hyperex::ct {
namespace {

constexpr render::Colour kSkinLine{0.98, 0.75, 0.20}, kSkullLine{0.20, 0.85, 0.95},
    kMandibleLine{0.95, 0.35, 0.65};
constexpr double kPixelsPer_m = 2200, kMargin_m = 0.008;

/// How a slice across each axis of the face is seen.
struct SliceView {
  int right_axis, up_axis;
  const char* name;
  const char* letter;
  const char* seen;
};
constexpr std::array<SliceView, 3> kSliceViews = {{{2, 1, "sagittal", "x", "front at the right"},
                                                   {0, 2, "axial", "y", "from below"},
                                                   {0, 1, "coronal", "z", "from the front"}}};

/// In white, as the picture is dark.
render::Image with_sides(const render::Image& image) {
  render::Canvas canvas(image);
  render::TextStyle style{.size_px = 18, .colour = {1, 1, 1}, .bold = true};
  canvas.text(10, 24, "R", style);
  style.align = render::Align::right;
  canvas.text(image.width - 10, 24, "L", style);
  return canvas.image();
}

}  // namespace

HeadSlices::HeadSlices(const Volume& volume, const TriMesh& skin, const BoneSurfaces& bones)
    : volume_(volume),
      contours_{{skin, kSkinLine}},
      low_(skin.points.colwise().minCoeff().transpose()),
      high_(skin.points.colwise().maxCoeff().transpose()) {
  if (bones.skull.triangles.rows() > 0) contours_.push_back({bones.skull, kSkullLine});
  if (bones.mandible.triangles.rows() > 0) contours_.push_back({bones.mandible, kMandibleLine});
}

render::Image HeadSlices::picture(int axis, double place_m) const {
  const SliceView& view = kSliceViews[std::size_t(axis)];
  SlicePlane plane;
  plane.right = Vec3::Unit(view.right_axis), plane.up = Vec3::Unit(view.up_axis);
  plane.middle = middle_m();
  plane.middle[axis] = place_m;
  plane.width_m = high_[view.right_axis] - low_[view.right_axis] + 2 * kMargin_m;
  plane.height_m = high_[view.up_axis] - low_[view.up_axis] + 2 * kMargin_m;
  const render::Image slice = slice_picture(volume_, plane, contours_, kPixelsPer_m);
  return axis == 0 ? slice : with_sides(slice);
}

std::string HeadSlices::caption(int axis, double place_m) {
  const SliceView& view = kSliceViews[std::size_t(axis)];
  // Without a negative zero.
  return fmt::format("{}, {} = {:.0f} mm, {}", view.name, view.letter,
                     std::round(1e3 * place_m) + 0.0, view.seen);
}

}  // namespace hyperex::ct
