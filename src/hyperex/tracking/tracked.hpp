// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Results of tracking, for code that displays or writes them: types only, without OpenCV.
#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::tracking {

/// A person's face at rest.
struct Neutral {
  Points points_m;        ///< |V| x 3, head frame
  double scale = 1;       ///< size of the person relative to the model
  Eigen::VectorXd shape;  ///< weights of the model's shape units
  bool metric = false;    ///< true: size from depth; false: from the stated distance of the eyes
};

/// Quality of the fit of a frame.
struct FitReport {
  double network_rms_px = 0;     ///< over the paired vertices
  double depth_rms_m = 0;        ///< over the vertices with depth
  double depth_share = 0;        ///< share of the vertices facing the camera that had depth
  double photometric_share = 0;  ///< share of the template's pixels that agree
};

/// The face in one frame.
struct TrackedFrame {
  std::size_t index = 0;  ///< in the source
  double time_s = 0;
  bool valid = false;
  std::string fault;  ///< why not valid
  Eigen::Isometry3d camera_from_head = Eigen::Isometry3d::Identity();
  Eigen::VectorXd weights;  ///< of the model's animation units; empty where not valid
  Points vertices_m;        ///< |V| x 3, head frame; empty where not valid
  FitReport report;
  double network_score = 0;
  int faces_in_view = 0;
};

/// Seconds spent, by stage, over the frames so far.
struct TrackerTimes {
  double network_s = 0, picture_s = 0, neutral_s = 0, fit_s = 0;
  std::size_t frames = 0;
};

/// A whole recording, tracked.
struct Tracking {
  std::vector<TrackedFrame> frames;
  std::optional<Neutral> neutral;
  TrackerTimes times;
};

}  // namespace hyperex::tracking
