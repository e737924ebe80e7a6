// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/fem/reduced/dense.hpp"

namespace hyperex::fem {

/// Vectors orthonormal in the product of K (to rounding of the weakest), zero on the prescribed
/// unknowns, with K, C and M applied to them and projected onto them.
class Basis {
 public:
  explicit Basis(const System& system) : system_(system) {}

  /// Takes in the directions of shapes (all unknowns) that the basis lacks, the strongest first,
  /// but none whose part in any shape moves any unknown by less than `least` (m). The shapes are
  /// the columns of `w` or, where there are more of them than directions, those of w `mix`, the
  /// rows of `mix` orthonormal.
  struct Grown {
    int taken = 0;       ///< how many directions
    double skipped = 0;  ///< by how much those left out move any unknown together, at most (m)
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
