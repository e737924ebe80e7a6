// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <string>

#include "hyperex/fem/solve/schwarz.hpp"

namespace hyperex::fem {

struct IterativeOptions {
  /// Wanted |b - A x| / |b| of each right-hand side. Errors of the solution come out near it in the
  /// norm of the energy, a millionth of what the reduced model is asked for.
  double tolerance = 1e-10;
  int most_iterations = 1000;
  int subdomain_nodes = 2000;  ///< before they overlap
};

/// A_oo x = b by conjugate gradients on overlapping subdomains (schwarz.hpp), several right-hand
/// sides in step so that each pass over memory serves all. Memory and time grow with the number of
/// nodes, where a factor's grow faster. Numbers do not depend on the number of threads. One caller
/// at a time.
class IterativeSolver {
 public:
  /// `nodes`: positions (m) of all nodes of the mesh. `purpose` begins the messages of errors.
  IterativeSolver(const SparseMatrix& a, const Partition& partition, const Points& nodes,
                  std::string purpose, const IterativeOptions& options = {});

  /// Values on the pattern of the constructor's matrix. Returns -1, or the free unknown near which
  /// the matrix is not positive definite to rounding.
  int factorize(const SparseMatrix& a);

  /// x := A_oo^-1 x, from `guess` where it has columns. Throws NumericalError where a right-hand
  /// side does not converge.
  void solve(Eigen::MatrixXd& x, const Eigen::MatrixXd& guess = {});

  int last_iterations() const { return last_iterations_; }  ///< the most of the last call
  int subdomain_count() const { return schwarz_.subdomain_count(); }
  double entries() const { return schwarz_.factor_entries(); }  ///< of all factors, once factored

 private:
  void solve_together(Eigen::Ref<Eigen::MatrixXd> x, const Eigen::MatrixXd& guess,
                      Eigen::Index from);

  std::string purpose_;
  IterativeOptions options_;
  NodeBlocks a_;
  Schwarz schwarz_;
  int last_iterations_ = 0;
};

}  // namespace hyperex::fem
