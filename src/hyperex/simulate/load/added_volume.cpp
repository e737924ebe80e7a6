// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/load/added_volume.hpp"

#include "hyperex/core/assert.hpp"

namespace hyperex::simulate {

std::vector<Eigen::Matrix3d> growth_through_layer(const tissue::VolumeMesh& mesh,
                                                  const std::vector<double>& volume_ratio) {
  HX_ASSERT(Eigen::Index(volume_ratio.size()) == mesh.tets.rows());
  std::vector<Eigen::Matrix3d> growth(volume_ratio.size());
  for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t) {
    Vec3 outwards = Vec3::Zero();
    for (int k = 0; k < 4; ++k) {
      const auto vertex = int(mesh.tets(t, k) % mesh.surface_nodes());
      outwards += mesh.nodes.row(vertex) - mesh.nodes.row(mesh.inner_node(vertex));
    }
    outwards.normalize();
    growth[std::size_t(t)] = Eigen::Matrix3d::Identity() +
                             (volume_ratio[std::size_t(t)] - 1) * outwards * outwards.transpose();
  }
  return growth;
}

}  // namespace hyperex::simulate
