// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "hyperex/motion/motion.hpp"

namespace hyperex::metrics {

/// Relative changes r_k / r_k0 - 1 of the eight distances of S(t) in one sample: from cheilion to
/// exocanthion, palpebrale inferius, alare and crista philtri inferior, first on the left, then on
/// the right.
using Stretches = std::array<double, 8>;

/// What S(t) compares and what it does not say, in two lines of a picture: two faces may be ordered
/// otherwise by S than by how far their sides move, as a partial and a complete palsy may be.
inline constexpr std::array<const char*, 2> kWhatSCompares = {
    "S compares how much the distances from each corner of the mouth to eye, lid, nose and lip "
    "stretch;",
    "it does not say which face moves more evenly in mm and grades no palsy: the excursions say "
    "which side moves less."};

/// Symmetry of a motion after Trotman et al. With r_k,side(t) the distances from cheilion to
/// exocanthion, palpebrale_inferius, alare and crista_philtri_inferior of one side,
///   xi_side(t) = sum_k (r_k,side(t) / r_k,side(t0) - 1),  S(t) = ln |xi_L(t) - xi_R(t)|.
/// A smaller S means that both sides stretch more alike in sum, not that they go more equally far.
/// It is negative where the sums differ by less than 1. S is limited below by ln(floor), because
/// equal sums would give minus infinity.
struct SymmetryCurve {
  std::vector<double> time_s;
  std::vector<double> xi_left, xi_right;  ///< dimensionless (relative change of length, summed)
  std::vector<double> s;  ///< natural logarithm; at the first sample the floor, by definition
  double floor = 1e-6;    ///< least |xi_L - xi_R| that is resolved (dimensionless)
  /// Substitutes for absent points: "exocanthion_L: ibug68_45"; empty if there are none.
  std::vector<std::string> stand_ins;
  double jitter_m = 0;  ///< jitter of the points, standard deviation per coordinate; 0: exact
  /// Per sample, the value that |xi_L - xi_R| of a symmetric motion exceeds by jitter alone in only
  /// 5 % of cases (symmetry_noise), dimensionless. S_floor is its logarithm. Empty if jitter_m is
  /// 0.
  std::vector<double> noise;
  /// Per sample, the upper bound of |xi_L - xi_R| of a symmetric motion that results from the mesh
  /// and the resolution of the simulation (mesh_floor.hpp); empty if unknown.
  std::vector<double> mesh_noise;
  std::vector<Stretches> mesh_remainder;  ///< twin_remainders(), from which mesh_noise is computed

  /// Whether the motion has the points that S(t) is made of (symmetry_without_points).
  bool known() const;
  /// The larger of the two floors, one value per sample; empty if neither is known.
  std::vector<double> floors() const;
  /// Whether |xi_L - xi_R| of this sample is below either floor, so that it is undecided which side
  /// moves more. Also true if the sample is not measured. Never true for an exact motion without a
  /// mesh floor.
  bool undecided(size_t sample) const;
};

/// `landmarks` must contain cheilion, exocanthion, palpebrale_inferius, alare and
/// crista_philtri_inferior with _L and _R. Absent points are replaced by iBUG-68 points (R / L:
/// 48/54, 36/45, mean of 40,41 / 46,47, 31/35, 50/52), under the names ibug68_K, K, or pK. Throws
/// InputError, naming the missing points, if there is no substitute. Also throws InputError if a
/// point is not measured in the first sample, if floor is not above 0, or if jitter_m is below 0.
/// Later samples without a measurement are NaN.
SymmetryCurve symmetry_of(const motion::Motion& landmarks, double floor = 1e-6,
                          double jitter_m = 0);

/// For a motion without these points: its times, and NaN in place of xi and S.
SymmetryCurve symmetry_without_points(const motion::Motion& landmarks, double floor = 1e-6);

/// The columns of the points used for S(t), increasing; empty if a point is absent.
std::vector<int> symmetry_columns(const motion::Motion& landmarks);

/// One entry per sample; NaN where not measured. Points and errors as for symmetry_of.
std::vector<Stretches> stretches_of(const motion::Motion& landmarks);

/// The uncertainty of xi_L - xi_R due to jitter: 1.96 standard deviations per sample; NaN where not
/// measured. The errors of the points have the standard deviation `jitter_m` per coordinate and are
/// independent of each other and in time. To first order, the variance at time t is
///   jitter^2 sum_sides (|sum_k e_k(t) / r_k0|^2 + sum_k 1 / (n_k r_k0^2)
///                       + |sum_k r_k(t) e_k0 / r_k0^2|^2 + sum_k r_k(t)^2 / (n_k r_k0^4)).
/// e_k is the unit vector of distance k, index 0 denotes the first sample, and n_k is the number of
/// points whose mean is the far end of the distance. The first two terms result from t, the others
/// from t0. Errors as for symmetry_of.
std::vector<double> symmetry_noise(const motion::Motion& landmarks, double jitter_m);

/// Estimates the jitter of measured points at rest. In each window of `window_s` (at least five
/// samples), the standard deviation of each coordinate about its mean is computed; the root mean
/// square is taken over the points used for S(t) and the three axes. The result is that of the
/// quietest window, because a recording seldom states when the face is at rest. Tremor and slow
/// drift count as jitter. The head pose must have been removed. NaN if no window is measured.
/// Errors as for symmetry_of.
double jitter_at_rest(const motion::Motion& landmarks, double window_s = 0.5);

}  // namespace hyperex::metrics
