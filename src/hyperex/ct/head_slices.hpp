// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/ct/label_surfaces.hpp"
#include "hyperex/ct/slice_picture.hpp"

namespace hyperex::ct {

/// Slices through a head across the axes of the face: 0 sagittal (the front at the right), 1 axial
/// (from below, as radiologists look), 2 coronal (from in front).
class HeadSlices {
 public:
  /// The slices hold references to all three. `skin` sets their extent.
  HeadSlices(const Volume& volume, const TriMesh& skin, const BoneSurfaces& bones);

  /// The skin's ends along an axis, m.
  double low_m(int axis) const { return low_[axis]; }
  double high_m(int axis) const { return high_[axis]; }
  Vec3 middle_m() const { return (low_ + high_) / 2; }

  /// The slice at a place along an axis, with the contours of skin, skull and mandible. The
  /// subject's sides are marked where they lie beside each other.
  render::Image picture(int axis, double place_m) const;
  /// "axial, y = 302 mm, from below".
  static std::string caption(int axis, double place_m);

 private:
  const Volume& volume_;
  std::vector<Contour> contours_;
  Vec3 low_, high_;
};

}  // namespace hyperex::ct
