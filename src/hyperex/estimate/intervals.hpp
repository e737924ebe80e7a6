// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/estimate/posterior.hpp"

namespace hyperex::estimate {

/// An interval counts as an answer if it is narrow enough: the ends of a ratio's interval differ by
/// a factor of at most kWidestRatio, and those of a gain's by at most kWidestGain.
inline constexpr double kWidestRatio = 2.5, kWidestGain = 0.8;

/// An interval of a logarithm (of a ratio, or of Young's modulus) or of a gain.
struct Range {
  double low = 0, high = 0;
};

/// 95 % intervals of one of the requested unknowns.
struct AskedInterval {
  double value = 0, sigma = 0;
  Range laplace;  ///< from the curvature at the mode
  /// Where the posterior, maximised over all other unknowns, has fallen by exp(-1.92) (profile
  /// likelihood); this is the one that is reported.
  Range profile;
};

/// The covariance of the requested unknowns (Unknowns::asked(), in their order) by the curvature at
/// the mode. Unknowns at a bound do not vary.
Eigen::MatrixXd asked_covariance(const Mode& mode, const Unknowns& unknowns);

/// `which`: of Unknowns::asked(). Gains are at least 0.
AskedInterval interval_of(Posterior& posterior, const Mode& mode, Eigen::Index which);

/// What makes an interval wide.
struct ErrorPart {
  const char* words;  ///< "how alike both sides try"
  double share;       ///< of the variance that would go if this were known, 0 to 1
};
/// Largest first. The shares need not add up to 1.
std::vector<ErrorPart> error_parts(const Mode& mode, const Unknowns& unknowns, Eigen::Index which);

}  // namespace hyperex::estimate
