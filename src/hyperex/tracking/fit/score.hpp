// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>
#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include "hyperex/tracking/fit/face_tracker.hpp"

namespace hyperex::tracking {

using Points68 = Eigen::Matrix<double, 68, 3, Eigen::RowMajor>;

/// The true motion of the face in a recording: a folder with truth_pose.csv (time_s, T00 ... T23:
/// camera_from_face), truth_landmarks68_camera_m.csv (time_s, x0, y0, z0 ...; metres, camera frame)
/// and truth_weights.csv (time_s and one column per shape, including jawOpen).
struct Truth {
  std::vector<double> time_s;
  std::vector<Eigen::Isometry3d> camera_from_face;
  std::vector<Points68> landmarks_m;  ///< camera frame
  std::vector<double> jaw_open;       ///< empty if the shapes do not include jawOpen
};
/// Throws InputError if a file is missing or malformed, or if the times differ between the files.
Truth read_truth(const std::filesystem::path& folder);
/// Writes the three files. Positions are rounded to a micrometre and times to a microsecond. Throws
/// InputError if they cannot be written.
void write_truth(const std::filesystem::path& folder, const Truth& truth);

struct Quantiles {
  double median = 0, p95 = 0;
};

/// The error of a tracked motion. All values are relative to the first valid frame ("frame 0") and
/// cover the valid frames after it.
struct Score {
  std::size_t frames = 0;  ///< number of true frames
  std::size_t lost = 0;    ///< number of frames that are not valid or missing
  /// Error of the head motion: rotation angle and length of the translation of (T_0^-1 T_k)^-1 M_k.
  /// T is the true camera_from_face, and M_k = T_0^-1 (P_k P_0^-1) T_0 is the tracked motion P in
  /// the frame of T.
  Quantiles rotation_deg, translation_mm;
  /// Errors of the points 7 to 9 and 48 to 67 in the face frame, over all points and frames: |(e_k
  /// - e_0) - (t_k - t_0)|. e is the tracked and t the true position; e is rotated to the axes of
  /// the true face by the poses of frame 0.
  Quantiles deformation_mm;
  std::optional<double> jaw_correlation;  ///< absent if the jaw does not move
  /// Root mean square distance of these points from their mean, camera frame, over the frames in
  /// which neither the true head nor the true face moves (at least five).
  std::optional<double> rest_jitter_mm;
  /// Medians of deformation_mm for each point, in the order of score_points().
  std::vector<double> by_point_mm;
};

/// The points for which the deformation error is computed: 7, 8, 9, 48 ... 67.
const std::vector<int>& score_points();

/// Frames are matched by time (to a millisecond).
Score score(const expression::FaceModel& model, const std::vector<TrackedFrame>& tracked,
            const Truth& truth);

}  // namespace hyperex::tracking
