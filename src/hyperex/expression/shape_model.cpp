// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/expression/shape_model.hpp"

#include <map>

#include "hyperex/expression/tables.hpp"
#include "hyperex/face/canonical_face.hpp"

namespace hyperex::expression {
namespace {

ShapeModel read_model() {
  ShapeModel model;
  std::map<std::string, int> place;
  const int vertices = int(face::canonical_face().mesh.points.rows());
  const auto rows = table_rows(expression_shapes_table(), "shape,vertex,x_mm,y_mm,z_mm");
  for (const auto& row : rows)
    if (place.emplace(row.at(0), int(place.size())).second) model.names.push_back(row.at(0));
  const auto count = Eigen::Index(model.names.size());
  model.displacement = Eigen::MatrixXd::Zero(3 * vertices, count);
  for (const auto& row : rows) {
    const int vertex = table_indices(row.at(1), vertices).front();
    for (int k = 0; k < 3; ++k)
      model.displacement(3 * vertex + k, place.at(row.at(0))) =
          1e-3 * table_number(row.at(std::size_t(2 + k)));
  }
  Eigen::MatrixXd correlation = Eigen::MatrixXd::Identity(count, count);
  Eigen::VectorXd spread = Eigen::VectorXd::Zero(count);
  for (const auto& row : table_rows(expression_couplings_table(), "shape,other,value")) {
    const int a = place.at(row.at(0)), b = place.at(row.at(1));
    if (a == b)
      spread[a] = table_number(row.at(2));
    else
      correlation(a, b) = correlation(b, a) = table_number(row.at(2));
  }
  model.covariance = spread.asDiagonal() * correlation * spread.asDiagonal();
  return model;
}

}  // namespace

const ShapeModel& shape_model() {
  static const ShapeModel model = read_model();
  return model;
}

}  // namespace hyperex::expression
