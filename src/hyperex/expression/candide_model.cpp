// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <map>

#include "hyperex/core/error.hpp"
#include "hyperex/expression/candide.hpp"
#include "hyperex/expression/face_model.hpp"
#include "hyperex/expression/tables.hpp"

namespace hyperex::expression {

namespace {

constexpr int kVertices = 113, kAnimationUnits = 14, kJawDrop = 3;
constexpr int kOuterEyeCorners[] = {20, 53};
constexpr double kEyeDistance_m = 0.094;  // between the outer eye corners of an adult

DeformationUnit unit_of(const CandideUnit& from, double metres_per_unit) {
  std::map<int, Vec3> moved;  // the displacements of a vertex listed twice are added
  for (std::size_t i = 0; i < from.vertices.size(); ++i) {
    Vec3& d = moved.try_emplace(from.vertices[i], Vec3::Zero()).first->second;
    d += metres_per_unit * from.displacement.row(Eigen::Index(i)).transpose();
  }
  DeformationUnit unit;
  unit.name = from.name;
  unit.displacement_m.resize(Eigen::Index(moved.size()), 3);
  for (const auto& [vertex, d] : moved) {
    unit.displacement_m.row(Eigen::Index(unit.vertices.size())) = d.transpose();
    unit.vertices.push_back(vertex);
  }
  return unit;
}

/// The triangles, counter-clockwise as seen from the front. In candide3.wfm all of them run
/// clockwise, so that normals would point into the head and no vertex would face the camera.
Triangles outward(const TriMesh& mesh) {
  double towards_front = 0;  // twice the area as seen from the front
  for (const auto t : mesh.triangles.rowwise()) {
    const Vec3 a = mesh.points.row(t[0]).transpose(), b = mesh.points.row(t[1]).transpose(),
               c = mesh.points.row(t[2]).transpose();
    towards_front += (b - a).cross(c - a).z();
  }
  Triangles triangles = mesh.triangles;
  if (towards_front < 0) triangles.col(1).swap(triangles.col(2));
  return triangles;
}

}  // namespace

FaceModel candide_model(const std::string& wfm_file) {
  const CandideFile file = read_candide(wfm_file);
  if (file.mesh.points.rows() != kVertices || file.animation_units.size() != kAnimationUnits)
    throw InputError(wfm_file,
                     fmt::format("{} vertices and {} animation units, expected CANDIDE-3's {} and "
                                 "{}",
                                 file.mesh.points.rows(), file.animation_units.size(), kVertices,
                                 kAnimationUnits));
  const double eyes =
      (file.mesh.points.row(kOuterEyeCorners[0]) - file.mesh.points.row(kOuterEyeCorners[1]))
          .norm();
  if (!(eyes > 0))
    throw InputError(wfm_file, "the outer eye corners, vertices 20 and 53, are one point");
  const double scale = kEyeDistance_m / eyes;
  FaceModel model;
  model.name = "candide";
  model.mesh = {scale * file.mesh.points, outward(file.mesh)};
  for (const auto& unit : file.shape_units) {
    model.shape_units.push_back(unit_of(unit, scale));
    model.shape_units.back().typical = 0.5;
  }
  for (const auto& unit : file.animation_units)
    model.animation_units.push_back(unit_of(unit, scale));
  for (const auto& row :
       table_rows(candide_units_table(), "unit,facs,arkit,arkit_negative,scale")) {
    DeformationUnit& unit =
        model.animation_units[std::size_t(table_indices(row.at(0), kAnimationUnits)[0])];
    unit.facs = row.at(1);
    unit.arkit = row.at(2);
    unit.arkit_negative = row.at(3);
    unit.arkit_scale = unit.arkit_negative_scale = table_number(row.at(4));
    unit.typical = 0.5;
  }
  for (const auto& row : table_rows(candide_pairs_table(), "candide,network"))
    model.pairs.push_back(
        {table_indices(row.at(0), kVertices)[0], table_indices(row.at(1), 468)[0]});
  for (const auto& row : table_rows(candide_landmarks_table(), "name,vertices"))
    model.landmarks[row.at(0)] = table_indices(row.at(1), kVertices);
  model.jaw_drop = kJawDrop;
  return model;
}

}  // namespace hyperex::expression
