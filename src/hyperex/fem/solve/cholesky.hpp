// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "hyperex/fem/form/system.hpp"

namespace hyperex::fem {

/// Cholesky factorisation L L^T of a sparse symmetric positive definite matrix, ordered by METIS
/// and analysed in supernodes by CHOLMOD. The numerical factorisation is multifrontal
/// (multifrontal.hpp) and takes a third of CHOLMOD's time on two cores. A single right-hand side is
/// solved by a kernel that reads the factor twice, using both cores (triangular.hpp). Several
/// right-hand sides are solved by CHOLMOD, half of them on each core. Must not be used by several
/// threads at once.
class Cholesky {
 public:
  /// Orders and analyses the pattern of `lower` (lower triangle, columns sorted, diagonal stored).
  /// Error messages begin with `purpose`: "static solution: ...". `order`: the k-th column to
  /// eliminate (node_order.hpp). If it is empty, METIS finds an order on the graph of unknowns.
  Cholesky(const SparseMatrix& lower, std::string purpose, std::vector<int> order = {});
  ~Cholesky();
  Cholesky(Cholesky&&) noexcept;
  Cholesky& operator=(Cholesky&&) noexcept;

  /// Factors a matrix with the analysed pattern; may be called repeatedly. Returns -1 on success,
  /// otherwise the column at which the matrix is not positive definite to rounding; the factor must
  /// then not be used. Throws NumericalError if memory runs out.
  int factorize(const SparseMatrix& lower);

  /// x := A^-1 x. Allocates nothing.
  void solve(Eigen::VectorXd& x);
  /// X := A^-1 X. Solving all columns together is several times faster than one after the other.
  void solve(Eigen::MatrixXd& x);

  /// The rows and columns of A^-1 that belong to `columns` (increasing), which must be the columns
  /// eliminated last. Only the trailing block of the factor is inverted, so that no solve is
  /// needed. Returns a matrix without rows if other columns are among the last ones. (The order
  /// given to the constructor is changed only within branches of the elimination tree.)
  Eigen::MatrixXd inverse_of_last(const std::vector<int>& columns) const;

  int size() const;
  double entries() const;         ///< of L, including the zeros stored in supernodes
  double entries_needed() const;  ///< of L as analysed, without those zeros
  double flops() const;           ///< of one factorisation

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hyperex::fem
