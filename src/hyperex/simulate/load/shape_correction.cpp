// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/load/shape_correction.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/core/symmetric_modes.hpp"

namespace hyperex::simulate {
namespace {

/// Directions that carry less than this share of the greatest are left out.
constexpr double kDirectionLost = 1e-3;

/// The share of the correction at each outer node, 0 to shape_share.
Eigen::VectorXd shares(const Points& nodes, const CarriedShapes& shapes, const Points& points,
                       const MuscleOptions& options) {
  Eigen::VectorXd share = shapes.cover() * options.shape_share;
  for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
    const double nearest = (points.rowwise() - nodes.row(i)).rowwise().norm().minCoeff();
    share[i] *= std::clamp(
        (nearest - options.shape_clear_m) / (options.shape_reach_m - options.shape_clear_m), 0.0,
        1.0);
  }
  return share;
}

/// Means over the neighbourhood of each of `rows` (rows) of values at all nodes, times its share.
CarrierMatrix smoothing(const Points& opened, const std::vector<int>& rows,
                        const Eigen::VectorXd& share, double sigma_m) {
  constexpr double reach = 2.5;  // in sigma
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Eigen::VectorXd squared =
        (opened.rowwise() - opened.row(rows[i])).rowwise().squaredNorm() / (sigma_m * sigma_m);
    double sum = 0;
    const std::size_t first = entries.size();
    for (int j = 0; j < squared.size(); ++j)
      if (squared[j] < reach * reach) {
        entries.emplace_back(int(i), j, std::exp(-squared[j] / 2));
        sum += entries.back().value();
      }
    for (std::size_t e = first; e < entries.size(); ++e)
      entries[e] = {int(i), entries[e].col(), entries[e].value() * share[rows[i]] / sum};
  }
  CarrierMatrix out(Eigen::Index(rows.size()), opened.rows());
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

/// Expands weights (one per node and point) to three rows per node and three columns per point, one
/// for each axis.
Eigen::MatrixXd along_axes(const Eigen::MatrixXd& weights) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(3 * weights.rows(), 3 * weights.cols());
  for (Eigen::Index i = 0; i < weights.rows(); ++i)
    for (Eigen::Index p = 0; p < weights.cols(); ++p)
      for (int k = 0; k < 3; ++k) out(3 * i + k, 3 * p + k) = weights(i, p);
  return out;
}

/// basis * amounts as orthonormal directions and their course, without those that hardly matter.
/// With basis' basis = Q L Q' the product's size lies in X = L^1/2 Q' amounts, whose left singular
/// vectors U give the directions basis Q L^-1/2 U.
void as_directions(const Eigen::MatrixXd& basis, const Eigen::MatrixXd& amounts,
                   SkinCorrection& out) {
  const SymmetricModes gram = symmetric_modes(basis.transpose() * basis);
  const double least = 1e-12 * std::max(gram.values.maxCoeff(), 1e-30);
  const Eigen::VectorXd root = gram.values.cwiseMax(0).cwiseSqrt();
  const Eigen::VectorXd inverse = gram.values.unaryExpr(
      [least](double value) { return value > least ? 1 / std::sqrt(value) : 0.0; });
  const Eigen::MatrixXd x = root.asDiagonal() * (gram.vectors.transpose() * amounts);
  const SymmetricModes size = symmetric_modes(x * x.transpose());
  const Eigen::VectorXd& squared = size.values;  // rising
  const double greatest = squared.size() > 0 ? squared[squared.size() - 1] : 0;
  Eigen::Index kept = 0;
  while (kept < squared.size() &&
         squared[squared.size() - 1 - kept] > kDirectionLost * kDirectionLost * greatest &&
         squared[squared.size() - 1 - kept] > 1e-18)
    ++kept;
  const Eigen::MatrixXd u = size.vectors.rightCols(kept);
  out.displaced = basis * (gram.vectors * (inverse.asDiagonal() * u));
  out.course = u.transpose() * x;
}

}  // namespace

SkinCorrection shape_correction(const tissue::TissueMesh& mesh, const CarriedShapes& shapes,
                                const DriveField& field, const LoadedSkin& load,
                                const std::vector<int>& prescribed, const MuscleOptions& options) {
  const Points& nodes = mesh.volume.outer.points;
  const Eigen::Index driven = load.points.rows() / 3;
  Points rest(driven, 3), opened(nodes.rows(), 3);
  for (Eigen::Index i = 0; i < driven; ++i)
    rest.row(i) = field.points()[std::size_t(i)].rest.transpose();
  for (Eigen::Index i = 0; i < nodes.rows(); ++i)
    opened.row(i) = field.opened(nodes.row(i), mesh.upper_margin[std::size_t(i)]).transpose();

  SkinCorrection out;
  const Eigen::VectorXd share = shares(nodes, shapes, rest, options);
  for (Eigen::Index i = 0; i < share.size(); ++i)
    if (share[i] > 0 && !std::binary_search(prescribed.begin(), prescribed.end(), 3 * int(i)))
      out.nodes.push_back(int(i));
  const CarrierMatrix weights = smoothing(opened, out.nodes, share, options.shape_smoothing_m);

  const Eigen::Index samples = load.points.cols();
  Eigen::MatrixXd amounts(shapes.count() + load.points.rows() + load.course.rows(), samples);
  for (Eigen::Index k = 0; k < samples; ++k) {
    const Eigen::VectorXd seen = load.points.col(k), w = shapes.weights_for(seen);
    amounts.col(k) << w, seen - shapes.at_points() * w, -load.course.col(k);
  }
  Eigen::MatrixXd basis(3 * weights.rows(), amounts.rows());
  basis << at_places(weights, shapes.at_nodes()),
      along_axes(weights * field.weights(nodes, mesh.upper_margin).leftCols(driven)),
      at_places(weights, load.moved);
  as_directions(basis, amounts, out);
  return out;
}

}  // namespace hyperex::simulate
