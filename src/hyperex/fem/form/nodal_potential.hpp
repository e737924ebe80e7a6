// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>

#include "hyperex/fem/form/lists.hpp"
#include "hyperex/fem/form/system.hpp"

namespace hyperex::fem {

/// Access to the 3 x 3 blocks of a matrix that couples nodes. Potentials add to it.
class TangentBlocks {
 public:
  /// `neighbours`: for each node, the nodes that `matrix` couples it to, increasing. The blocks of
  /// the matrix have all nine entries.
  TangentBlocks(const Lists& neighbours, SparseMatrix& matrix)
      : neighbours_(neighbours), matrix_(matrix) {}

  void add(int node, const Eigen::Matrix3d& block) { add(node, node, block); }
  /// Adds `block` to the rows of node `row` and the columns of node `column`. The caller must also
  /// add the transposed block at (column, row). Returns false, and adds nothing, if the matrix does
  /// not couple the two nodes.
  bool add(int row, int column, const Eigen::Matrix3d& block) {
    const auto list = neighbours_[column];
    const auto at = std::lower_bound(list.begin(), list.end(), row);
    if (at == list.end() || *at != row) return false;
    const auto slot = 3 * (at - list.begin());
    for (int axis = 0; axis < 3; ++axis)
      for (int k = 0; k < 3; ++k)
        matrix_.valuePtr()[matrix_.outerIndexPtr()[3 * column + axis] + slot + k] += block(k, axis);
    return true;
  }

 private:
  const Lists& neighbours_;
  SparseMatrix& matrix_;
};

/// An energy that depends on the displacements of the nodes, in addition to that of the tissue:
/// contact with a rigid body, or sliding around a bone. d has 3 |nodes| rows, with unknown 3 n +
/// axis. Evaluated once in each iteration; must not allocate memory then.
class NodalPotential {
 public:
  virtual ~NodalPotential() = default;
  /// Adds the energy's gradient (N) at d (m); returns the energy (J). Must be continuously
  /// differentiable.
  virtual double add_gradient(const Eigen::VectorXd& d, Eigen::VectorXd& gradient) const = 0;
  /// Adds second derivatives (N/m), or a positive semidefinite part of them.
  virtual void add_tangent(const Eigen::VectorXd& d, TangentBlocks& blocks) const = 0;
};

}  // namespace hyperex::fem
