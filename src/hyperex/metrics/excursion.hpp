// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "hyperex/motion/motion.hpp"

namespace hyperex::metrics {

/// 98 % of the speed (in square) of real mouth corners that smile lies below it: docs/symmetry.md.
constexpr double kUsualLowpass_hz = 6;

/// Distance of a point (mean of `columns`) from its place in the first sample, mm a sample; NaN
/// where not measured.
std::vector<double> distance_from_rest_mm(const motion::Motion& motion,
                                          const std::vector<int>& columns);
/// Its speed, mm/s, smoothed by lowpassed(): lowpass.hpp. `lowpass_hz` 0: |x(k+1) - x(k-1)| /
/// (t(k+1)
/// - t(k-1)), one-sided at both ends. NaN where a sample that it takes is not measured, and for a
/// motion of one sample.
std::vector<double> speed_mm_s(const motion::Motion& motion, const std::vector<int>& columns,
                               double lowpass_hz = 0);

struct SideExcursion {
  double excursion_mm = 0;     ///< largest distance from the place in the first sample
  double path_mm = 0;          ///< length of the whole way, smoothed, from sample to sample
  double peak_speed_mm_s = 0;  ///< largest speed, smoothed; not at the ends (greatest_inside)
};

/// A point and its counterpart on the other side. Ratios are right over left (which side is
/// affected is not known); NaN where the left is below a micrometre, or a micrometre a second, or
/// below its floor.
struct PairExcursion {
  std::string name;           ///< "cheilion", "ibug68_48/54" (right/left)
  int left = -1, right = -1;  ///< columns of the motion
  SideExcursion left_side, right_side;
  double excursion_ratio = 0, path_ratio = 0, speed_ratio = 0;
  double speed_correlation = 0;  ///< Pearson's, of both speeds over time; NaN where one is constant
  /// What jitter alone makes of a side at rest (speed_floor.hpp), widened where the
  /// quieter side's quietest half second moves more: trackers' jitter is not white. 0: none known.
  double peak_speed_floor_mm_s = 0, path_floor_mm = 0;
  bool peak_speed_undecided = false, path_undecided = false;  ///< the sides differ by less
  /// Jitter lowers the correlation by more than a tenth: with n the share of jitter in a speed's
  /// variance over time, sqrt((1 - n_L) (1 - n_R)) < 0.9.
  bool speed_correlation_undecided = false;
  /// What the excursions of a symmetric motion differ by, in 95 % of motions, by jitter alone:
  /// 1.96 * 2 jitter (two places a side, to first order along the way); 0 where none is known.
  double jitter_floor_mm = 0;
  double mesh_floor_mm = std::numeric_limits<double>::quiet_NaN();  ///< NaN: none (mesh_floor.hpp)
  bool undecided = false;  ///< the excursions differ by less than the larger floor
  /// The counterpart's excursion in the run's mirrored twin (mesh_floor.hpp): on a mirrored mesh
  /// that of this side; NaN without a twin.
  double twin_left_mm = std::numeric_limits<double>::quiet_NaN();
  double twin_right_mm = std::numeric_limits<double>::quiet_NaN();

  double difference_mm() const { return left_side.excursion_mm - right_side.excursion_mm; }
  double floor_mm() const { return std::fmax(jitter_floor_mm, mesh_floor_mm); }
};

/// What clinics measure of a smile: how far the corners of the mouth travel.
struct Commissure {
  int left = -1, right = -1;  ///< columns: cheilion, or ibug68_54 and 48; -1 where there is none
  std::vector<double> left_mm, right_mm;                     ///< distance from rest, a sample
  std::vector<double> left_mm_s, right_mm_s;                 ///< speed
  double left_from_midlip_mm = 0, right_from_midlip_mm = 0;  ///< see below
};

struct Excursions {
  std::vector<PairExcursion> pairs;  ///< in the order of the motion's names
  /// Empty curves without its points. from_midlip: the change of greatest size, with its sign, of
  /// the distance from the middle of the lower lip (labiale_inferius, or ibug68_57) to the corner.
  Commissure commissure;
  double jitter_m = 0;
  double lowpass_hz = 0;  ///< that speeds and paths were smoothed with; 0: not
};

/// The excursions of every pair of points that a motion (head pose taken out) names: NAME_L and
/// NAME_R, and the mirrored iBUG-68 points as ibug68_K, K or pK; those not measured in the first
/// sample are left out. L and R are the subject's own sides. Speeds and paths of a motion with
/// jitter are smoothed with the cut-off `lowpass_hz` (>= 0; 0: not); an exact motion is left as it
/// is.
Excursions excursions_of(const motion::Motion& motion, double jitter_m = 0,
                         double lowpass_hz = kUsualLowpass_hz);

}  // namespace hyperex::metrics
