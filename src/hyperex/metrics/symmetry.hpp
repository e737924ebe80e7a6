// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
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
  std::vector<double> s;                  ///< natural logarithm; first sample is the floor by definition
  double floor = 1e-6;                    ///< least |xi_L - xi_R| told apart (dimensionless)
};

/// `landmarks` must hold cheilion, exocanthion, palpebrale_inferius, alare and
/// crista_philtri_inferior with _L and _R; InputError naming the missing ones otherwise. iBUG-68 stand-ins are used where the
/// anatomical name is absent (48/54, 36/45, mean of 40,41 / 46,47, 31/35, 50/52); `source` of the
/// curve says so in the command's output.
SymmetryCurve symmetry_of(const motion::Motion& landmarks, double floor = 1e-6);

}  // namespace hyperex::metrics
