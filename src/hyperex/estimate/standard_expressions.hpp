// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <string>
#include <vector>

#include "hyperex/muscles/muscle_lines.hpp"

namespace hyperex::estimate {

/// An expression that a person can make on request.
struct StandardExpression {
  std::string name;                                         ///< "smile"
  std::vector<std::pair<std::string, double>> activations;  ///< of muscles, the same on both sides
  double opening_rad = 0;                                   ///< of the jaw
};

/// Smile, show upper teeth, show lower teeth, pucker, brow raise, frown, eye closure, mouth open.
/// The muscles are those of the action units (Ekman, Friesen and Hager, Facial Action Coding
/// System, 2002) 12, 10, 16, 18, 1 + 2, 4, 43 and 27.
const std::vector<StandardExpression>& standard_expressions();

/// One activation per line; muscles that the face lacks are left out.
Eigen::VectorXd activations_of(const StandardExpression& expression,
                               const std::vector<muscles::MuscleLine>& lines);

}  // namespace hyperex::estimate
