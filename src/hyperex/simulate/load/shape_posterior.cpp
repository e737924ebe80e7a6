// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/load/shape_posterior.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "hyperex/core/run_together.hpp"
#include "hyperex/expression/shape_model.hpp"

namespace hyperex::simulate {
namespace {

/// Standard deviation (per coordinate) of the motion that no combination of shapes represents.
Eigen::VectorXd misfit(const MovedPlaces& at, const PosteriorOptions& options) {
  return (options.misfit_m + options.misfit_share * at.motion_m.array()).matrix();
}

/// A place of the skin at rest, and a fourth coordinate by which the two lips are apart.
Eigen::Vector4d apart(const MovedPlaces& at, Eigen::Index i) {
  constexpr double full_m = 0.010, lips_m = 0.016;
  const double margin = at.upper_margin.empty() ? 0 : at.upper_margin[std::size_t(i)];
  Eigen::Vector4d out;
  out << at.rest.row(i).transpose(), lips_m / 2 * std::clamp(margin / full_m, -1.0, 1.0);
  return out;
}

/// How alike the misfits of two places are.
double alike(const Eigen::Vector4d& a, const Eigen::Vector4d& b, double length_m) {
  return std::exp(-(a - b).squaredNorm() / (2 * length_m * length_m));
}

}  // namespace

ShapePosterior::ShapePosterior(const CarriedShapes& shapes, const MovedPlaces& places,
                               const MovedPlaces& points, const PosteriorOptions& options)
    : covariance_(3 * places.rest.rows(), 3), before_(places.rest.rows()) {
  const Eigen::MatrixXd& weights = expression::shape_model().covariance;
  const Eigen::VectorXd of_place = misfit(places, options), of_point = misfit(points, options);
  const double length = options.misfit_length_m;
  const Eigen::Index count = points.rest.rows(), rows = places.rest.rows();
  const Eigen::MatrixXd of_points = shapes.at_points() * weights;  // 3 |points| x shapes
  Eigen::MatrixXd seen = of_points * shapes.at_points().transpose();
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < count; ++j)
      seen.block<3, 3>(3 * i, 3 * j).diagonal().array() +=
          of_point[i] * of_point[j] * alike(apart(points, i), apart(points, j), length);
  seen.diagonal().array() += options.point_m * options.point_m;
  const Eigen::LLT<Eigen::MatrixXd> factor(seen);

  constexpr Eigen::Index block = 256;  // places at once, which limits the memory
  run_each(std::size_t((rows + block - 1) / block), [&](std::size_t b) {
    const Eigen::Index from = block * Eigen::Index(b), end = std::min(from + block, rows);
    Eigen::MatrixXd here = shapes.at_nodes().middleRows(3 * from, 3 * (end - from));
    for (Eigen::Index p = from; p < end; ++p)
      here.middleRows<3>(3 * (p - from)) *= shapes.cover()[p];
    Eigen::MatrixXd with_points = of_points * here.transpose();  // 3 |points| x 3 |places|
    for (Eigen::Index p = from; p < end; ++p)
      for (Eigen::Index i = 0; i < count; ++i)
        with_points.block<3, 3>(3 * i, 3 * (p - from)).diagonal().array() +=
            of_point[i] * of_place[p] * alike(apart(points, i), apart(places, p), length);
    factor.matrixL().solveInPlace(with_points);
    for (Eigen::Index p = from; p < end; ++p) {
      const auto own = here.middleRows<3>(3 * (p - from));
      const Eigen::Matrix3d prior =
          own * weights * own.transpose() + of_place[p] * of_place[p] * Eigen::Matrix3d::Identity();
      const auto known = with_points.middleCols<3>(3 * (p - from));
      before_[p] = prior.trace();
      covariance_.middleRows<3>(3 * p) = prior - known.transpose() * known;
    }
  });
}

Eigen::Matrix3d ShapePosterior::covariance(Eigen::Index place) const {
  return covariance_.middleRows<3>(3 * place);
}

Eigen::VectorXd ShapePosterior::distance_m() const {
  Eigen::VectorXd out(places());
  for (Eigen::Index p = 0; p < places(); ++p)
    out[p] = std::sqrt(std::max(covariance(p).trace(), 0.0));
  return out;
}

Eigen::VectorXd ShapePosterior::determined() const {
  Eigen::VectorXd out(places());
  for (Eigen::Index p = 0; p < places(); ++p)
    out[p] = std::clamp(1 - covariance(p).trace() / before_[p], 0.0, 1.0);
  return out;
}

}  // namespace hyperex::simulate
