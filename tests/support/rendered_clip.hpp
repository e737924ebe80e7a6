// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A short rendered clip of a face that opens its mouth, and its true motion.
#include "hyperex/sample/rendered_face.hpp"

namespace hyperex::test {

/// The embedded face, stretched to another person's proportions, 0.6 m in front of a pinhole camera
/// with depth (640 x 480). It is at rest for some frames. Then it opens and closes its mouth once,
/// while the head turns, nods and shifts a little.
class RenderedClip : public sample::RenderedFace {
 public:
  static constexpr std::size_t kFrames = 24, kRestFrames = 6;
  static constexpr double kYawPeak_deg = 5, kNodPeak_deg = 3, kShift_m = 0.008;

  RenderedClip();
};

}  // namespace hyperex::test
