// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <vector>

#include "hyperex/simulate/load/carried_shapes.hpp"

namespace hyperex::simulate {

/// The assumed errors of the shape model and of the driven points.
struct PosteriorOptions {
  /// Motion that no combination of shapes represents. Its standard deviation (per coordinate) is
  /// misfit_m + misfit_share x the length of the displacement there; its correlation length is
  /// misfit_length_m.
  double misfit_m = 0.001, misfit_share = 0.17, misfit_length_m = 0.015;
  double point_m = 0.0005;  ///< 1 sigma of the error of a coordinate of a driven point, m
};

/// Places of the skin and how far they move.
struct MovedPlaces {
  Points rest;               ///< n x 3, m
  Eigen::VectorXd motion_m;  ///< n: length of the displacement
  /// n: TissueMesh::upper_margin, m; empty: all 0. Lips that touch at rest are counted as apart.
  std::vector<double> upper_margin = {};
};

/// Gaussian posterior of the displacement u(x) of the skin, given the driven points and a prior of
/// how real faces move. The prior is
///   u(x) = c(x) S(x) w + r(x),  w ~ N(0, Sigma),  E r(x) r(y)^T = m(x) m(y) exp(-|x - y|^2 / 2
///   l^2) I,
/// with the shapes S, 1 (on the face) to 0 (off it) as CarriedShapes::cover() for c, and the
/// covariance Sigma of their weights (expression/shape_model.hpp; their bound w >= 0 is ignored),
/// m(x) = misfit_m + misfit_share |u(x)|, of the motion found, and l = misfit_length_m. With P = E
/// u u^T, the covariance is then
///   P_xx - P_xp (P_pp + point_m^2 I)^-1 P_px.
/// Rasmussen and Williams, Gaussian Processes for Machine Learning (2006), eq. 2.24.
class ShapePosterior {
 public:
  /// `shapes`: those with these places as nodes and these driven points.
  ShapePosterior(const CarriedShapes& shapes, const MovedPlaces& places, const MovedPlaces& points,
                 const PosteriorOptions& options = {});

  Eigen::Index places() const { return before_.size(); }
  /// 3 x 3, m^2: of the error of a place's displacement.
  Eigen::Matrix3d covariance(Eigen::Index place) const;
  /// Per place: the root mean square of the distance from the truth, m.
  Eigen::VectorXd distance_m() const;
  /// Per place: the share of the variance that the points take away, 0 to 1.
  Eigen::VectorXd determined() const;

 private:
  Eigen::MatrixXd covariance_;  ///< 3 |places| x 3
  Eigen::VectorXd before_;      ///< per place: trace before a point is seen
};

}  // namespace hyperex::simulate
