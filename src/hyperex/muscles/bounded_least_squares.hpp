// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>

namespace hyperex::muscles {

/// Minimises x'Hx/2 - g'x subject to x >= lower (entries may be -infinity); H is symmetric positive
/// definite. Block principal pivoting (Judice and Pires, Comput. Oper. Res. 21, 1994): all entries
/// that violate the optimality conditions change between bound and free at once. Where that makes
/// no more progress, they change one at a time by Murty's rule, so that the method ends in finitely
/// many steps. `x` holds the starting point, whose entries at or below `lower` start as bound, and
/// receives the solution.
void bounded_least_squares(const Eigen::MatrixXd& h, const Eigen::VectorXd& g,
                           const Eigen::VectorXd& lower, Eigen::VectorXd& x);

}  // namespace hyperex::muscles
