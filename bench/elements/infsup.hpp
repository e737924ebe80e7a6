// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "candidates.hpp"

namespace hyperex::study {

/// The numerical inf-sup constant of groups on a mesh held all round (Chapelle and Bathe
/// 1993): root of the least non-zero eigenvalue of B K^-1 B^T p = beta^2 V p, K the vector
/// Laplacian. `spurious`: eigenvalues that vanish besides the constant pressure's.
struct InfSup {
  int groups, spurious;
  double constant;
};
InfSup inf_sup(const Candidate& candidate, const Problem& cube);

}  // namespace hyperex::study
