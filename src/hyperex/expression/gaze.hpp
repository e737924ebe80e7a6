// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::expression {

struct BlendShapes;

/// How an eye turns from looking straight ahead, radians.
struct Gaze {
  double up_rad = 0;
  double left_rad = 0;  ///< to the subject's left, for either eye; below 0: to the right
};

/// The subject's own right and left eye.
struct EyesGaze {
  Gaze right, left;
};

/// What gaze.csv and Python call the degrees of each eye: yaw (above 0: to the subject's left) and
/// pitch (above 0: up) of the right eye, then of the left.
inline constexpr std::array kGazeNames = {"eye_yaw_R_deg", "eye_pitch_R_deg", "eye_yaw_L_deg",
                                          "eye_pitch_L_deg"};
std::array<double, 4> degrees_of(const EyesGaze& gaze);

/// The rotation of an eye about its centre from looking along `ahead` (unit length, out of the
/// face): first up, then aside. `across`: a vector from the face's right to its left, of which the
/// part perpendicular to `ahead` counts; not parallel to `ahead`.
Eigen::Quaterniond turn_of(const Gaze& gaze, const Vec3& ahead, const Vec3& across);

/// Angles of an eye at weight 1 of ARKit's shapes, degrees. Apple states none. These are the slopes
/// of the angles over the weights in a take of Live Link Face, which records both (4,030 rows; 34.8
/// and 34.6 degrees aside, 35.0 down, 26.1 and 26.0 up). There, with all weights 0, each eye points
/// outwards by 3.7 degrees; here it looks ahead then.
inline constexpr double kLookAside_deg = 35, kLookDown_deg = 35, kLookUp_deg = 26;

/// Whether the shape turns an eye: eyeLook...
bool is_gaze(const std::string& shape);

/// How the shape turns the eye of its name at weight 1; nothing for a shape that turns none. "In"
/// is towards the nose (Apple, ARFaceAnchor.BlendShapeLocation).
std::optional<Gaze> gaze_of_shape(const std::string& shape);

/// At weight 1 eyeBlink lowers the upper lid kBlinkOfLookDown times as far as eyeLookDown does, and
/// eyeWide raises it kWideOfLookUp times as far as eyeLookUp does (data/canonical_units.csv, the
/// mean of its edge's three vertices).
inline constexpr double kBlinkOfLookDown = 1.04, kWideOfLookUp = 0.5;

/// The weights with which lids follow the gaze once. ARKit's eyeBlink and eyeWide often contain the
/// motion of the lids with the gaze: in a take of Live Link Face (4,030 rows) eyeBlink rises from 0
/// to 0.33 while eyeLookDown rises to 0.5. Then eyeLookDown counts only as far as it lowers the
/// upper lid by more than eyeBlink does, and eyeLookUp as far as it raises it by more than eyeWide.
/// For motion_of() alone: the eyes turn by the weights as recorded (gaze_of()).
BlendShapes with_lids_once(BlendShapes shapes);

/// The eyes over time.
struct GazeTrack {
  std::vector<double> time_s;  ///< at least one, strictly increasing
  std::vector<EyesGaze> gaze;  ///< one per time
  /// Linear between samples. Before the first and after the last, that sample.
  EyesGaze at(double t_s) const;
};

/// The track from `start_s` on, with a transition of `lead_s` (above 0) before it: at its beginning
/// the eyes look ahead, as those of a face at rest do, and they turn along motion::lead_course() to
/// where they look at `start_s`. Earlier samples are left out.
GazeTrack led_in(const GazeTrack& track, double start_s, double lead_s);

/// The gaze in a recording: by the angles of the eyes where it has them, otherwise by the weights
/// of the shapes eyeLook... Samples without a value are left out. Nothing where all of these are
/// 0 or missing: the recorder did not measure the gaze.
std::optional<GazeTrack> gaze_of(const BlendShapes& shapes);

}  // namespace hyperex::expression
