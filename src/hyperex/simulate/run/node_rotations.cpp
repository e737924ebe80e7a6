// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/run/node_rotations.hpp"

#include <tbb/parallel_for.h>

namespace hyperex::simulate {
namespace {
/// Forces smaller than this share of the greatest act nowhere.
constexpr double kNoForce = 1e-9;
constexpr int kMostPolarSteps = 20;
constexpr double kEnough = 1e-10;
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
    Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
    double volume = 0;
    for (const int t : assembler_.tets_around()[nodes_[i]]) {
      const fem::Tet4& shape = assembler_.shapes()[std::size_t(t)];
      const auto& corner = assembler_.corners()[std::size_t(t)];
      for (int a = 0; a < 4; ++a)
        mean += shape.volume * d.segment<3>(3 * corner[std::size_t(a)]) * shape.gradient.row(a);
      volume += shape.volume;
    }
    mean = mean / volume + Eigen::Matrix3d::Identity();
    if (!(mean.determinant() > 0)) return;
    for (int k = 0; k < kMostPolarSteps; ++k) {
      const Eigen::Matrix3d next = 0.5 * (mean + mean.inverse().transpose());
      const double change = (next - mean).cwiseAbs().maxCoeff();
      mean = next;
      if (change < kEnough) break;
    }
    rotation_[i] = mean;
  });
}

void NodeRotations::add_turned(const Eigen::VectorXd& force, Eigen::VectorXd& out) const {
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    out.segment<3>(3 * nodes_[i]) += rotation_[i] * force.segment<3>(3 * nodes_[i]);
}

}  // namespace hyperex::simulate
