// SPDX-License-Identifier: GPL-3.0-or-later
// A manufactured static solution: u_i = a_i sin(w_i . x + p_i) on the unit cube, with the body
// force that it requires. The order of the error in h is measured.
#include <gtest/gtest.h>

#include "hyperex/fem/solve/static_solve.hpp"
#include "support/fem_support.hpp"

namespace hyperex::fem {
namespace {

constexpr double kYoung = 1e5, kPoisson = 0.3;

struct Exact {
  Vec3 amplitude{1.0, -0.8, 0.6};
  Vec3 phase{0.3, 1.1, -0.4};
  Eigen::Matrix3d wave = (Eigen::Matrix3d() << 2.0, 1.0, -0.5, -0.7, 1.8, 1.2, 0.9, -1.1, 2.2)
                             .finished();  // row i: w_i

  Vec3 angle(const Vec3& x) const { return wave * x + phase; }
  Vec3 value(const Vec3& x) const {
    return amplitude.cwiseProduct(angle(x).array().sin().matrix());
  }
  Eigen::Matrix3d gradient(const Vec3& x) const {
    return amplitude.cwiseProduct(angle(x).array().cos().matrix()).asDiagonal() * wave;
  }
  /// -div sigma = -((lambda + mu) grad div u + mu laplace u).
  Vec3 body_force(const Vec3& x) const {
    const double lambda = kYoung * kPoisson / (1 + kPoisson) / (1 - 2 * kPoisson);
    const double mu = kYoung / 2 / (1 + kPoisson);
    const Vec3 wavy = value(x);
    Vec3 force = Vec3::Zero();
    for (int i = 0; i < 3; ++i) {
      force += (lambda + mu) * wavy[i] * wave(i, i) * wave.row(i).transpose();
      force[i] += mu * wavy[i] * wave.row(i).squaredNorm();
    }
    return force;
  }
};

struct Errors {
  double l2 = 0, h1 = 0;
};

/// Calls f(t, barycentric weights, position, weight in m^3) at each point of the quadrature rule
/// that is exact for quadratics. Its error is of higher order than those measured.
template <typename F>
void integrate(const test::BoxMesh& box, F f) {
  const Eigen::Matrix4d rule = test::quadratic_rule();
  for (Eigen::Index t = 0; t < box.tets.rows(); ++t) {
    Eigen::Matrix<double, 4, 3> corner;
    for (int a = 0; a < 4; ++a) corner.row(a) = box.nodes.row(box.tets(t, a));
    const double weight = test::volume_of(box.nodes, box.tets, t) / 4;
    for (int q = 0; q < 4; ++q)
      f(t, Eigen::RowVector4d(rule.row(q)), Vec3((rule.row(q) * corner).transpose()), weight);
  }
}

Errors errors_at(ElementKind kind, int cells) {
  const Exact exact;
  const auto box = test::box_mesh({cells, cells, cells}, Vec3::Ones(), 0.1);
  const System s =
      assemble(box.nodes, box.tets,
               test::uniform_material(box.tets.rows(), kYoung, kPoisson, 0, 1000), kind);
  Points force = Points::Zero(box.nodes.rows(), 3);
  integrate(box, [&](Eigen::Index t, const Eigen::RowVector4d& n, const Vec3& x, double weight) {
    for (int a = 0; a < 4; ++a)
      force.row(box.tets(t, a)) += weight * n[a] * exact.body_force(x).transpose();
  });
  Points nodal(box.nodes.rows(), 3);
  for (Eigen::Index i = 0; i < nodal.rows(); ++i)
    nodal.row(i) = exact.value(box.nodes.row(i).transpose()).transpose();
  const auto boundary = test::unknowns_where(box.nodes, [](const Vec3& p) {
    return (p.array() < 1e-12).any() || (p.array() > 1 - 1e-12).any();
  });
  const Points d = test::unflat(
      StaticSolver(s.stiffness, boundary).solve(test::flat(nodal)(boundary), test::flat(force)));

  Errors squared;
  integrate(box, [&](Eigen::Index t, const Eigen::RowVector4d& n, const Vec3& x, double weight) {
    Vec3 u = Vec3::Zero();
    for (int a = 0; a < 4; ++a) u += n[a] * d.row(box.tets(t, a)).transpose();
    squared.l2 += weight * (u - exact.value(x)).squaredNorm();
    squared.h1 +=
        weight * (test::gradient_of(box.nodes, box.tets, t, d) - exact.gradient(x)).squaredNorm();
  });
  return {std::sqrt(squared.l2), std::sqrt(squared.h1)};
}

class ManufacturedSolution : public testing::TestWithParam<ElementKind> {};
INSTANTIATE_TEST_SUITE_P(AllKinds, ManufacturedSolution, testing::ValuesIn(kElementKinds),
                         [](const auto& tested) {
                           return tested.param == ElementKind::tet4 ? "tet4" : "tet4_star";
                         });

TEST_P(ManufacturedSolution, ConvergesWithOrderTwoInDisplacementAndOneInStrain) {
  const Errors coarse = errors_at(GetParam(), 4), middle = errors_at(GetParam(), 8),
               fine = errors_at(GetParam(), 16);
  const double l2_first = std::log2(coarse.l2 / middle.l2), l2 = std::log2(middle.l2 / fine.l2);
  const double h1_first = std::log2(coarse.h1 / middle.h1), h1 = std::log2(middle.h1 / fine.h1);
  RecordProperty("l2_order", std::to_string(l2));
  RecordProperty("h1_order", std::to_string(h1));
  std::printf("order in h: L2 %.3f then %.3f, H1 %.3f then %.3f; finest errors %.2e, %.2e\n",
              l2_first, l2, h1_first, h1, fine.l2, fine.h1);
  EXPECT_NEAR(l2, 2, 0.12);
  EXPECT_NEAR(h1, 1, 0.07);
  EXPECT_LT(fine.l2, 5e-3);
}

}  // namespace
}  // namespace hyperex::fem
