// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <map>
#include <numbers>

#include "hyperex/expression/face_model.hpp"
#include "hyperex/expression/mesh_laplacian.hpp"
#include "hyperex/expression/tables.hpp"
#include "hyperex/face/canonical_face.hpp"

namespace hyperex::expression {

namespace {

constexpr double kTurn_rad = 20 * std::numbers::pi / 180;
constexpr double kShapeStep = 0.1;  // relative change of width, height or depth at weight 1

/// The rows of the table that define one unit.
struct UnitRows {
  DeformationUnit unit;
  std::string kind, symmetry;
  double reach_m = 0;
  Vec3 slide_m = Vec3::Zero();
  std::map<int, Vec3> at;  // metres, or the share in x
};

struct UnitTable {
  Vec3 jaw_axis_m = Vec3::Zero();
  std::vector<UnitRows> units;
};

UnitTable read_table(int vertices) {
  UnitTable table;
  for (const auto& row : table_rows(canonical_units_table(), "")) {
    if (row[0] == "jaw_axis") {
      table.jaw_axis_m << 0, table_number(row.at(1)) * 1e-3, table_number(row.at(2)) * 1e-3;
    } else if (row[0] == "unit") {
      UnitRows rows;
      rows.unit.name = row.at(1);
      rows.unit.facs = row.at(2);
      rows.unit.arkit = row.at(3);
      rows.unit.arkit_negative = row.at(4);
      rows.unit.arkit_scale = table_number(row.at(5));
      rows.unit.arkit_negative_scale = table_number(row.at(6));
      rows.unit.typical = table_number(row.at(7));
      rows.kind = row.at(8);
      rows.symmetry = row.at(9);
      rows.reach_m = table_number(row.at(10)) * 1e-3;
      table.units.push_back(rows);
    } else {
      const std::size_t first = row[0] == "at" ? 2 : 1;
      const Vec3 value(table_number(row.at(first)), table_number(row.at(first + 1)),
                       table_number(row.at(first + 2)));
      UnitRows& rows = table.units.at(table.units.size() - 1);
      if (row[0] == "jaw_slide")
        rows.slide_m = value * 1e-3;
      else
        for (const int v : table_indices(row.at(1), vertices))
          rows.at[v] = rows.kind == "move" ? Vec3(value * 1e-3) : value;
    }
  }
  return table;
}

std::string with_side(std::string text, const char* side) {
  const auto star = text.find('*');
  return star == std::string::npos ? text : text.replace(star, 1, side);
}

/// Completes the rows to both halves of the face. Returns one entry per unit of the model.
std::vector<UnitRows> both_sides(const UnitRows& rows, const std::vector<int>& mirror) {
  const auto other = [&](bool turn_x) {
    std::map<int, Vec3> at;
    for (const auto& [v, value] : rows.at)
      at[mirror[std::size_t(v)]] = turn_x ? Vec3(-value.x(), value.y(), value.z()) : value;
    return at;
  };
  if (rows.symmetry == "side") {
    UnitRows left = rows, right = rows;
    left.unit.name += "_L";
    right.unit.name += "_R";
    for (std::string DeformationUnit::*name :
         {&DeformationUnit::arkit, &DeformationUnit::arkit_negative}) {
      left.unit.*name = with_side(rows.unit.*name, "Left");
      right.unit.*name = with_side(rows.unit.*name, "Right");
    }
    right.at = other(true);
    return {left, right};
  }
  UnitRows whole = rows;
  const bool turn_x = rows.symmetry == "both" && rows.kind == "move";
  for (const auto& [v, value] : other(turn_x))
    if (!whole.at.contains(v)) whole.at[v] = value;
  return {whole};
}

/// The smoothest displacement field that takes the values of the rows and is zero beyond their
/// reach.
DeformationUnit spread(const UnitRows& rows, const Points& points, const SparseMatrix& smoothness,
                       const Vec3& jaw_axis_m) {
  std::map<int, Vec3> fixed = rows.at;
  for (Eigen::Index v = 0; v < points.rows(); ++v) {
    const bool reached = std::any_of(rows.at.begin(), rows.at.end(), [&](const auto& entry) {
      return entry.second.norm() > 0 &&
             (points.row(entry.first) - points.row(v)).norm() <= rows.reach_m;
    });
    if (!reached) fixed.try_emplace(int(v), Vec3::Zero());
  }
  const Points field = smooth_fill(smoothness, fixed);
  DeformationUnit unit = rows.unit;
  std::vector<Vec3> moved;
  for (Eigen::Index v = 0; v < points.rows(); ++v) {
    const Vec3 p = points.row(v).transpose();
    Vec3 d = field.row(v).transpose();
    if (rows.kind == "turn")
      d = std::clamp(d.x(), 0.0, 1.0) * kTurn_rad * Vec3::UnitX().cross(p - jaw_axis_m);
    else if (rows.kind == "slide")
      d = std::clamp(d.x(), 0.0, 1.0) * rows.slide_m;
    if (d.norm() < 1e-5) continue;
    unit.vertices.push_back(int(v));
    moved.push_back(d);
  }
  unit.displacement_m.resize(Eigen::Index(moved.size()), 3);
  for (std::size_t i = 0; i < moved.size(); ++i)
    unit.displacement_m.row(Eigen::Index(i)) = moved[i].transpose();
  return unit;
}

std::vector<DeformationUnit> size_units(const Points& points) {
  std::vector<DeformationUnit> units;
  for (int axis = 0; axis < 3; ++axis) {
    static const char* names[] = {"width", "height", "depth"};
    DeformationUnit unit;
    unit.name = names[axis];
    unit.typical = 0.7;
    unit.displacement_m = Points::Zero(points.rows(), 3);
    unit.displacement_m.col(axis) = kShapeStep * points.col(axis);
    for (int v = 0; v < points.rows(); ++v) unit.vertices.push_back(v);
    units.push_back(std::move(unit));
  }
  return units;
}

}  // namespace

const FaceModel& canonical_model() {
  static const FaceModel model = [] {
    const face::CanonicalFace& face = face::canonical_face();
    FaceModel made;
    made.name = "canonical";
    made.lids_once = true;
    made.mesh = {face.mesh.points, face::opened_triangles(face)};
    made.landmarks = face.landmarks;
    for (const auto& row : table_rows(canonical_landmarks_table(), "name,vertices"))
      made.landmarks[row.at(0)] = table_indices(row.at(1), int(face.mesh.points.rows()));
    const Points& points = made.mesh.points;
    for (int v = 0; v < points.rows(); ++v) made.pairs.push_back({v, v});
    made.shape_units = size_units(points);
    const SparseMatrix laplacian = mesh_laplacian(made.mesh);
    const SparseMatrix smoothness = laplacian.transpose() * laplacian;
    const std::vector<int>& mirror = face::mirrored_vertices();
    const UnitTable table = read_table(int(points.rows()));
    for (const auto& rows : table.units)
      for (const auto& whole : both_sides(rows, mirror))
        (rows.unit.typical > 0 ? made.animation_units : made.recorded_units)
            .push_back(spread(whole, points, smoothness, table.jaw_axis_m));
    made.jaw_drop = made.animation_unit("jawOpen");
    return made;
  }();
  return model;
}

}  // namespace hyperex::expression
