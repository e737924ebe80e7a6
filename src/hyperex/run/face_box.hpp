// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/face/face_frame.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::run {

/// The box that a picture of the face must show, in the face frame: the landmarks and the skin
/// around them including the ears, but not the shoulders and the back of the head.
struct FaceBox {
  Vec3 low, high;
  bool holds(const Vec3& local) const {
    return (local.array() >= low.array()).all() && (local.array() <= high.array()).all();
  }
};

inline FaceBox face_box(const io::Landmarks& landmarks, const face::FaceFrame& frame) {
  const Vec3 beyond_low_m(0.04, 0.045, 0.06), beyond_high_m(0.04, 0.075, 0.02);
  FaceBox box{Vec3::Constant(1e9), Vec3::Constant(-1e9)};
  for (const auto& entry : landmarks) {
    box.low = box.low.cwiseMin(frame.local(entry.second));
    box.high = box.high.cwiseMax(frame.local(entry.second));
  }
  box.low -= beyond_low_m;
  box.high += beyond_high_m;
  return box;
}

/// The rows of `local` (face frame) that lie in the box.
inline Points points_within(const FaceBox& box, const Points& local) {
  Points kept(local.rows(), 3);
  Eigen::Index count = 0;
  for (Eigen::Index v = 0; v < local.rows(); ++v)
    if (box.holds(local.row(v))) kept.row(count++) = local.row(v);
  return kept.topRows(count);
}

}  // namespace hyperex::run
