// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <vector>

#include "hyperex/io/landmarks.hpp"
#include "hyperex/simulate/drive/drive.hpp"

namespace hyperex::simulate {

/// The shapes of real faces (expression/shape_model.hpp), transferred to one face. The transfer
/// uses the landmarks that this face shares with the canonical face. Their weights are estimated
/// from the driven points.
class CarriedShapes {
 public:
  /// `nodes`: n x 3, the places at which the shapes are evaluated; `upper_margin`: of each, as
  /// anatomy::upper_lip_margin(). `points`: the driven points. `sigma_m`: 1 sigma of the error of
  /// the shapes at a point.
  CarriedShapes(const Points& nodes, const std::vector<double>& upper_margin,
                const io::Landmarks& landmarks, const std::vector<DrivenPoint>& points,
                double sigma_m);

  Eigen::Index count() const { return at_points_.cols(); }
  /// 3 |points| and 3 |nodes| x count(), m: displacement where a shape's weight is 1.
  const Eigen::MatrixXd& at_points() const { return at_points_; }
  const Eigen::MatrixXd& at_nodes() const { return at_nodes_; }
  /// Per node: 1 where the canonical face lies on the skin, decreasing to 0 far from it (neck,
  /// ears).
  const Eigen::VectorXd& cover() const { return cover_; }
  /// The most probable weights, 0 or more, for displacements of the points (3 |points|, m).
  Eigen::VectorXd weights_for(const Eigen::VectorXd& displacement) const;

 private:
  Eigen::MatrixXd at_points_, at_nodes_;
  Eigen::VectorXd cover_;
  double sigma_m_;
  Eigen::MatrixXd information_;  ///< of the weights, the points seen
};

}  // namespace hyperex::simulate
