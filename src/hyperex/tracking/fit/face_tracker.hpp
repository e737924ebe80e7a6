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
  /// Weights are for the canonical face with 468 vertices. For a model with fewer vertices they are
  /// increased in proportion.
  FitOptions fit;
  NeutralOptions neutral;
  LandmarkOptions network{.mirrored_too = true};
  /// >= 1: the person's shape is estimated from the first n frames that show a face. Of these, only
  /// the frames in which the face is at rest, as in the first of them, are used.
  int neutral_frames = 15;
  /// Largest root mean square motion of the network's points in a frame at rest.
  double at_rest_px = 0.5;
  bool use_depth = true;
};

/// Tracks one face from frame to frame: first by the landmark network, then by fitting the model.
/// The first frames that show a face are buffered until the person's shape is known; after that,
/// each frame is returned at once. A frame without a face and an invalid frame are returned as not
/// valid. The face is then detected again in the next frame.
class FaceTracker {
 public:
  /// `model` must outlive the tracker.
  FaceTracker(const expression::FaceModel& model, const capture::Intrinsics& camera,
              const TrackerOptions& options = {});
  ~FaceTracker();

  /// Processes the next frame and returns the finished ones in order. Before a face is found, this
  /// is one frame per call; while the shape is being estimated, none; then all buffered frames at
  /// once; after that, one per call.
  std::vector<TrackedFrame> feed(const capture::Frame& frame);
  /// To be called after the last frame; returns the frames that are still buffered.
  std::vector<TrackedFrame> finish();

  /// Nothing until the shape is known.
  const std::optional<Neutral>& neutral() const;
  const TrackerTimes& times() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hyperex::tracking
