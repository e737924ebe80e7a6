// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "hyperex/expression/face_model.hpp"
#include "hyperex/tracking/tracked.hpp"

namespace hyperex::report {

/// A head's turn out of the axes of a face (+x the subject's left, +y up, +z forward), degrees.
struct HeadTurn {
  double yaw_deg = 0;    ///< -180 to 180; positive: the face turns to the subject's own left
  double pitch_deg = 0;  ///< -90 to 90; positive: the face turns up
  double roll_deg = 0;   ///< -180 to 180; positive: the head tilts to the subject's left shoulder
};
/// R = R_y(yaw) R_x(-pitch) R_z(-roll).
HeadTurn head_turn(const Eigen::Matrix3d& rotation);

/// One number per frame; NaN where there is none.
struct TrackingChannel {
  std::string group;  ///< "turn", "shift", "distance", "unit" or "residual"
  std::string name;   ///< "yaw", "mouth opening", "jawOpen" ...
  std::string facs;   ///< of group "unit": "AU26"; may be empty
  std::string unit;   ///< "deg", "mm", "px", "%"; empty where a number is pure
  std::vector<double> values;
};

/// A tracking as curves over time.
struct TrackingCurves {
  /// Rows of tracking.frames that the curves have, N of them with strictly rising times: valid
  /// frames whose time rises and frames between them whose own time lies between theirs.
  std::vector<std::size_t> frames;
  std::vector<double> time_s;  ///< N, the source's clock
  int reference = -1;          ///< of `frames`, the first valid one; -1: none is
  std::vector<TrackingChannel> channels;
};

/// The curves, N values each:
///   turn      yaw, pitch, roll of T_0^-1 T_k (T = camera_from_head, 0 = the reference)
///   shift     left, up, forward: its translation, of the model's origin in the head's axes
///   distance  between landmarks of the frame, those that the model has: "mouth opening" (iBUG 62,
///             66, the lips' inner border), "mouth width" (cheilion R, L), "mouth corner's travel
///             L" and "R" from the person's face at rest, "eye opening L" and "R" (mean of two
///             pairs of points of the lids)
///   unit      weights of the model's animation units
///   residual  "network" (px), "depth" (mm; none where no vertex had depth), "depth seen", "skin
///             matched" (shares in %; none where nothing is compared, as in the first frame)
/// Throws std::invalid_argument where the tracking has no neutral face, or is not of this model.
TrackingCurves tracking_curves(const expression::FaceModel& model,
                               const tracking::Tracking& tracking);

}  // namespace hyperex::report
