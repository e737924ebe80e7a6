// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/fem/solve/cholesky.hpp"
#include "hyperex/fem/solve/factor_memory.hpp"
#include "hyperex/fem/solve/node_order.hpp"
#include "hyperex/fem/solve/partition.hpp"

namespace hyperex::fem {

/// A symmetric positive definite matrix A whose unknowns are split into prescribed (c) and free
/// (o). Factors A_oo; A_oc is the caller's concern. Used by the static solver, the time integrators
/// and the reduced model. Must not be used by several threads at once.
class PartitionedFactor {
 public:
  /// `prescribed`: sorted unique unknowns. Throws NumericalError if A_oo is not positive definite
  /// to rounding, or if its factor does not fit in memory (factor_memory.hpp); the message begins
  /// with `purpose`: "static solution: ...". `order`: order() of another factor with the same
  /// pattern and prescribed unknowns, or null to find the order here.
  PartitionedFactor(const SparseMatrix& a, std::vector<int> prescribed, std::string purpose,
                    std::shared_ptr<const NodeOrder> order = nullptr);
  /// The same for a matrix that is not needed afterwards. Its memory is released before the
  /// numerical factorisation.
  PartitionedFactor(SparseMatrix&& a, std::vector<int> prescribed, std::string purpose,
                    std::shared_ptr<const NodeOrder> order = nullptr);

  /// Factors other values on the same pattern; ordering and analysis are reused.
  void refactor(const SparseMatrix& a);
  /// The same for repeated use: after the first call, nothing is allocated. Returns -1 on success,
  /// otherwise the unknown at which A_oo is not positive definite; the factor must then not be
  /// used.
  int try_refactor(const SparseMatrix& a);

  const Partition& partition() const { return partition_; }
  const std::vector<int>& prescribed() const { return partition_.prescribed; }
  const std::vector<int>& free() const { return partition_.free; }
  double analyse_seconds() const { return analyse_s_; }
  double factor_seconds() const { return factor_s_; }  ///< of the last factorisation

  const std::shared_ptr<const NodeOrder>& order() const { return order_; }
  const FactorForecast& forecast() const { return forecast_; }
  double factor_entries() const { return cholesky_->entries(); }  ///< stored numbers
  const Cholesky& cholesky() const { return *cholesky_; }

  /// x_o := A_oo^-1 x_o. Nothing is allocated.
  void solve(Eigen::VectorXd& x_o) { cholesky_->solve(x_o); }
  void solve(Eigen::MatrixXd& x_o) { cholesky_->solve(x_o); }
  /// The same for many columns, which are solved in groups. `between` (may be empty) is called
  /// before each group; it may throw to cancel.
  void solve(Eigen::MatrixXd& x_o, const std::function<void()>& between);

 private:
  void make(const SparseMatrix& a, SparseMatrix* spare);
  void analyse(const SparseMatrix& lower, double spare_bytes);
  void factor(const SparseMatrix& lower);
  void require_same_size(const SparseMatrix& a) const;
  int try_factor(const SparseMatrix& lower);

  Partition partition_;
  std::string purpose_;
  double analyse_s_ = 0, factor_s_ = 0;
  FactorForecast forecast_;
  std::shared_ptr<const NodeOrder> order_;
  std::optional<Cholesky> cholesky_;  // always there once constructed
  SparseMatrix lower_;                // workspace of try_refactor
};

}  // namespace hyperex::fem
