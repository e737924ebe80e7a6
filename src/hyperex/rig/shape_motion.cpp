// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/rig/shape_motion.hpp"

#include <algorithm>
#include <map>

#include "hyperex/expression/blend_shapes.hpp"
#include "hyperex/expression/shape_model.hpp"

namespace hyperex::rig {
namespace {

using expression::canonical_model;

/// The displacements by the shape of this name in the shapes of real faces, or by those of both
/// sides. Zero if there is no such shape.
Points by_real_faces(const std::string& arkit) {
  const expression::ShapeModel& model = expression::shape_model();
  const Points& rest = canonical_model().mesh.points;
  Points moved = Points::Zero(rest.rows(), 3);
  std::string stem = arkit;
  std::vector<std::string> sides = {"", "_L", "_R"};
  for (const auto& [side, mark] : {std::pair{"Left", "_L"}, {"Right", "_R"}})
    if (arkit.ends_with(side) && !arkit.starts_with("jaw") &&
        arkit != std::string("mouth") + side) {
      stem = arkit.substr(0, arkit.size() - std::string(side).size());
      sides = {mark};
    }
  for (const std::string& side : sides) {
    const auto at = std::ranges::find(model.names, stem + side);
    if (at == model.names.end()) continue;
    const Eigen::VectorXd column = model.displacement.col(at - model.names.begin());
    moved += Eigen::Map<const Points>(column.data(), rest.rows(), 3);
  }
  return expression::landmarks_on(canonical_model(), rest + moved) -
         expression::landmarks_on(canonical_model(), rest);
}

/// By the canonical face's own units.
Points by_units(const std::string& arkit) {
  expression::BlendShapes shapes;
  shapes.names = {arkit};
  shapes.time_s = {0, 1};
  shapes.weights = Eigen::MatrixXd::Zero(2, 1);
  shapes.weights(1, 0) = 1;
  std::vector<std::string> notes;
  const motion::Motion moved = expression::motion_of(shapes, canonical_model(), notes);
  return moved.positions[1] - moved.positions[0];
}

/// Displacements of the landmarks at weight 1.
Points landmarks_moved(const std::string& arkit) {
  const bool of_lids = arkit.starts_with("eye");
  return of_lids ? by_units(arkit) : by_real_faces(arkit);
}

}  // namespace

motion::Motion motion_through(std::vector<Pose>& poses) {
  constexpr double reached_s = 0.4, left_s = 0.8, rest_s = 1;
  const Points rest = expression::landmarks_on(canonical_model(), canonical_model().mesh.points);
  motion::Motion out;
  out.source = "blend shapes one after the other";
  for (const auto& [name, vertices] : canonical_model().landmarks) out.names.push_back(name);
  out.time_s = {0};
  out.positions = {rest};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Points moved = rest;
    for (const auto& [shape, weight] : poses[i].weights) moved += weight * landmarks_moved(shape);
    const auto add = [&](double after_s, const Points& at) {
      out.time_s.push_back(double(i) + after_s);
      out.positions.push_back(at);
    };
    add(reached_s, moved);
    add((reached_s + left_s) / 2, moved);
    add(left_s, moved);
    add(rest_s, rest);
    poses[i].time_s = double(i) + left_s;
  }
  return out;
}

}  // namespace hyperex::rig
