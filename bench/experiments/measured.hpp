// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "experiments/setting.hpp"
#include "hyperex/metrics/surface_distance.hpp"

namespace hyperex::bench {

/// A part of the face, compared with the second scan and with the truth.
struct MeasuredRegion {
  std::string name;
  double moved_mm = 0, truth_moved_mm = 0;    ///< mean displacement
  metrics::DistanceStatistics closest;        ///< to the second scan, closest points
  metrics::DistanceStatistics corresponding;  ///< to the truth, same vertices
  double over_10_mm = 0;                      ///< share of vertices farther than 10 mm (closest)
};

/// One way to drive the face.
struct MeasuredWay {
  std::string name;
  /// Share below the chin point, of the face's vertices farther than 10 mm from the second scan.
  double over_below_chin = 0;
  std::vector<MeasuredRegion> regions;  ///< mouth, nose and cheeks, rest, whole face
};

struct MeasuredFace {
  std::string name;
  int vertices = 0, frames = 0, points = 0;  ///< of the skin; of the recording
  double peak_s = 0, largest_mm = 0;         ///< displacement at the peak
  double read_s = 0;                         ///< time taken to read and track the recording
  std::vector<MeasuredWay> ways;             ///< empty where there is no second scan
};

/// Experiment 1. Writes experiment_1_displacement.jpg and experiment_1_overlay.jpg.
std::vector<MeasuredFace> measured_deformation(const Setting& setting);

}  // namespace hyperex::bench
