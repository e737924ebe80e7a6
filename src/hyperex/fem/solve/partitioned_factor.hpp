// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/fem/solve/cholesky.hpp"
#include "hyperex/fem/solve/partition.hpp"

namespace hyperex::fem {

/// A symmetric positive definite matrix A with its unknowns split into prescribed (c) and free (o):
/// A_oo factored, A_oc left to the caller. Shared by the static solver, the time integrator and the
/// reduced model. One caller at a time.
class PartitionedFactor {
 public:
  /// `prescribed`: sorted unique unknowns. `purpose` begins the message of the NumericalError
  /// thrown where A_oo is not positive definite, to rounding: "static solution: ...".
  PartitionedFactor(const SparseMatrix& a, std::vector<int> prescribed, std::string purpose);

  /// Other values on the same pattern: ordering and analysis are kept.
  void refactor(const SparseMatrix& a);

  const Partition& partition() const { return partition_; }
  const std::vector<int>& prescribed() const { return partition_.prescribed; }
  const std::vector<int>& free() const { return partition_.free; }
  double analyse_seconds() const { return analyse_s_; }
  double factor_seconds() const { return factor_s_; }  ///< of the last factorisation
  const Cholesky& cholesky() const { return cholesky_; }

  /// x_o := A_oo^-1 x_o. Allocates nothing.
  void solve(Eigen::VectorXd& x_o) { cholesky_.solve(x_o); }
  void solve(Eigen::MatrixXd& x_o) { cholesky_.solve(x_o); }

 private:
  Partition partition_;
  std::string purpose_;
  SparseMatrix lower_;
  double analyse_s_ = 0, factor_s_ = 0;
  Cholesky cholesky_;
};

}  // namespace hyperex::fem
