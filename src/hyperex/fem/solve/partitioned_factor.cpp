// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/partitioned_factor.hpp"

#include <fmt/format.h>

#include <chrono>

#include "hyperex/core/error.hpp"

namespace hyperex::fem {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Cholesky analysed(const SparseMatrix& lower, const std::string& purpose, double& seconds) {
  const auto start = std::chrono::steady_clock::now();
  Cholesky cholesky(lower, purpose);
  seconds = seconds_since(start);
  return cholesky;
}

}  // namespace

PartitionedFactor::PartitionedFactor(const SparseMatrix& a, std::vector<int> prescribed,
                                     std::string purpose)
    : partition_(static_cast<int>(a.cols()), std::move(prescribed)),
      purpose_(std::move(purpose)),
      lower_(free_lower(a, partition_)),
      cholesky_(analysed(lower_, purpose_, analyse_s_)) {
  refactor(a);
}

void PartitionedFactor::refactor(const SparseMatrix& a) {
  lower_ = free_lower(a, partition_);
  const auto start = std::chrono::steady_clock::now();
  const int lost = cholesky_.factorize(lower_);
  factor_s_ = seconds_since(start);
  if (lost < 0) return;
  const int unknown = free()[lost];
  throw NumericalError(fmt::format(
      "{}: the matrix of the {} free unknowns is not positive definite (seen at node {}, axis {}): "
      "too few supports to hold every part of the mesh ({} unknowns are prescribed), or a node "
      "that no element uses",
      purpose_, free().size(), unknown / 3, "xyz"[unknown % 3], prescribed().size()));
}

}  // namespace hyperex::fem
