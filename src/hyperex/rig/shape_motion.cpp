// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/rig/shape_motion.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "hyperex/expression/blend_shapes.hpp"
#include "hyperex/expression/shape_model.hpp"
#include "hyperex/face/ibug.hpp"

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

/// The mouthClose of real faces lifts the lower lip by more than jawOpen of the same weight lowers
/// it, up to 9 mm over the upper one. Here it is scaled so that the inner lips meet as they do at
/// rest. Between the three pairs of their landmarks, from right to left, the scale is linear.
Points closing_what_the_jaw_opens() {
  constexpr std::array pairs = {std::pair{61, 67}, std::pair{62, 66}, std::pair{63, 65}};
  const expression::FaceModel& face = canonical_model();
  const Points rest = expression::landmarks_on(face, face.mesh.points);
  const Points opened = by_real_faces("jawOpen");
  Points closed = by_real_faces("mouthClose");
  const auto row = [&](int ibug) {
    return std::distance(face.landmarks.begin(), face.landmarks.find(face::ibug(ibug)));
  };
  std::array<double, 3> x_m, scale;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Eigen::Index upper = row(pairs[i].first), lower = row(pairs[i].second);
    x_m[i] = rest(lower, 0);
    scale[i] = (opened(upper, 1) - opened(lower, 1)) / (closed(lower, 1) - closed(upper, 1));
  }
  for (Eigen::Index k = 0; k < closed.rows(); ++k) {
    const std::size_t i = rest(k, 0) < x_m[1] ? 0 : 1;
    const double share = std::clamp((rest(k, 0) - x_m[i]) / (x_m[i + 1] - x_m[i]), 0.0, 1.0);
    closed.row(k) *= (1 - share) * scale[i] + share * scale[i + 1];
  }
  return closed;
}

/// Displacements of the landmarks at weight 1.
Points landmarks_moved(const std::string& arkit) {
  if (arkit == "mouthClose") return closing_what_the_jaw_opens();
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
