// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/form/node_rotation.hpp"

#include <Eigen/LU>

namespace hyperex::fem {
namespace {

constexpr int kMostPolarSteps = 20;
constexpr double kEnough = 1e-10;

}  // namespace

Eigen::Matrix3d node_rotation(const Assembler& assembler, const Eigen::VectorXd& d, int node,
                              const Eigen::Matrix3d& last) {
  Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
  double volume = 0;
  for (const int t : assembler.tets_around()[std::size_t(node)]) {
    const Tet4& shape = assembler.shapes()[std::size_t(t)];
    const auto& corner = assembler.corners()[std::size_t(t)];
    for (int a = 0; a < 4; ++a)
      mean += shape.volume * d.segment<3>(3 * corner[std::size_t(a)]) * shape.gradient.row(a);
    mean += shape.volume * assembler.gradient_of_mesh(t);
    volume += shape.volume;
  }
  mean /= volume;
  if (!(mean.determinant() > 0)) return last;
  for (int k = 0; k < kMostPolarSteps; ++k) {
    const Eigen::Matrix3d next = 0.5 * (mean + mean.inverse().transpose());
    const double change = (next - mean).cwiseAbs().maxCoeff();
    mean = next;
    if (change < kEnough) break;
  }
  return mean;
}

}  // namespace hyperex::fem
