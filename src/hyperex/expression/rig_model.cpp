// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/expression/rig_model.hpp"

#include <numeric>
#include <optional>
#include <set>

#include "hyperex/core/error.hpp"
#include "hyperex/expression/arkit_names.hpp"
#include "hyperex/expression/correctives.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/sided_triangles.hpp"

namespace hyperex::expression {
namespace {

/// The names of ARKit's, or of pairs of them, by which weights move a rig's shapes.
class Drivers {
 public:
  explicit Drivers(const std::vector<io::MorphShape>& shapes) {
    for (const io::MorphShape& shape : shapes) known_.insert(arkit_name_of(shape.name));
    known_.erase("");
  }
  /// Sets arkit and arkit_factor of the unit of a shape. Returns false where nothing moves it.
  bool name(const std::string& shape, DeformationUnit& unit) const {
    unit.arkit = arkit_name_of(shape);
    if (!unit.arkit.empty()) return true;
    const std::optional<ShapePair> pair = corrected_pair(shape);
    if (!pair || !known_.contains(pair->first) || !known_.contains(pair->second)) return false;
    unit.arkit = pair->first;
    unit.arkit_factor = pair->second;
    return true;
  }

 private:
  std::set<std::string> known_;
};

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
  const Drivers drivers(rig.shapes);
  for (const io::MorphShape& shape : rig.shapes) {
    DeformationUnit unit;
    unit.name = shape.name;
    if (!drivers.name(shape.name, unit)) continue;
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
