// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/load/holding_forces.hpp"

#include <memory>
#include <utility>

#include "hyperex/fem/solve/node_order.hpp"

namespace hyperex::simulate {
namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The stiffness of the spring that draws each node to its place, N/m; 0 where it moves exactly.
Eigen::VectorXd springs(const MuscleModel& model, const std::vector<int>& nodes,
                        const Eigen::VectorXd& hold) {
  Eigen::VectorXd spring(hold.size());
  for (Eigen::Index j = 0; j < hold.size(); ++j) {
    double own = 0;
    for (int k = 0; k < 3; ++k) {
      const int unknown = 3 * nodes[std::size_t(j)] + k;
      own += model.stiffness().coeff(unknown, unknown) / 3;
    }
    spring[j] = hold[j] < 1 ? own * hold[j] / (1 - hold[j]) : 0;
  }
  return spring;
}

}  // namespace

Eigen::VectorXd exactly(const std::vector<int>& nodes) {
  return Eigen::VectorXd::Ones(Eigen::Index(nodes.size()));
}

HeldShape holding_forces(const MuscleModel& model, const std::vector<int>& nodes,
                         const Eigen::VectorXd& hold, const Eigen::MatrixXd& displaced,
                         const std::function<void()>& between) {
  const Eigen::VectorXd spring = springs(model, nodes, hold);
  const auto unknown = [&](Eigen::Index row) { return 3 * nodes[row / 3] + int(row % 3); };
  fem::SparseMatrix stiffness = model.stiffness();
  std::vector<int> exact;
  for (Eigen::Index j = 0; j < hold.size(); ++j)
    if (hold[j] == 1)
      exact.push_back(nodes[std::size_t(j)]);
    else
      for (Eigen::Index row = 3 * j; row < 3 * j + 3; ++row)
        stiffness.coeffRef(unknown(row), unknown(row)) += spring[j];
  const std::vector<int>& prescribed = model.boundary().prescribed();
  const std::vector<int> held = with_nodes(prescribed, exact);
  fem::PartitionedFactor factor(
      std::move(stiffness), held, "patches of the driven points",
      std::make_shared<const fem::NodeOrder>(
          restricted(*model.order(), int(model.stiffness().rows()), prescribed, held)));
  const std::vector<int>& place = factor.partition().free_index;
  const Rows held_at = displaced;
  Rows right = Rows::Zero(Eigen::Index(factor.free().size()), displaced.cols());
  for (Eigen::Index row = 0; row < held_at.rows(); ++row) {
    if (hold[row / 3] < 1) {
      right.row(place[unknown(row)]) += spring[row / 3] * held_at.row(row);
      continue;
    }
    for (fem::SparseMatrix::InnerIterator it(model.stiffness(), unknown(row)); it; ++it)
      if (place[it.row()] >= 0) right.row(place[it.row()]) -= it.value() * held_at.row(row);
  }
  Eigen::MatrixXd free = right;
  factor.solve(free, between);
  right = free;
  Rows moved = Rows::Zero(model.stiffness().rows(), displaced.cols());
  for (std::size_t i = 0; i < factor.free().size(); ++i)
    moved.row(factor.free()[i]) = right.row(Eigen::Index(i));
  for (Eigen::Index row = 0; row < held_at.rows(); ++row)
    if (hold[row / 3] == 1) moved.row(unknown(row)) = held_at.row(row);
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
