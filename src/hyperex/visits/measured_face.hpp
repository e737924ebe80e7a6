// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/motion/motion.hpp"
#include "hyperex/motion/still_points.hpp"
#include "hyperex/session/cleaned_recording.hpp"
#include "hyperex/visits/measures.hpp"
#include "hyperex/visits/read_visits.hpp"

namespace hyperex::visits {

/// One recording, reduced to the face at rest and at the peak of the expression, with the errors of
/// both.
struct MeasuredFace {
  std::string file;  ///< its name without folders
  FaceState state;
  std::map<std::string, Vec3> rest, peak;  ///< all points that are measured, m, without head pose
  double peak_s = 0;                       ///< from the first sample
  double half_s = 0;  ///< when the movement first reaches half of that at the peak
  /// The corners of the mouth (right, left): distance from rest over time, mm; empty: not measured.
  std::vector<double> time_s;
  std::array<std::vector<double>, 2> corner_mm;
  double eye_distance_m = 0;  ///< between the outer corners of the eyes; NaN: not measured

  /// Standard deviation of a coordinate of each point after smoothing, m.
  ByFacePoint<double> rest_jitter_m, peak_jitter_m;
  bool jitter_known = false, head_known = false;
  double jitter_m = 0;  ///< before smoothing
  /// Error of the head's pose at the peak: covariance of a rotation (rad) about `centre` and a
  /// translation (m).
  Eigen::Matrix<double, 6, 6> pose_covariance = Eigen::Matrix<double, 6, 6>::Zero();
  Vec3 pose_centre = Vec3::Zero();
  /// Error of the axes: covariance of a small rotation, rad. 0 for the recording that defines them.
  Eigen::Matrix3d axes_covariance = Eigen::Matrix3d::Zero();
  double head_fit_m = 0;  ///< rms distance of the head's points from those of the first recording

  /// How many times as large the face at rest is as in the first recording, where that is another
  /// scale (scale_between.hpp): then lengths are not comparable. Nothing: one scale.
  std::optional<double> other_scale;
  /// That the recording seems to start or to end in an expression (session::extent_warnings), or
  /// that nothing moves in it (session::stillness_warning), sentences.
  std::vector<std::string> extent_doubts;
  std::vector<std::string> doubts;   ///< why its very figures may be wrong, sentences
  std::vector<std::string> choices;  ///< what holds the head and which unit was guessed, sentences
  std::vector<std::string> remarks;  ///< what else the reader must know of it, sentences
};

/// Measures a recording. The head pose is taken out (motion::stabilise). If the recording
/// has jitter, all tracks are smoothed with metrics::kUsualLowpass_hz, and the jitter that is left
/// at rest and at the peak follows from the weights of that filter. The peak is where the
/// expression's movement (movement_of) is largest. Jitter counts as unknown if none shows and none
/// is stated: a smoothed recording shows none. Throws InputError for what cannot be read or has no
/// movement to measure.
/// `first`: the first recording of the first visit, which defines the axes; null for itself.
/// `still_points`: those that hold the head where the visits name none
/// (motion::points_to_hold_the_head of all recordings); empty: all landmarks. `recording`: the
/// number of this one among them, from 0.
MeasuredFace measure(const motion::Motion& motion, const VisitsFile& visits,
                     std::optional<double> stated_jitter_m, const MeasuredFace* first,
                     const motion::StillPoints& still_points = {}, std::size_t recording = 0);

/// Reads a recording of a visit (motion::read_motion), cleans it (session::cleaned_recording) and
/// checks it by itself (session::check_alone). Throws InputError.
session::CleanedRecording read_recording(const std::filesystem::path& recording,
                                         const VisitEntry& visit, const VisitsFile& visits);

/// measure() of a recording, with what was found in its readings among the remarks. Among the
/// doubts are its extent_doubts and points that seem to be elsewhere, each with its visit.
/// `number`: as `recording` there.
MeasuredFace measure_recording(const session::CleanedRecording& recording, const VisitEntry& visit,
                               const VisitsFile& visits, const MeasuredFace* first,
                               const motion::StillPoints& still_points, std::size_t number);

}  // namespace hyperex::visits
