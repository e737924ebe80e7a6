// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <string>
#include <vector>

#include "hyperex/muscles/muscle_lines.hpp"
#include "hyperex/muscles/muscle_template.hpp"
#include "hyperex/simulate/load/muscle_fit.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::simulate {

/// Names the groups of each side, in the template's order. Returns |groups| x |lines|: 1 where a
/// muscle is in a group, else 0.
Eigen::MatrixXd name_groups(const std::vector<muscles::MuscleLine>& lines,
                            const muscles::MuscleTable& table, std::vector<std::string>& groups);

/// Makes room for the samples. Names and times are left as they are.
void resize(MuscleCourse& course, Eigen::Index muscles, Eigen::Index groups, Eigen::Index samples);

/// Stores the activations of a sample with their standard deviations. `members`: of name_groups().
void store_sample(const FitResult& fitted, const Eigen::MatrixXd& members, Eigen::Index sample,
                  MuscleCourse& course);

}  // namespace hyperex::simulate
