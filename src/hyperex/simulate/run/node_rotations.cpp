// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/run/node_rotations.hpp"

#include <tbb/parallel_for.h>

#include "hyperex/fem/form/node_rotation.hpp"

namespace hyperex::simulate {
namespace {
/// Forces smaller than this share of the greatest act nowhere.
constexpr double kNoForce = 1e-9;
}  // namespace

NodeRotations::NodeRotations(const fem::Assembler& assembler, const Eigen::MatrixXd& forces)
    : assembler_(assembler) {
  if (forces.cols() == 0) return;
  const Eigen::VectorXd size = forces.rowwise().lpNorm<Eigen::Infinity>();
  for (int n = 0; n < assembler.node_count(); ++n)
    if (size.segment<3>(3 * n).maxCoeff() > kNoForce * size.maxCoeff()) nodes_.push_back(n);
  rotation_.assign(nodes_.size(), Eigen::Matrix3d::Identity());
}

void NodeRotations::update(const Eigen::VectorXd& d) {
  tbb::parallel_for(std::size_t(0), nodes_.size(), [&](std::size_t i) {
    rotation_[i] = fem::node_rotation(assembler_, d, nodes_[i], rotation_[i]);
  });
}

void NodeRotations::add_turned(const Eigen::VectorXd& force, Eigen::VectorXd& out) const {
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    out.segment<3>(3 * nodes_[i]) += rotation_[i] * force.segment<3>(3 * nodes_[i]);
}

}  // namespace hyperex::simulate
