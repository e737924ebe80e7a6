// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <vector>

#include "hyperex/io/landmarks.hpp"
#include "hyperex/simulate/drive/drive.hpp"

namespace hyperex::simulate {

/// The shapes of real faces (expression/shape_model.hpp) on one face: carried there with the
/// canonical face by the landmarks that both have, and their weights found from driven points.
class CarriedShapes {
 public:
  /// `nodes`: n x 3, where the shapes are wanted; `upper_margin`: of each, as
  /// anatomy::upper_lip_margin(). `points`: those that are seen. `sigma_m`: 1 sigma of the error of
  /// the shapes at a point.
  CarriedShapes(const Points& nodes, const std::vector<double>& upper_margin,
                const io::Landmarks& landmarks, const std::vector<DrivenPoint>& points,
                double sigma_m);

  Eigen::Index count() const { return at_points_.cols(); }
  /// 3 |points| and 3 |nodes| x count(), m: displacement where a shape's weight is 1.
  const Eigen::MatrixXd& at_points() const { return at_points_; }
  const Eigen::MatrixXd& at_nodes() const { return at_nodes_; }
  /// Per node, 1 where the canonical face lies on the skin to 0 far off it (neck, ears).
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
