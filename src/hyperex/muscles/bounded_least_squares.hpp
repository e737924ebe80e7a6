// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>

namespace hyperex::muscles {

/// Minimises x'Hx/2 - g'x over x >= lower (entries may be -infinity), H symmetric positive
/// definite. Block principal pivoting (Judice and Pires, Comput. Oper. Res. 21, 1994): exchanges
/// all entries that break the conditions of optimality at once, and one at a time, by Murty's rule,
/// where that makes no more progress; this ends in finitely many steps. `x`: the start, entries
/// equal to `lower` being bound; then the solution.
void bounded_least_squares(const Eigen::MatrixXd& h, const Eigen::VectorXd& g,
                           const Eigen::VectorXd& lower, Eigen::VectorXd& x);

}  // namespace hyperex::muscles
