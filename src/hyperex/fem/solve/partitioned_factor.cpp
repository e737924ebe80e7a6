// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/partitioned_factor.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hyperex/core/error.hpp"
#include "hyperex/core/stopwatch.hpp"
#include "hyperex/fem/material/entry.hpp"

namespace hyperex::fem {

PartitionedFactor::PartitionedFactor(const SparseMatrix& a, std::vector<int> prescribed,
                                     std::string purpose, std::shared_ptr<const NodeOrder> order)
    : partition_(static_cast<int>(a.cols()), std::move(prescribed)),
      purpose_(std::move(purpose)),
      order_(std::move(order)) {
  make(a, nullptr);
}

PartitionedFactor::PartitionedFactor(SparseMatrix&& a, std::vector<int> prescribed,
                                     std::string purpose, std::shared_ptr<const NodeOrder> order)
    : partition_(static_cast<int>(a.cols()), std::move(prescribed)),
      purpose_(std::move(purpose)),
      order_(std::move(order)) {
  make(a, &a);
}

void PartitionedFactor::make(const SparseMatrix& a, SparseMatrix* spare) {
  require(a.rows() == a.cols(), "{}: the matrix is {} x {}: expected a square one", purpose_,
          a.rows(), a.cols());
  Stopwatch watch;
  const SparseMatrix lower = free_lower(a, partition_);
  constexpr double entry_bytes = sizeof(double) + sizeof(int);
  analyse(lower, spare ? entry_bytes * static_cast<double>(a.nonZeros()) : 0);
  if (spare) taken(*spare);
  analyse_s_ = watch.lap();
  factor(lower);
}

void PartitionedFactor::analyse(const SparseMatrix& lower, double spare_bytes) {
  std::vector<int> node_of(free().size());
  for (std::size_t i = 0; i < node_of.size(); ++i) node_of[i] = free()[i] / 3;
  if (!order_) order_ = std::make_shared<const NodeOrder>(order_by_nodes(lower, node_of));
  require(order_->unknowns.size() == free().size(),
          "{}: the order of elimination has {} unknowns: expected the {} free ones", purpose_,
          order_->unknowns.size(), free().size());
  forecast_ = {order_->entries, order_->flops, static_cast<double>(lower.nonZeros())};
  check_factor_fits(forecast_, available_memory_bytes() + spare_bytes, purpose_);
  cholesky_.emplace(lower, purpose_, order_->unknowns);
}

void PartitionedFactor::refactor(const SparseMatrix& a) {
  require_same_size(a);
  Stopwatch watch;
  const SparseMatrix lower = free_lower(a, partition_);
  const double extract_s = watch.lap();
  factor(lower);
  factor_s_ += extract_s;
}

void PartitionedFactor::require_same_size(const SparseMatrix& a) const {
  require(a.cols() == partition_.unknowns() && a.rows() == a.cols(),
          "{}: the matrix is {} x {}: expected {} unknowns as before", purpose_, a.rows(), a.cols(),
          partition_.unknowns());
}

int PartitionedFactor::try_refactor(const SparseMatrix& a) {
  require_same_size(a);
  Stopwatch watch;
  if (lower_.cols() == 0)
    lower_ = free_lower(a, partition_);
  else
    refill_free_lower(a, partition_, lower_);
  const double extract_s = watch.lap();
  const int lost = try_factor(lower_);
  factor_s_ += extract_s;
  return lost;
}

/// Returns -1 on success, otherwise the unknown at which the matrix is not positive definite.
int PartitionedFactor::try_factor(const SparseMatrix& lower) {
  Stopwatch watch;
  const int lost = cholesky_->factorize(lower);
  factor_s_ = watch.lap();
  return lost < 0 ? -1 : free()[lost];
}

void PartitionedFactor::factor(const SparseMatrix& lower) {
  const int unknown = try_factor(lower);
  if (unknown < 0) return;
  throw NumericalError(fmt::format(
      "{}: the matrix of the {} free unknowns is not positive definite (seen at node {}, axis {}): "
      "too few supports to hold every part of the mesh ({} unknowns are prescribed), or a node "
      "that no element uses",
      purpose_, free().size(), unknown / 3, "xyz"[unknown % 3], prescribed().size()));
}

void PartitionedFactor::solve(Eigen::MatrixXd& x_o, const std::function<void()>& between) {
  constexpr Eigen::Index kColumns = 32;  // enough for fast matrix products
  for (Eigen::Index from = 0; from < x_o.cols(); from += kColumns) {
    if (between) between();
    auto some = x_o.middleCols(from, std::min(kColumns, x_o.cols() - from));
    Eigen::MatrixXd part = some;
    solve(part);
    some = part;
  }
}

}  // namespace hyperex::fem
