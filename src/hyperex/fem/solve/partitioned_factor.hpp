// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "hyperex/fem/form/system.hpp"

namespace hyperex::fem {

/// A symmetric positive definite matrix A with its unknowns split into prescribed (c) and free (o):
/// A_oo factored once by CHOLMOD (supernodal), A_oc kept for the right-hand sides [4.37].
/// Shared by the static solver and the time integrator. One caller at a time.
class PartitionedFactor {
 public:
  /// `prescribed`: sorted unique unknowns. `purpose` begins the message of the NumericalError
  /// thrown where A_oo is not positive definite, to rounding: "static solution: ...".
  PartitionedFactor(const SparseMatrix& a, std::vector<int> prescribed, const std::string& purpose);
  ~PartitionedFactor();
  PartitionedFactor(PartitionedFactor&&) noexcept;

  const std::vector<int>& prescribed() const;
  const std::vector<int>& free() const;  ///< sorted
  double factor_seconds() const;         ///< ordering, analysis and factorisation

  /// x_o = A_oo^-1 (b_o - A_oc x_c), in place: `x_o` comes in as b_o. Allocates nothing after its
  /// first call.
  void solve(const Eigen::VectorXd& x_c, Eigen::VectorXd& x_o);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hyperex::fem
