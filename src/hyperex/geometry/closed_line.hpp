// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// The distance of a point from the closed line of straight segments through the rows of `line`,
/// length unit of both; infinite where `line` is empty.
double distance_to_closed_line(const Eigen::RowVector3d& point, const Points& line);

}  // namespace hyperex
