// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "hyperex/motion/motion.hpp"

namespace hyperex::metrics {

/// Relative changes of the eight distances of S(t) in one sample: r_k / r_k0 - 1 to exocanthion,
/// palpebrale inferius, alare and crista philtri inferior of the left, then of the right.
using Stretches = std::array<double, 8>;

/// Symmetry of motion after Trotman et al.: with r_k,side(t) the distances from cheilion to
/// exocanthion, palpebrale_inferius, alare and crista_philtri_inferior of one side,
///   xi_side(t) = sum_k (r_k,side(t) / r_k,side(t0) - 1),  S(t) = ln |xi_L(t) - xi_R(t)|.
/// Smaller is more symmetric; S is floored at ln(floor), as perfect symmetry is minus infinity.
struct SymmetryCurve {
  std::vector<double> time_s;
  std::vector<double> xi_left, xi_right;  ///< dimensionless (relative change of length, summed)
  std::vector<double> s;  ///< natural logarithm; first sample is the floor by definition
  double floor = 1e-6;    ///< least |xi_L - xi_R| that is resolved (dimensionless)
  /// Points that stood in for absent ones: "exocanthion_L: ibug68_45"; empty where none did.
  std::vector<std::string> stand_ins;
  double jitter_m = 0;  ///< of the points, standard deviation a coordinate; 0: exact
  /// Per sample, the bound below which |xi_L - xi_R| of a symmetric motion stays in 95 % of cases,
  /// by jitter alone (symmetry_noise), dimensionless; empty where jitter_m is 0. S_floor is its
  /// logarithm.
  std::vector<double> noise;
  /// Per sample, the bound below which |xi_L - xi_R| of a symmetric motion stays, by the mesh's own
  /// unevenness and the resolution of a simulation (mesh_floor.hpp); empty where none is known.
  std::vector<double> mesh_noise;
  std::vector<Stretches> mesh_remainder;  ///< what mesh_noise is of (twin_remainders)

  /// The larger of both floors, a value per sample; empty where neither is known.
  std::vector<double> floors() const;
  /// |xi_L - xi_R| is under either floor of that sample: which side moves more is then undecided.
  /// Also true where not measured; never for an exact motion without a mesh.
  bool undecided(size_t sample) const;
};

/// `landmarks` must hold cheilion, exocanthion, palpebrale_inferius, alare and
/// crista_philtri_inferior with _L and _R. iBUG-68 stand-ins are used where the anatomical name is
/// absent (48/54, 36/45, mean of 40,41 / 46,47, 31/35, 50/52 for R / L), under the names ibug68_K,
/// K, or pK. InputError naming the missing ones otherwise, where a point was not measured at the
/// first sample, where floor is not above 0 or jitter_m below 0. Later samples without a
/// measurement are NaN.
SymmetryCurve symmetry_of(const motion::Motion& landmarks, double floor = 1e-6,
                          double jitter_m = 0);

/// The columns of the points that S(t) takes, in rising order; empty where one is not there.
std::vector<int> symmetry_columns(const motion::Motion& landmarks);

/// A value per sample; NaN where not measured. Points and errors as symmetry_of.
std::vector<Stretches> stretches_of(const motion::Motion& landmarks);

/// Points known to `jitter_m` (standard deviation a coordinate, independent of each other and in
/// time) make xi_L - xi_R uncertain; to first order its variance at time t is
///   jitter^2 sum_sides (|sum_k e_k(t) / r_k0|^2 + sum_k 1 / (n_k r_k0^2)
///                       + |sum_k r_k(t) e_k0 / r_k0^2|^2 + sum_k r_k(t)^2 / (n_k r_k0^4)),
/// e_k the unit vector of distance k, 0 the first sample, n_k how many points the mean that stands
/// for the far end is of. The first two terms come from t, the others from t0. Gives 1.96 standard
/// deviations a sample; NaN where not measured. Errors as symmetry_of.
std::vector<double> symmetry_noise(const motion::Motion& landmarks, double jitter_m);

/// Jitter of measured points at rest: within a window of `window_s` (but at least five samples) the
/// standard deviation of a coordinate about its own mean in the window, root mean square over the
/// points that S(t) takes and the three axes; of all windows the quietest, as a recording seldom
/// says when the face rests. Tremor and slow drift count as jitter. Head pose must be out. NaN
/// where no window is measured. Errors as symmetry_of.
double jitter_at_rest(const motion::Motion& landmarks, double window_s = 0.5);

}  // namespace hyperex::metrics
