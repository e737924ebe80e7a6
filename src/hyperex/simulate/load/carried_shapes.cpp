// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/load/carried_shapes.hpp"

#include <algorithm>

#include "hyperex/anatomy/lips.hpp"
#include "hyperex/expression/shape_model.hpp"
#include "hyperex/face/canonical_face.hpp"
#include "hyperex/geometry/rbf.hpp"
#include "hyperex/muscles/bounded_least_squares.hpp"
#include "hyperex/simulate/drive/skin_places.hpp"

namespace hyperex::simulate {
namespace {

constexpr double kOnSkin_m = 0.004, kOffSkin_m = 0.010;  // the cover falls from 1 to 0 in between

/// The canonical face on this one.
struct CarriedFace {
  TriMesh mesh;
  Eigen::Matrix3d turn;  ///< of displacements, with the size

  explicit CarriedFace(const io::Landmarks& landmarks) {
    const face::CanonicalFace& canonical = face::canonical_face();
    std::vector<Vec3> from, to;
    for (const auto& [name, vertices] : canonical.landmarks)
      if (const auto it = landmarks.find(name); it != landmarks.end()) {
        from.push_back(canonical.landmark(name, canonical.mesh.points));
        to.push_back(it->second);
      }
    Points a(Eigen::Index(from.size()), 3), b(a.rows(), 3);
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      a.row(i) = from[std::size_t(i)].transpose();
      b.row(i) = to[std::size_t(i)].transpose();
    }
    const Similarity similarity = fit_similarity(a, b);
    turn = similarity.scale * similarity.rotation;
    constexpr double same_place_m = 0.0005;
    const Rbf rbf(a, b, {RbfPolynomial::affine, 0, same_place_m});
    mesh = {rbf.at_all(canonical.mesh.points), face::opened_triangles(canonical)};
  }
};

/// Per vertex of the canonical face: -1 on the inner border of the lower lip, 1 on the upper's.
std::vector<int> contour_sides() {
  std::vector<int> side(std::size_t(face::canonical_face().mesh.points.rows()), 0);
  const std::vector<int>& contour =
      face::lip_contour();  // from the right corner over the upper lip
  for (std::size_t i = 0; i < contour.size(); ++i)
    if (i % (contour.size() / 2) != 0)
      side[std::size_t(contour[i])] = i < contour.size() / 2 ? 1 : -1;
  return side;
}

Eigen::MatrixXd shapes_at(const std::vector<Match>& places, const Eigen::Matrix3d& turn) {
  const Eigen::MatrixXd& shapes = expression::shape_model().displacement;
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(3 * Eigen::Index(places.size()), shapes.cols());
  for (std::size_t i = 0; i < places.size(); ++i)
    for (int k = 0; k < 3; ++k)
      out.middleRows<3>(3 * Eigen::Index(i)) +=
          places[i].weight[k] * turn * shapes.middleRows<3>(3 * places[i].point[std::size_t(k)]);
  return out;
}

}  // namespace

CarriedShapes::CarriedShapes(const Points& nodes, const std::vector<double>& upper_margin,
                             const io::Landmarks& landmarks, const std::vector<DrivenPoint>& points,
                             double sigma_m)
    : sigma_m_(sigma_m) {
  const CarriedFace face(landmarks);
  const std::vector<int> vertex_side = contour_sides();
  Points rest(Eigen::Index(points.size()), 3);
  std::vector<int> side;
  for (std::size_t i = 0; i < points.size(); ++i) {
    rest.row(Eigen::Index(i)) = points[i].rest.transpose();
    side.push_back(anatomy::lip_of(points[i].name));
  }
  at_points_ = shapes_at(match(rest, face.mesh, side, vertex_side), face.turn);
  const std::vector<Match> places = match(nodes, face.mesh, lip_sides(upper_margin), vertex_side);
  at_nodes_ = shapes_at(places, face.turn);
  cover_.resize(nodes.rows());
  for (std::size_t i = 0; i < places.size(); ++i)
    cover_[Eigen::Index(i)] =
        std::clamp((kOffSkin_m - places[i].distance_m) / (kOffSkin_m - kOnSkin_m), 0.0, 1.0);
  information_ = expression::shape_model().covariance.inverse();
  information_ += at_points_.transpose() * at_points_ / (sigma_m * sigma_m);
}

Eigen::VectorXd CarriedShapes::weights_for(const Eigen::VectorXd& displacement) const {
  const Eigen::VectorXd seen = at_points_.transpose() * displacement / (sigma_m_ * sigma_m_);
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(count());
  muscles::bounded_least_squares(information_, seen, Eigen::VectorXd::Zero(count()), weights);
  return weights;
}

}  // namespace hyperex::simulate
