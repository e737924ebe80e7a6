// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/capture/frame.hpp"
#include "hyperex/tracking/fit/frame_fit.hpp"
#include "hyperex/tracking/fit/neutral.hpp"
#include "hyperex/tracking/network/landmark_tracker.hpp"

namespace hyperex::tracking {

struct TrackerOptions {
  /// Weights are stated for the canonical face's 468 vertices; those of a model with fewer vertices
  /// are raised in proportion.
  FitOptions fit;
  NeutralOptions neutral;
  LandmarkOptions network{.mirrored_too = true};
  /// >= 1: the person's shape is estimated from the first n frames with a face, from those of them
  /// in which it is at rest, as it is in the first.
  int neutral_frames = 15;
  double at_rest_px = 0.5;  ///< root mean square over the network's points
  bool use_depth = true;
};

/// Follows one face from frame to frame: the landmark network, then the model's fit. The first
/// frames with a face are held back until the person's shape is known from them; at other times
/// each frame is returned at once. A frame without a face, or an invalid one, is returned as not
/// valid, and the face is detected anew in the next.
class FaceTracker {
 public:
  /// `model` must outlive the tracker.
  FaceTracker(const expression::FaceModel& model, const capture::Intrinsics& camera,
              const TrackerOptions& options = {});
  ~FaceTracker();

  /// Takes the next frame; gives those that are finished, in order: one before there is
  /// a face, none while the shape is not known, then all that were held back, then one.
  std::vector<TrackedFrame> feed(const capture::Frame& frame);
  /// The source has ended: gives what is still held back.
  std::vector<TrackedFrame> finish();

  /// Nothing before the shape is known.
  const std::optional<Neutral>& neutral() const;
  const TrackerTimes& times() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hyperex::tracking
