// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "hyperex/motion/motion.hpp"

namespace hyperex::metrics {

/// Symmetry of motion after Trotman et al.: with r_k,side(t) the distances from cheilion to
/// exocanthion, palpebrale_inferius, alare and crista_philtri_inferior of one side,
///   xi_side(t) = sum_k (r_k,side(t) / r_k,side(t0) - 1),  S(t) = ln |xi_L(t) - xi_R(t)|.
/// Smaller is more symmetric; S is floored at ln(floor), as perfect symmetry is minus infinity.
struct SymmetryCurve {
  std::vector<double> time_s;
  std::vector<double> xi_left, xi_right;  ///< dimensionless (relative change of length, summed)
  std::vector<double> s;  ///< natural logarithm; first sample is the floor by definition
  double floor = 1e-6;    ///< least |xi_L - xi_R| told apart (dimensionless)
  /// Points that stood in for absent ones: "exocanthion_L: ibug68_45"; empty where none did.
  std::vector<std::string> stand_ins;
};

/// `landmarks` must hold cheilion, exocanthion, palpebrale_inferius, alare and
/// crista_philtri_inferior with _L and _R. iBUG-68 stand-ins are used where the anatomical name is
/// absent (48/54, 36/45, mean of 40,41 / 46,47, 31/35, 50/52 for R / L), under the names ibug68_K,
/// K, or pK. InputError naming the missing ones otherwise, where a point was not measured at the
/// first sample, or where floor is not above 0. Later samples without a measurement are NaN.
SymmetryCurve symmetry_of(const motion::Motion& landmarks, double floor = 1e-6);

/// The floor that points known to `accuracy_m` (standard deviation a coordinate, independent) set:
/// that of xi_L - xi_R for a face that does not move, to first order
///   accuracy * sqrt(2 sum_sides (|sum_k e_k / r_k|^2 + sum_k 1 / r_k^2)),
/// e_k the unit vector of distance k at the first sample; 2 as t and t0 are both measured.
double floor_from_accuracy(const motion::Motion& landmarks, double accuracy_m);

/// CSV with the columns time_s, xi_L, xi_R, S_ln, floor; empty fields where not measured.
void write_symmetry_csv(const std::filesystem::path& file, const SymmetryCurve& curve);

}  // namespace hyperex::metrics
