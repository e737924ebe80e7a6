// SPDX-License-Identifier: GPL-3.0-or-later
// The incremental potential that FiniteNewton minimises: value, gradient, matrix and factor.
#include <algorithm>
#include <cmath>

#include "hyperex/fem/material/entry.hpp"
#include "hyperex/fem/time/finite_newton_impl.hpp"

namespace hyperex::fem {

using Eigen::VectorXd;

void FiniteNewton::Impl::place_springs() {
  spring_places.reserve(static_cast<std::size_t>(springs.nonZeros()));
  for (int c = 0; c < springs.outerSize(); ++c)
    for (SparseMatrix::InnerIterator it(springs, c); it; ++it) {
      const int *from = matrix.innerIndexPtr() + matrix.outerIndexPtr()[c],
                *to = matrix.innerIndexPtr() + matrix.outerIndexPtr()[c + 1];
      const int* at = std::lower_bound(from, to, static_cast<int>(it.row()));
      require(at != to && *at == it.row(),
              "the springs have an entry ({}, {}): expected the pattern of System::stiffness",
              it.row(), c);
      spring_places.push_back(static_cast<int>(at - matrix.innerIndexPtr()));
    }
}

void FiniteNewton::Impl::fill_matrix(const VectorXd& d, bool projected) {
  form.tangent(d, mass_share, projected, matrix);
  std::size_t k = 0;
  for (int c = 0; c < springs.outerSize(); ++c)
    for (SparseMatrix::InnerIterator it(springs, c); it; ++it)
      matrix.valuePtr()[spring_places[k++]] += it.value();
  if (potentials.empty()) return;
  TangentBlocks blocks(form.mesh().stiffness_neighbours(), matrix);
  for (const NodalPotential* p : potentials) p->add_tangent(d, blocks);
}

/// Returns false if not even the projected matrix is positive definite.
bool FiniteNewton::Impl::factor_at(const VectorXd& d, FiniteStepReport& report) {
  secants.clear();
  age.renew(rule.now);
  turns.factored_at(d);
  fill_matrix(d, false);
  ++report.factorisations;
  age.rough = factor->try_refactor(matrix) >= 0;
  if (!age.rough) return true;
  fill_matrix(d, true);
  ++report.factorisations;
  ++report.projections;
  return factor->try_refactor(matrix) < 0;
}

/// By the present factor, rotated with the tissue.
void FiniteNewton::Impl::solve(VectorXd& rhs) {
  turns.turn_back(factor->free(), rhs);
  factor->solve(rhs);
  turns.turn(factor->free(), rhs);
}

/// The incremental potential without external forces, and its gradient.
double FiniteNewton::Impl::potential(const VectorXd& d, VectorXd& out) {
  double sum = form.energy_and_gradient(d, out);
  energy_scale = std::abs(sum);
  const auto count = [&](double e) {
    sum += e;
    energy_scale += std::abs(e);
  };
  if (mass_share > 0) {
    from_hat = d - x_hat;
    form.mass_product(from_hat, mass_u);
    out += mass_share * mass_u;
    count(mass_share / 2 * from_hat.dot(mass_u));
  }
  if (springs.cols() > 0) {
    mass_u.noalias() = springs * d;
    out += mass_u;
    count(mass_u.dot(d) / 2);
  }
  for (const NodalPotential* p : potentials) count(p->add_gradient(d, out));
  return sum;
}

}  // namespace hyperex::fem
