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

/// What a recording's face truly did: a folder with truth_pose.csv (time_s, T00 ... T23:
/// camera_from_face), truth_landmarks68_camera_m.csv (time_s, x0, y0, z0 ...; metres, camera frame)
/// and truth_weights.csv (time_s and a column per shape, jawOpen among them).
struct Truth {
  std::vector<double> time_s;
  std::vector<Eigen::Isometry3d> camera_from_face;
  std::vector<Points68> landmarks_m;  ///< camera frame
  std::vector<double> jaw_open;       ///< empty where the shapes have no jawOpen
};
/// Throws InputError: a file missing or malformed, times that differ between the files.
Truth read_truth(const std::filesystem::path& folder);
/// Writes the three files: times and landmarks to a micrometre and a microsecond. Throws InputError
/// where they cannot be written.
void write_truth(const std::filesystem::path& folder, const Truth& truth);

struct Quantiles {
  double median = 0, p95 = 0;
};

/// How far a tracked motion is from the truth. All relative to the first frame that is valid
/// ("frame 0"), over the valid frames after it.
struct Score {
  std::size_t frames = 0;  ///< of the truth
  std::size_t lost = 0;    ///< not valid, or missing
  /// Head motion: the rotation angle and the length of the shift of (T_0^-1 T_k)^-1 M_k, T the true
  /// camera_from_face and M_k = T_0^-1 (P_k P_0^-1) T_0 the tracked motion P in its frame.
  Quantiles rotation_deg, translation_mm;
  /// Errors of the points 7 to 9 and 48 to 67, in the face's frame: |(e_k - e_0) - (t_k - t_0)|, e
  /// turned into the true face's axes by the poses of frame 0; over all points and frames.
  Quantiles deformation_mm;
  std::optional<double> jaw_correlation;  ///< none where the jaw does not move
  /// Over the frames in which neither head nor face truly moves (at least five): root mean square
  /// distance of these points, camera frame, from their mean.
  std::optional<double> rest_jitter_mm;
  /// deformation_mm's medians by point, in the order of score_points().
  std::vector<double> by_point_mm;
};

/// The points that the deformation is judged by: 7, 8, 9, 48 ... 67.
const std::vector<int>& score_points();

/// Frames are matched by time (to a millisecond).
Score score(const expression::FaceModel& model, const std::vector<TrackedFrame>& tracked,
            const Truth& truth);

}  // namespace hyperex::tracking
