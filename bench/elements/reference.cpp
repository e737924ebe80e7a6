// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference.hpp"

#include <cmath>

#include "equations.hpp"

namespace hyperex::study {
namespace {

struct Quadratic {
  Eigen::Vector3d value, slope;
  explicit Quadratic(double s)
      : value(s * (s - 1) / 2, 1 - s * s, s * (s + 1) / 2), slope(s - 0.5, -2 * s, s + 0.5) {}
};

/// Nodes of the graded grid, 2 cells + 1 a side; middles of edges are halfway.
struct Plane {
  int side;
  std::vector<Eigen::Vector2d> nodes;
  explicit Plane(int cells) : side(2 * cells + 1), nodes(side * side) {
    const auto graded = [&](int i, bool both) {
      const auto at = [&](int k) {
        const double s = static_cast<double>(k) / cells;
        return both ? (1 - std::cos(M_PI * s)) / 2 : 1 - std::cos(M_PI * s / 2);
      };
      return (at(i / 2) + at((i + 1) / 2)) / 2;
    };
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) {
        const double x = graded(i, false), y = graded(j, true);
        nodes[j * side + i] = {48 * x, 44 * x + (44 - 28 * x) * y};
      }
  }
};

}  // namespace

double cooks_rise(int cells, double young, double poisson, double force, bool plane_stress) {
  const Plane plane(cells);
  const double mu = fem::shear_modulus_pa(young, poisson);
  double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  if (plane_stress) lambda *= 2 * mu / (lambda + 2 * mu);
  constexpr double kAt[3] = {-0.774596669241483, 0, 0.774596669241483};
  constexpr double kWeight[3] = {5.0 / 9, 8.0 / 9, 5.0 / 9};

  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(static_cast<std::size_t>(cells) * cells * 324);
  for (int cy = 0; cy < cells; ++cy)
    for (int cx = 0; cx < cells; ++cx) {
      int node[9];
      Eigen::Matrix<double, 9, 2> corner;
      for (int a = 0; a < 9; ++a) {
        node[a] = (2 * cy + a / 3) * plane.side + 2 * cx + a % 3;
        corner.row(a) = plane.nodes[node[a]].transpose();
      }
      const Eigen::RowVector2d middle = corner.row(4);
      Eigen::Matrix<double, 18, 18> k = Eigen::Matrix<double, 18, 18>::Zero();
      Eigen::Matrix<double, 3, 18> moment = Eigen::Matrix<double, 3, 18>::Zero();
      Eigen::Matrix3d gram = Eigen::Matrix3d::Zero();
      for (int q = 0; q < 9; ++q) {
        const Quadratic s(kAt[q % 3]), t(kAt[q / 3]);
        Eigen::Matrix<double, 9, 2> local;
        Eigen::Matrix<double, 9, 1> shape;
        for (int a = 0; a < 9; ++a) {
          shape[a] = s.value[a % 3] * t.value[a / 3];
          local.row(a) << s.slope[a % 3] * t.value[a / 3], s.value[a % 3] * t.slope[a / 3];
        }
        const Eigen::Matrix2d jacobian = corner.transpose() * local;
        const double weight = kWeight[q % 3] * kWeight[q / 3] * jacobian.determinant();
        const Eigen::Matrix<double, 9, 2> g = local * jacobian.inverse();
        Eigen::Matrix<double, 1, 18> divergence;
        for (int a = 0; a < 9; ++a) {
          divergence.segment<2>(2 * a) = g.row(a);
          for (int b = 0; b < 9; ++b)
            k.block<2, 2>(2 * a, 2 * b) += weight * mu *
                                           (g.row(b).transpose() * g.row(a) +
                                            g.row(a).dot(g.row(b)) * Eigen::Matrix2d::Identity());
        }
        Eigen::Vector3d basis;
        basis << 1, (shape.transpose() * corner - middle).transpose();
        moment += weight * basis * divergence;
        gram += weight * basis * basis.transpose();
      }
      k += lambda * moment.transpose() * gram.ldlt().solve(moment);
      for (int a = 0; a < 18; ++a)
        for (int b = 0; b < 18; ++b)
          triplets.emplace_back(2 * node[a / 2] + a % 2, 2 * node[b / 2] + b % 2, k(a, b));
    }
  const int count = 2 * plane.side * plane.side;
  fem::SparseMatrix matrix(count, count);
  matrix.setFromTriplets(triplets.begin(), triplets.end());

  Eigen::VectorXd x = Eigen::VectorXd::Zero(count);
  for (int cy = 0; cy < cells; ++cy) {  // Simpson's weights: constant traction on straight edges
    const auto at = [&](int j) { return (2 * cy + j + 1) * plane.side - 1; };
    const double share = force / 16 * (plane.nodes[at(2)] - plane.nodes[at(0)]).norm();
    for (int j = 0; j < 3; ++j) x[2 * at(j) + 1] += share * (j == 1 ? 4 : 1) / 6;
  }
  Constraints held(Points(0, 3), nullptr, count);
  for (int j = 0; j < plane.side; ++j)
    held.fixed[2 * j * plane.side] = held.fixed[2 * j * plane.side + 1] = 1;
  Solution s;
  solve_definite(matrix, held, x, 1, s);
  // In the middle: at the corner, where the traction ends, it would converge with order one alone.
  return x[2 * ((cells + 1) * plane.side - 1) + 1];
}

}  // namespace hyperex::study
