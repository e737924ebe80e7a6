// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <string>
#include <vector>

namespace hyperex::expression {

/// How real faces move, as shapes of the canonical face: the expression shapes of a public rig
/// (ICT-FaceKit, from light-stage scans), and how far and how often together they are used (a
/// recording of one person). Tables and their sources: data/expression_shapes.csv and
/// data/expression_couplings.csv, made by scripts/shape_model.py.
struct ShapeModel {
  std::vector<std::string> names;  ///< ICT-FaceKit's; "_L", "_R": the subject's own sides
  /// 3 |vertices| x |names|, m: displacement of the canonical face's vertices (x, y, z of each, in
  /// its frame and size) where a shape's weight is 1.
  Eigen::MatrixXd displacement;
  /// |names| x |names|: of the weights before a face is seen. They are 0 or more, mostly below 1.
  /// Shapes of one side are not coupled with those of the other, so that a palsy is not smoothed
  /// away.
  Eigen::MatrixXd covariance;
};

/// Read at the first call, the same object ever after.
const ShapeModel& shape_model();

}  // namespace hyperex::expression
