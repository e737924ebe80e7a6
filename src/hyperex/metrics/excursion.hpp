// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/motion/motion.hpp"

namespace hyperex::metrics {

/// Cut-off frequency. For the mouth corners in real smiles, 98 % of the power of the velocity lies
/// below it: docs/symmetry.md.
constexpr double kUsualLowpass_hz = 6;

/// Distance of a point from its position in the first sample, mm, one value per sample. The point
/// is the mean of `columns`. NaN where it is not measured.
std::vector<double> distance_from_rest_mm(const motion::Motion& motion,
                                          const std::vector<int>& columns);
/// The same of one point whose track is smoothed (lowpassed; 0: not).
std::vector<double> smooth_distance_mm(const motion::Motion& motion, int column, double lowpass_hz);

struct SideExcursion {
  double excursion_mm = 0;     ///< largest distance of the smoothed path from its first sample
  double path_mm = 0;          ///< length of the smoothed path over all samples
  double peak_speed_mm_s = 0;  ///< largest smoothed speed, excluding both ends (greatest_inside)
  /// How far an error of the head's pose may change the excursion, 95 %; 0: none, or it is known.
  double pose_floor_mm = 0;
};

/// What is known of the noise in a motion's points.
struct KnownNoise {
  bool jitter = true;  ///< false: none shows and none is stated; the points may be smoothed
  bool head = true;    ///< false: the head's motion is in the points
  bool all() const { return jitter && head; }
};

/// A point and its counterpart on the other side. Ratios are right over left, as the affected side
/// is not known. A ratio is NaN if the left value is below 1 um or 1 um/s, or below its floor.
struct PairExcursion {
  std::string name;           ///< "cheilion", "ibug68_48/54" (right/left)
  int left = -1, right = -1;  ///< columns of the motion
  SideExcursion left_side, right_side;
  double excursion_ratio = 0, path_ratio = 0, speed_ratio = 0;
  /// Pearson's correlation of the two speeds over time; NaN if one is constant.
  double speed_correlation = 0;
  /// The values that jitter alone produces for a point at rest (speed_floor.hpp). If the quieter
  /// side moves faster than this jitter even in its quietest half second, they are increased in
  /// proportion, because the jitter of trackers is not white. 0: none, or not known.
  double peak_speed_floor_mm_s = 0, path_floor_mm = 0;
  /// The difference between the sides is below the floor.
  bool peak_speed_undecided = false, path_undecided = false;
  /// True if jitter lowers the correlation by more than a tenth: sqrt((1 - n_L) (1 - n_R)) < 0.9,
  /// with n the share of jitter in the variance of a speed over time.
  bool speed_correlation_undecided = false;
  /// For a symmetric motion, 95 % of the differences between the two excursions that jitter alone
  /// produces are below this: 1.96 jitter sqrt(sum of n^2) over two positions per side, to first
  /// order along the path. n is the noise that the filter leaves (lowpassed_noise) times
  /// `jitter_widening`, at most 1. 0 if the jitter is unknown.
  double jitter_floor_mm = 0;
  /// The rms speed of the quieter side in its quietest half second, relative to that of white
  /// jitter, at least 1.
  double jitter_widening = 1;
  double jitter_share = 1;  ///< mean of n^2: the share of jitter's variance that is left
  /// NaN: no floor known (mesh_floor.hpp).
  double mesh_floor_mm = std::numeric_limits<double>::quiet_NaN();
  /// How far an error of the head's pose may part the two excursions, 95 %; 0: no head pose was
  /// taken out, or it is known (pose_floor.hpp).
  double pose_floor_mm = 0;
  double repetition_floor_mm = 0;  ///< a person's own variation, 95 % (repetition_floor.hpp)
  bool undecided = false;          ///< the difference between the excursions is below floor_mm()
  /// The excursion of the counterpart in the mirrored twin of the run (mesh_floor.hpp). In the
  /// twin, the other side carries out the motion of this side, so that on a mirrored mesh this
  /// would equal the excursion of this side. NaN without a twin.
  double twin_left_mm = std::numeric_limits<double>::quiet_NaN();
  double twin_right_mm = std::numeric_limits<double>::quiet_NaN();
  KnownNoise known;  ///< the floors contain only the noise that is known
  /// A floor below this is that of points without any noise.
  static constexpr double kNoFloor_mm = 5e-4;
  /// False, too, where no noise is seen in the points that hold the head and none is stated.
  bool pose_floor_known() const {
    return known.head && (known.jitter || pose_floor_mm > kNoFloor_mm);
  }
  bool floor_known() const { return known.all() || floor_mm() > kNoFloor_mm; }
  /// False: a run simulated this point, and its recording does not show it (recorded_sides.hpp).
  bool left_recorded = true, right_recorded = true;

  double difference_mm() const { return left_side.excursion_mm - right_side.excursion_mm; }
  /// All floors together, as independent errors: the root of the sum of their squares.
  double floor_mm() const {
    const double mesh_mm = std::isnan(mesh_floor_mm) ? 0 : mesh_floor_mm;
    return std::hypot(std::hypot(jitter_floor_mm, mesh_mm), pose_floor_mm, repetition_floor_mm);
  }
  /// Sets `undecided` by the floors that are known; without any it is false.
  void judge() { undecided = floor_mm() > 0 && !(std::abs(difference_mm()) >= floor_mm()); }
  /// Whether a figure is decided. `below_floor`: `undecided`, `path_undecided` and so on. False
  /// below the floors, true above them. Nothing above them if some noise is not known, as the
  /// figure may be that noise. Nothing where one side is not known, or recorded alone.
  std::optional<bool> decided(bool below_floor) const {
    if (left_recorded != right_recorded || std::isnan(difference_mm())) return std::nullopt;
    if (below_floor) return false;
    return known.all() ? std::optional<bool>(true) : std::nullopt;
  }
};

/// The clinical measure of a smile: the excursion of the corners of the mouth.
struct Commissure {
  int left = -1, right = -1;  ///< columns: cheilion, or ibug68_54 and 48; -1 where there is none
  std::vector<double> left_mm, right_mm;      ///< distance from rest, smoothed, per sample
  std::vector<double> left_mm_s, right_mm_s;  ///< speed
  double left_from_midlip_mm = 0, right_from_midlip_mm = 0;  ///< see Excursions::commissure
  /// The places of each corner's counterpart in the mirrored twin of the run (mesh_floor.hpp),
  /// smoothed, N x 3, mm. The counterpart carries out the motion of this side there. Empty without
  /// a twin.
  Points twin_left_track_mm, twin_right_track_mm;
};

struct Excursions {
  std::vector<PairExcursion> pairs;  ///< in the order of the motion's names
  /// The curves are empty if its points are absent. left_from_midlip_mm and right_from_midlip_mm:
  /// the change of the distance between the corner and the middle of the lower lip
  /// (labiale_inferius or ibug68_57). Of all samples, that with the greatest absolute change
  /// counts; the sign is kept.
  Commissure commissure;
  double jitter_m = 0;
  double lowpass_hz = 0;  ///< cut-off used to smooth all positions; 0: not smoothed
  KnownNoise known;       ///< that of all pairs
};

/// The excursions of all pairs of points of a motion without head pose: NAME_L and NAME_R, and
/// mirrored iBUG-68 points, named ibug68_K, K or pK. Pairs that are not measured in the first
/// sample are omitted. L and R are the subject's own sides. If jitter_m is above 0, all
/// figures are of tracks smoothed with the cut-off `lowpass_hz` (>= 0; 0: not smoothed); an exact
/// motion is never smoothed.
Excursions excursions_of(const motion::Motion& motion, double jitter_m = 0,
                         double lowpass_hz = kUsualLowpass_hz);

/// States what is known of the noise. excursions_of() takes all as known: the points are exact
/// where it is given no jitter.
void set_known(Excursions& excursions, const KnownNoise& known);

}  // namespace hyperex::metrics
