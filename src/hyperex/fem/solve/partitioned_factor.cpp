// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/partitioned_factor.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hyperex/core/assert.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/stopwatch.hpp"

namespace hyperex::fem {

PartitionedFactor::PartitionedFactor(const SparseMatrix& a, std::vector<int> prescribed,
                                     std::string purpose, const Points& nodes, LinearSolver wanted,
                                     std::shared_ptr<const NodeOrder> order)
    : partition_(static_cast<int>(a.cols()), std::move(prescribed)),
      purpose_(std::move(purpose)),
      order_(std::move(order)) {
  make(a, nullptr, nodes, wanted);
}

PartitionedFactor::PartitionedFactor(SparseMatrix&& a, std::vector<int> prescribed,
                                     std::string purpose, const Points& nodes, LinearSolver wanted,
                                     std::shared_ptr<const NodeOrder> order)
    : partition_(static_cast<int>(a.cols()), std::move(prescribed)),
      purpose_(std::move(purpose)),
      order_(std::move(order)) {
  make(a, &a, nodes, wanted);
}

void PartitionedFactor::make(const SparseMatrix& a, SparseMatrix* spare, const Points& nodes,
                             LinearSolver wanted) {
  Stopwatch watch;
  const SparseMatrix lower = free_lower(a, partition_);
  constexpr double entry_bytes = sizeof(double) + sizeof(int);
  pick(a, lower, nodes, wanted, spare ? entry_bytes * static_cast<double>(a.nonZeros()) : 0);
  if (spare && cholesky_) taken(*spare);
  analyse_s_ = watch.lap();
  factor(a, lower);
}

void PartitionedFactor::pick(const SparseMatrix& a, const SparseMatrix& lower, const Points& nodes,
                             LinearSolver wanted, double spare_bytes) {
  std::vector<int> node_of(free().size());
  for (std::size_t i = 0; i < node_of.size(); ++i) node_of[i] = free()[i] / 3;
  if (!order_) order_ = std::make_shared<const NodeOrder>(order_by_nodes(lower, node_of));
  HX_ASSERT(order_->unknowns.size() == free().size());
  forecast_ = {order_->entries, order_->flops, static_cast<double>(lower.nonZeros())};
  const bool can_choose = nodes.rows() > 0;
  HX_ASSERT(can_choose || wanted != LinearSolver::iterative);
  if (can_choose && pick_linear_solver(wanted, forecast_, available_memory_bytes() + spare_bytes) ==
                        LinearSolver::iterative)
    iterative_.emplace(a, partition_, nodes, purpose_);
  else
    cholesky_.emplace(lower, purpose_, order_->unknowns);
}

void PartitionedFactor::refactor(const SparseMatrix& a) {
  Stopwatch watch;
  const SparseMatrix lower = cholesky_ ? free_lower(a, partition_) : SparseMatrix();
  const double extract_s = watch.lap();
  factor(a, lower);
  factor_s_ += extract_s;
}

int PartitionedFactor::try_refactor(const SparseMatrix& a) {
  Stopwatch watch;
  if (cholesky_) {
    if (lower_.cols() == 0)
      lower_ = free_lower(a, partition_);
    else
      refill_free_lower(a, partition_, lower_);
  }
  const double extract_s = watch.lap();
  const int lost = try_factor(a, lower_);
  factor_s_ += extract_s;
  return lost;
}

/// The unknown at which the matrix is not positive definite, or -1.
int PartitionedFactor::try_factor(const SparseMatrix& a, const SparseMatrix& lower) {
  Stopwatch watch;
  const int lost = cholesky_ ? cholesky_->factorize(lower) : iterative_->factorize(a);
  factor_s_ = watch.lap();
  return lost < 0 ? -1 : free()[lost];
}

void PartitionedFactor::factor(const SparseMatrix& a, const SparseMatrix& lower) {
  const int unknown = try_factor(a, lower);
  if (unknown < 0) return;
  throw NumericalError(fmt::format(
      "{}: the matrix of the {} free unknowns is not positive definite (seen at node {}, axis {}): "
      "too few supports to hold every part of the mesh ({} unknowns are prescribed), or a node "
      "that no element uses",
      purpose_, free().size(), unknown / 3, "xyz"[unknown % 3], prescribed().size()));
}

LinearSolver PartitionedFactor::solver() const {
  return cholesky_ ? LinearSolver::cholesky : LinearSolver::iterative;
}

double PartitionedFactor::factor_entries() const {
  return cholesky_ ? cholesky_->entries() : iterative_->entries();
}

void PartitionedFactor::solve(Eigen::VectorXd& x_o) {
  if (cholesky_) return cholesky_->solve(x_o);
  Eigen::MatrixXd x = x_o;
  iterative_->solve(x);
  x_o = x;
}

void PartitionedFactor::solve(Eigen::MatrixXd& x_o) {
  cholesky_ ? cholesky_->solve(x_o) : iterative_->solve(x_o);
}

void PartitionedFactor::solve(Eigen::MatrixXd& x_o, const std::function<void()>& between) {
  constexpr Eigen::Index kColumns = 32;  // enough for the products' speed
  const Eigen::Index step = cholesky_ ? kColumns : std::max<Eigen::Index>(x_o.cols(), 1);
  for (Eigen::Index from = 0; from < x_o.cols(); from += step) {
    if (between) between();
    auto some = x_o.middleCols(from, std::min(step, x_o.cols() - from));
    Eigen::MatrixXd part = some;
    solve(part);
    some = part;
  }
}

void PartitionedFactor::solve(Eigen::VectorXd& x_o, const Eigen::VectorXd& guess) {
  if (cholesky_) return cholesky_->solve(x_o);
  Eigen::MatrixXd x = x_o;
  iterative_->solve(x, guess);
  x_o = x;
}

}  // namespace hyperex::fem
