// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/model/unit_matrix.hpp"

namespace hyperex::tracking {

UnitMatrix unit_matrix(const FaceModel& model) {
  const Eigen::Index units = Eigen::Index(model.animation_units.size());
  UnitMatrix matrix = UnitMatrix::Zero(3 * model.vertex_count(), units);
  for (Eigen::Index k = 0; k < units; ++k) {
    const DeformationUnit& unit = model.animation_units[std::size_t(k)];
    for (std::size_t i = 0; i < unit.vertices.size(); ++i)
      matrix.block<3, 1>(3 * unit.vertices[i], k) =
          unit.displacement_m.row(Eigen::Index(i)).transpose();
  }
  return matrix;
}

Eigen::VectorXd typical_weights(const FaceModel& model) {
  Eigen::VectorXd typical(Eigen::Index(model.animation_units.size()));
  for (Eigen::Index k = 0; k < typical.size(); ++k)
    typical[k] = model.animation_units[std::size_t(k)].typical;
  return typical;
}

}  // namespace hyperex::tracking
