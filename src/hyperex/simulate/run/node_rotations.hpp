// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/fem/form/assembler.hpp"

namespace hyperex::simulate {

/// The rotation of the tissue at nodes (fem::node_rotation).
class NodeRotations {
 public:
  /// For the nodes on which any of the forces (columns of 3 |nodes| rows) act. `assembler` must
  /// outlive this.
  NodeRotations(const fem::Assembler& assembler, const Eigen::MatrixXd& forces);
  /// At displacement d (3 |nodes|, m).
  void update(const Eigen::VectorXd& d);
  /// out += the rotated `force` (3 |nodes|, one of the forces or a sum of them).
  void add_turned(const Eigen::VectorXd& force, Eigen::VectorXd& out) const;

 private:
  const fem::Assembler& assembler_;
  std::vector<int> nodes_;
  std::vector<Eigen::Matrix3d> rotation_;  // of each of nodes_
};

}  // namespace hyperex::simulate
