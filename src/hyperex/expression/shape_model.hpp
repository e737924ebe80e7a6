// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <string>
#include <vector>

namespace hyperex::expression {

/// Facial motion as a linear combination of displacement shapes of the canonical face. The shapes
/// are the expression shapes of a public rig (ICT-FaceKit, from light-stage scans). The covariance
/// of their weights is that of a recording of one person. The tables data/expression_shapes.csv and
/// data/expression_couplings.csv state their sources; they are made by scripts/shape_model.py.
struct ShapeModel {
  std::vector<std::string> names;  ///< names of ICT-FaceKit; "_L", "_R": the subject's own sides
  /// 3 |vertices| x |names|, m: displacements of the canonical face's vertices (x, y, z of each) in
  /// its own frame and size, at weight 1 of a shape.
  Eigen::MatrixXd displacement;
  /// |names| x |names|: prior covariance of the weights, which are >= 0 and mostly below 1. Shapes
  /// of one side are not correlated with those of the other, so that the prior does not hide a
  /// palsy.
  Eigen::MatrixXd covariance;
};

/// Read at the first call. Always returns the same object.
const ShapeModel& shape_model();

}  // namespace hyperex::expression
