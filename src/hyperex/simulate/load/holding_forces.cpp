// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/load/holding_forces.hpp"

#include <memory>

#include "hyperex/fem/solve/node_order.hpp"

namespace hyperex::simulate {

HeldShape holding_forces(const MuscleModel& model, const std::vector<int>& nodes,
                         const Eigen::MatrixXd& displaced, const std::function<void()>& between) {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const std::vector<int>& prescribed = model.boundary().prescribed();
  const std::vector<int> held = with_nodes(prescribed, nodes);
  fem::PartitionedFactor factor(
      model.stiffness(), held, "patches of the driven points",
      std::make_shared<const fem::NodeOrder>(
          restricted(*model.order(), int(model.stiffness().rows()), prescribed, held)));
  const auto unknown = [&](Eigen::Index row) { return 3 * nodes[row / 3] + int(row % 3); };
  const std::vector<int>& place = factor.partition().free_index;
  const Rows held_at = displaced;
  Rows right = Rows::Zero(Eigen::Index(factor.free().size()), displaced.cols());
  for (Eigen::Index row = 0; row < held_at.rows(); ++row)
    for (fem::SparseMatrix::InnerIterator it(model.stiffness(), unknown(row)); it; ++it)
      if (place[it.row()] >= 0) right.row(place[it.row()]) -= it.value() * held_at.row(row);
  Eigen::MatrixXd free = right;
  factor.solve(free, between);
  right = free;
  Rows moved = Rows::Zero(model.stiffness().rows(), displaced.cols());
  for (std::size_t i = 0; i < factor.free().size(); ++i)
    moved.row(factor.free()[i]) = right.row(Eigen::Index(i));
  for (Eigen::Index row = 0; row < held_at.rows(); ++row)
    moved.row(unknown(row)) = held_at.row(row);
  HeldShape out{Eigen::MatrixXd::Zero(model.stiffness().rows(), displaced.cols()),
                moved.topRows(3 * model.outer_nodes())};
  Eigen::RowVectorXd sum(displaced.cols());
  for (Eigen::Index row = 0; row < held_at.rows(); ++row) {
    sum.setZero();
    for (fem::SparseMatrix::InnerIterator it(model.stiffness(), unknown(row)); it; ++it)
      sum += it.value() * moved.row(it.row());
    out.force.row(unknown(row)) = sum;
  }
  return out;
}

}  // namespace hyperex::simulate
