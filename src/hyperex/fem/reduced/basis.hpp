// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/fem/reduced/dense.hpp"

namespace hyperex::fem {

/// A set of vectors that are zero on the prescribed unknowns and orthonormal in the K inner product
/// (up to rounding of the weakest). Also holds K, C and M applied to them and projected onto them.
class Basis {
 public:
  explicit Basis(const System& system) : system_(system) {}

  /// Extends the basis by directions of the given shapes (all unknowns) that it does not yet
  /// contain, in decreasing order of energy. A direction is skipped if its contribution to every
  /// shape moves each unknown by less than `least` (m); for the first six added, a hundredth of it.
  /// The shapes are the columns of `w`, or those of w `mix` if there are more shapes than
  /// directions; the rows of `mix` are orthonormal.
  struct Grown {
    int taken = 0;  ///< number of directions added
    /// Bound of the motion of any unknown by all skipped directions together (m).
    double skipped = 0;
  };
  Grown grow(Eigen::MatrixXd w, double least);
  Grown grow(Eigen::MatrixXd w, const Eigen::MatrixXd& mix, double least);

  int size() const { return size_; }
  auto vectors() const { return vectors_.leftCols(size_); }
  auto k_vectors() const { return k_.leftCols(size_); }
  auto c_vectors() const { return c_.leftCols(size_); }
  auto m_vectors() const { return m_.leftCols(size_); }
  const Eigen::MatrixXd& stiffness() const { return stiffness_; }  ///< size x size
  const Eigen::MatrixXd& damping() const { return damping_; }
  const Eigen::MatrixXd& mass() const { return mass_; }

 private:
  void append(const Eigen::MatrixXd& more, const Eigen::MatrixXd& k_more);

  const System& system_;
  int size_ = 0;
  Eigen::MatrixXd vectors_, k_, c_, m_;  // 3 |nodes| x capacity
  Eigen::MatrixXd stiffness_, damping_, mass_;
};

}  // namespace hyperex::fem
