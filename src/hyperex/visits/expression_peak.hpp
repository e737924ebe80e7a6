// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "hyperex/visits/face_points.hpp"

namespace hyperex::visits {

/// A posed expression, and the movement whose largest value is its peak.
struct Expression {
  enum class Movement { corners, lips, brows, lids };
  std::string name;  ///< "smile"
  Movement movement = Movement::corners;
};

/// The expressions that a file of visits may name.
const std::vector<Expression>& expressions();
/// Nothing for an unknown name.
std::optional<Expression> expression_named(const std::string& name);
/// "corners of the mouth".
std::string moved_part(Expression::Movement movement);

/// The movement over time, m: the mean of both sides' distances from rest for corners of the mouth
/// and brows, the distance between the inner lips, or how far the lids have come together. With one
/// side measured, that side. NaN where no side is measured. `tracks`: one per point, N x 3, m;
/// empty: not measured.
std::vector<double> movement_of(Expression::Movement movement, const ByFacePoint<Points>& tracks);

}  // namespace hyperex::visits
