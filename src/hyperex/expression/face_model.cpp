// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/expression/face_model.hpp"

#include "hyperex/core/assert.hpp"

namespace hyperex::expression {

int FaceModel::animation_unit(const std::string& unit_name) const {
  for (std::size_t k = 0; k < animation_units.size(); ++k)
    if (animation_units[k].name == unit_name) return int(k);
  return -1;
}

Points deformed(const Points& base, const std::vector<DeformationUnit>& units,
                const Eigen::VectorXd& weights) {
  HX_ASSERT(weights.size() == Eigen::Index(units.size()));
  Points points = base;
  for (std::size_t k = 0; k < units.size(); ++k) {
    const double weight = weights[Eigen::Index(k)];
    if (weight == 0) continue;
    for (std::size_t i = 0; i < units[k].vertices.size(); ++i)
      points.row(units[k].vertices[i]) += weight * units[k].displacement_m.row(Eigen::Index(i));
  }
  return points;
}

Vec3 landmark_at(const std::vector<int>& vertices, const Points& points) {
  HX_ASSERT(!vertices.empty());
  Vec3 sum = Vec3::Zero();
  for (const int vertex : vertices) sum += points.row(vertex).transpose();
  return sum / double(vertices.size());
}

Points landmarks_on(const FaceModel& model, const Points& points) {
  Points on(Eigen::Index(model.landmarks.size()), 3);
  Eigen::Index row = 0;
  for (const auto& [name, vertices] : model.landmarks)
    on.row(row++) = landmark_at(vertices, points).transpose();
  return on;
}

}  // namespace hyperex::expression
