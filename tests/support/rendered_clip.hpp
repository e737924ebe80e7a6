// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A short clip of a face that opens its mouth, drawn by this code, and what the face truly did.
#include <Eigen/Geometry>

#include "hyperex/capture/source.hpp"
#include "hyperex/tracking/fit/score.hpp"

namespace hyperex::test {

/// The embedded face, stretched to another person's proportions, 0.6 m before a pinhole camera with
/// depth (640 x 480). It is at rest for some frames, then opens and closes its mouth once and
/// turns, nods and shifts its head a little. Lips, the dark of the mouth and noise are drawn too.
///
/// The mouth does not move as the tracker's model has it. The jaw turns about an axis through the
/// condyles, a tenth of the face's width inwards from the outline beside the ears (as in
/// motion/embedded_motion.hpp). A vertex follows it by a smooth step of its height below the line
/// of the lips; the step is sharp between the lips and widens from their corners to the ears.
class RenderedClip : public capture::FrameSource {
 public:
  static constexpr std::size_t kFrames = 24, kRestFrames = 6;
  static constexpr double kJawPeak_deg = 12, kYawPeak_deg = 5, kNodPeak_deg = 3, kShift_m = 0.008;

  const capture::Intrinsics& intrinsics() const override;
  bool has_depth() const override { return true; }
  bool live() const override { return false; }
  std::optional<std::size_t> frame_count() const override { return kFrames; }
  std::optional<capture::Frame> next() override;

  /// Of all frames; jaw_open is the jaw's angle as a share of its peak.
  static tracking::Truth truth();

 private:
  std::size_t next_ = 0;
};

}  // namespace hyperex::test
