// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <functional>
#include <vector>

#include "hyperex/simulate/load/muscle_model.hpp"

namespace hyperex::simulate {

/// Forces and the displacements that they cause, one column per load case.
struct HeldShape {
  Eigen::MatrixXd force;  ///< 3 |all nodes| x n, N; 0 but at the held nodes
  Eigen::MatrixXd moved;  ///< 3 |outer nodes| x n, m
};

/// Forces that keep nodes at the displacements in the columns of `displaced` (3 |nodes| x n, m),
/// with the rest of the face in equilibrium without external forces. `nodes`: outer ones, rising,
/// none prescribed by the model's boundary. `hold`: how firmly, one per node, above 0. A node of
/// hold 1 moves exactly as asked. One of hold h < 1 is drawn to its place by a spring of h / (1 -
/// h) times its own stiffness, the mean of its three entries on the stiffness matrix's diagonal.
/// `between` (may be empty) is called repeatedly; it may throw, which ends the computation.
HeldShape holding_forces(const MuscleModel& model, const std::vector<int>& nodes,
                         const Eigen::VectorXd& hold, const Eigen::MatrixXd& displaced,
                         const std::function<void()>& between);

/// A hold of 1 at each of the nodes.
Eigen::VectorXd exactly(const std::vector<int>& nodes);

}  // namespace hyperex::simulate
