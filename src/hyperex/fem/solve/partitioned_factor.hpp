// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/core/assert.hpp"
#include "hyperex/fem/solve/cholesky.hpp"
#include "hyperex/fem/solve/iterative_solver.hpp"
#include "hyperex/fem/solve/linear_solver.hpp"
#include "hyperex/fem/solve/node_order.hpp"
#include "hyperex/fem/solve/partition.hpp"

namespace hyperex::fem {

/// A symmetric positive definite matrix A with its unknowns split into prescribed (c) and free (o):
/// A_oo made ready for solving, A_oc left to the caller. Shared by the static solver, the time
/// integrator and the reduced model. One caller at a time.
class PartitionedFactor {
 public:
  /// `prescribed`: sorted unique unknowns. `purpose` begins the message of the NumericalError
  /// thrown where A_oo is not positive definite, to rounding: "static solution: ...".
  /// `nodes`: positions (m), which the iterative solver needs; without them (no rows) it is not
  /// picked, and asking for it is an error of the caller: asserted.
  /// `order`: order() of a factor of the same pattern and prescribed unknowns; null: found here.
  PartitionedFactor(const SparseMatrix& a, std::vector<int> prescribed, std::string purpose,
                    const Points& nodes = {}, LinearSolver wanted = LinearSolver::automatic,
                    std::shared_ptr<const NodeOrder> order = nullptr);
  /// The same for a matrix that nobody else needs: it goes as soon as its factor can do without.
  PartitionedFactor(SparseMatrix&& a, std::vector<int> prescribed, std::string purpose,
                    const Points& nodes = {}, LinearSolver wanted = LinearSolver::automatic,
                    std::shared_ptr<const NodeOrder> order = nullptr);

  /// Other values on the same pattern: ordering and analysis are kept.
  void refactor(const SparseMatrix& a);
  /// The same again and again: after the first time nothing is allocated with Cholesky. Returns -1,
  /// or the unknown at which A_oo is not positive definite: the factor is then of no use.
  int try_refactor(const SparseMatrix& a);

  const Partition& partition() const { return partition_; }
  const std::vector<int>& prescribed() const { return partition_.prescribed; }
  const std::vector<int>& free() const { return partition_.free; }
  double analyse_seconds() const { return analyse_s_; }
  double factor_seconds() const { return factor_s_; }  ///< of the last factorisation

  LinearSolver solver() const;  ///< cholesky or iterative
  const std::shared_ptr<const NodeOrder>& order() const { return order_; }
  const FactorForecast& forecast() const { return forecast_; }
  /// Numbers stored by the factor or, together, by those of the subdomains.
  double factor_entries() const;
  int last_iterations() const { return iterative_ ? iterative_->last_iterations() : 0; }
  /// Only where solver() is cholesky.
  const Cholesky& cholesky() const {
    HX_ASSERT(cholesky_);
    return *cholesky_;
  }

  /// x_o := A_oo^-1 x_o. With Cholesky nothing is allocated.
  void solve(Eigen::VectorXd& x_o);
  void solve(Eigen::MatrixXd& x_o);
  /// The same for many columns, some at a time: `between` (may be empty) is called before each part
  /// and may throw, which ends it.
  void solve(Eigen::MatrixXd& x_o, const std::function<void()>& between);
  /// The same for a solution expected near `guess`: saves iterations.
  void solve(Eigen::VectorXd& x_o, const Eigen::VectorXd& guess);

 private:
  void make(const SparseMatrix& a, SparseMatrix* spare, const Points& nodes, LinearSolver wanted);
  void pick(const SparseMatrix& a, const SparseMatrix& lower, const Points& nodes,
            LinearSolver wanted, double spare_bytes);
  void factor(const SparseMatrix& a, const SparseMatrix& lower);
  int try_factor(const SparseMatrix& a, const SparseMatrix& lower);

  Partition partition_;
  std::string purpose_;
  double analyse_s_ = 0, factor_s_ = 0;
  FactorForecast forecast_;
  std::shared_ptr<const NodeOrder> order_;
  std::optional<Cholesky> cholesky_;
  std::optional<IterativeSolver> iterative_;
  SparseMatrix lower_;  // of try_refactor
};

}  // namespace hyperex::fem
