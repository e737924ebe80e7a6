// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "hyperex/fem/form/system.hpp"

namespace hyperex::fem {

/// L L^T of a sparse symmetric positive definite matrix: ordered by METIS and analysed in
/// supernodes by CHOLMOD. The numbers are found by a multifrontal kernel (multifrontal.hpp), which
/// takes a third of the time of CHOLMOD's on two cores; one right-hand side is solved by a kernel
/// that reads the factor twice with both cores (triangular.hpp), several by CHOLMOD, half of them
/// on each core. One caller at a time.
class Cholesky {
 public:
  /// Orders and analyses the pattern of `lower` (lower triangle, columns sorted, diagonal stored).
  /// `purpose` begins the messages of its errors: "static solution: ...". `order`: the k-th column
  /// to eliminate (node_order.hpp); empty: found here, on the graph of unknowns, by METIS.
  Cholesky(const SparseMatrix& lower, std::string purpose, std::vector<int> order = {});
  ~Cholesky();
  Cholesky(Cholesky&&) noexcept;
  Cholesky& operator=(Cholesky&&) noexcept;

  /// Factors values on the analysed pattern; may be called again. Returns -1, or the column in
  /// which the matrix is not positive definite to rounding: the factor is then of no use. Throws
  /// NumericalError where memory runs out.
  int factorize(const SparseMatrix& lower);

  /// x := A^-1 x. Allocates nothing.
  void solve(Eigen::VectorXd& x);
  /// X := A^-1 X, the columns together: several times quicker than one after the other.
  void solve(Eigen::MatrixXd& x);

  /// Of the columns eliminated last, `columns` of them in rising order: the rows and columns of
  /// A^-1 that belong to them. What is left of the factor for them alone is inverted: no solution
  /// is needed. No rows where others are among the last (the order given is changed within
  /// branches of the elimination tree alone).
  Eigen::MatrixXd inverse_of_last(const std::vector<int>& columns) const;

  int size() const;
  double entries() const;         ///< of L, the zeros that supernodes store included
  double entries_needed() const;  ///< of L as analysed, without them
  double flops() const;           ///< of one factorisation

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hyperex::fem
