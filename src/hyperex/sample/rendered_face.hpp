// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>
#include <vector>

#include "hyperex/capture/source.hpp"
#include "hyperex/sample/person.hpp"
#include "hyperex/tracking/fit/score.hpp"

namespace hyperex::sample {

/// A frame of a clip.
struct Moment {
  Pose pose;
  Eigen::Isometry3d camera_from_head;
};

struct ClipOptions {
  capture::Intrinsics camera;  ///< centred, fx = fy (colour_of)
  double rate_hz = 30;
  double depth_noise_m = 0.001;  ///< standard deviation of each reading
  double colour_noise = 2;       ///< standard deviation of each channel, of 255
};

/// A clip of a person as a colour and depth camera sees it, drawn by the renderer, and the true
/// motion. The noise depends on the frame's index alone, so that the clip is always the same.
class RenderedFace : public capture::FrameSource {
 public:
  RenderedFace(Person person, std::vector<Moment> moments, const ClipOptions& options);

  const capture::Intrinsics& intrinsics() const override { return options_.camera; }
  bool has_depth() const override { return true; }
  bool live() const override { return false; }
  std::optional<std::size_t> frame_count() const override { return moments_.size(); }
  std::optional<capture::Frame> next() override;

  /// The true values of all frames; jaw_open is the jaw's angle as a share of its peak.
  tracking::Truth truth() const;

 private:
  Person person_;
  std::vector<Moment> moments_;
  ClipOptions options_;
  std::size_t next_ = 0;
};

/// The head in front of a camera, upright and facing it at `distance_m`, then turned by `yaw_deg`
/// to its left and by `nod_deg` downwards, and moved by `right_m` and `back_m` in the camera's
/// frame.
struct HeadPlace {
  double distance_m = 0.6, yaw_deg = 0, nod_deg = 0, right_m = 0, back_m = 0;
};
Eigen::Isometry3d camera_from_head(const HeadPlace& place);

}  // namespace hyperex::sample
