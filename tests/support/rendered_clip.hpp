// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A short clip of a face that opens its mouth, drawn by this code, and what the face truly did.
#include "hyperex/sample/rendered_face.hpp"

namespace hyperex::test {

/// The embedded face, stretched to another person's proportions, 0.6 m before a pinhole camera with
/// depth (640 x 480). It is at rest for some frames, then opens and closes its mouth once and
/// turns, nods and shifts its head a little.
class RenderedClip : public sample::RenderedFace {
 public:
  static constexpr std::size_t kFrames = 24, kRestFrames = 6;
  static constexpr double kYawPeak_deg = 5, kNodPeak_deg = 3, kShift_m = 0.008;

  RenderedClip();
};

}  // namespace hyperex::test
