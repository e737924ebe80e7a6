// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/expression/rig_model.hpp"

#include <algorithm>
#include <numeric>

#include "hyperex/core/error.hpp"
#include "hyperex/expression/arkit_names.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/sided_triangles.hpp"

namespace hyperex::expression {
namespace {

/// ARKit's name of a shape, in whose place rigs write JawOpen, mouthSmile_L or, where ARKit knows
/// no sides, browInnerUp_L; empty where it is none.
std::string arkit_name(std::string name) {
  const auto known = [](const std::string& one) {
    const auto& all = arkit_shapes();
    return std::find(all.begin(), all.end(), one) != all.end();
  };
  if (!name.empty() && name.front() >= 'A' && name.front() <= 'Z') name.front() += 'a' - 'A';
  if (known(name)) return name;
  if (!name.ends_with("_L") && !name.ends_with("_R")) return "";
  const std::string bare = name.substr(0, name.size() - 2);
  const std::string sided = bare + (name.back() == 'L' ? "Left" : "Right");
  return known(sided) ? sided : known(bare) ? bare : "";
}

}  // namespace

FaceModel rig_model(const io::ShapedMesh& rig, const io::Landmarks& landmarks,
                    const std::filesystem::path& file, const RigLips& lips) {
  if (landmarks.empty()) throw InputError(file, "has no landmarks");
  FaceModel model;
  model.name = "rig's";
  const SurfaceTree skin(rig.mesh);
  const SidedTriangles sided(rig.mesh, lips.of_vertex);
  std::vector<ClosestPoint> places;
  for (const auto& [name, at] : landmarks) {
    model.landmarks[name] = {static_cast<int>(places.size())};
    const auto lip = lips.of_landmark.find(name);
    places.push_back(
        skin.query_among(sided.open_to(lip == lips.of_landmark.end() ? 0 : lip->second), at));
  }
  const auto count = static_cast<Eigen::Index>(places.size());
  model.mesh.points.resize(count, 3);
  for (Eigen::Index i = 0; i < count; ++i)
    model.mesh.points.row(i) = places[static_cast<std::size_t>(i)].point.transpose();
  for (const io::MorphShape& shape : rig.shapes) {
    DeformationUnit unit;
    unit.name = shape.name;
    unit.arkit = arkit_name(shape.name);
    if (unit.arkit.empty()) continue;
    unit.vertices.resize(places.size());
    std::iota(unit.vertices.begin(), unit.vertices.end(), 0);
    unit.displacement_m = Points::Zero(count, 3);
    for (Eigen::Index i = 0; i < count; ++i) {
      const ClosestPoint& at = places[static_cast<std::size_t>(i)];
      for (int k = 0; k < 3; ++k)
        unit.displacement_m.row(i) +=
            at.weights[k] *
            shape.displacement_m.row(rig.mesh.triangles(at.triangle, k)).cast<double>();
    }
    model.recorded_units.push_back(std::move(unit));
  }
  if (model.recorded_units.empty())
    throw InputError(file, "has no morph target with a name of ARKit's, such as jawOpen");
  return model;
}

}  // namespace hyperex::expression
