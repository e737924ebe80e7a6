// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>

#include "hyperex/tracking/model/face_model.hpp"

namespace hyperex::tracking {

/// The animation units as columns, 3 |V| x K: column k has the displacements (metres) of all
/// vertices at weight 1, rows 3 v ... 3 v + 2 those of vertex v.
using UnitMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
UnitMatrix unit_matrix(const FaceModel& model);

/// DeformationUnit::typical of the animation units.
Eigen::VectorXd typical_weights(const FaceModel& model);

}  // namespace hyperex::tracking
