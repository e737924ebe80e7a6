// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <vector>

#include "hyperex/fem/form/assembler.hpp"

namespace hyperex::fem {

/// How far the tissue at each node has rotated since a matrix was factored. Where tissue rotates
/// without further strain, its tangent stiffness K becomes R K R', with the rotation R of each
/// node. R K^-1 R' is thus a good approximation of the inverse long after K^-1 is not. It is used
/// in the corotational method for the stiffness at rest (Mueller et al., Stable real-time
/// deformations, SCA 2002).
class FactorTurns {
 public:
  /// `assembler` must outlive this.
  explicit FactorTurns(const Assembler& assembler);

  /// The matrix is factored at displacement d (3 |nodes|, m): no node has rotated since.
  void factored_at(const Eigen::VectorXd& d);
  /// The tissue is displaced by d now. Allocates nothing.
  void update(const Eigen::VectorXd& d);

  /// v := R v, or R' v. `unknowns`: rising, 3 n + axis, one per row of v. Rows of a node whose
  /// three unknowns are not all among them stay as they are.
  void turn(const std::vector<int>& unknowns, Eigen::VectorXd& v) const;
  void turn_back(const std::vector<int>& unknowns, Eigen::VectorXd& v) const;

 private:
  template <typename Turn>
  void for_nodes(const std::vector<int>& unknowns, const Turn& turn) const;

  const Assembler& assembler_;
  std::vector<Eigen::Matrix3d> at_factor_, since_;
  bool turned_ = false;
};

}  // namespace hyperex::fem
