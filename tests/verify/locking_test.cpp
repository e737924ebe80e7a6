// SPDX-License-Identifier: GPL-3.0-or-later
// Volumetric locking: errors and orders at nu = 0.4999 must be close to those at nu = 0.3. The
// plain tetrahedron fails, which shows that the test detects locking.
#include <gtest/gtest.h>

#include "hyperex/fem/solve/static_solve.hpp"
#include "support/conformance.hpp"

namespace hyperex::fem {
namespace {

/// L2 error of the displacement of a block. On its faces a divergence-free field is prescribed that
/// is in equilibrium without body forces for any Poisson's ratio: u = curl of a harmonic potential.
double error_inside(ElementKind kind, double poisson, int cells) {
  const auto box = test::box_mesh({cells, cells, cells}, Vec3(1, 1, 1), 0.1);
  const auto boundary = test::unknowns_where(box.nodes, [](const Vec3& p) {
    return (p.array() < 1e-12).any() || (p.array() > 1 - 1e-12).any();
  });
  Points exact(box.nodes.rows(), 3);
  for (Eigen::Index n = 0; n < exact.rows(); ++n) {
    const Vec3 p = 2 * box.nodes.row(n).transpose();
    // curl (0, 0, sin x sinh y) + curl (sin y sinh z, 0, 0)
    exact.row(n) << std::sin(p.x()) * std::cosh(p.y()),
        -std::cos(p.x()) * std::sinh(p.y()) + std::sin(p.y()) * std::cosh(p.z()),
        -std::cos(p.y()) * std::sinh(p.z());
  }
  System s;
  Assembler(box.nodes, box.tets, kind)
      .assemble(test::uniform_material(box.tets.rows(), 1, poisson, 0, 1), s);
  const Eigen::VectorXd wanted = test::flat(exact);
  const Eigen::VectorXd d = StaticSolver(s.stiffness, boundary).solve(wanted(boundary));
  const std::vector<int> free = test::complement(d.size(), boundary);
  const Eigen::VectorXd found = d(free), right = wanted(free);
  return (found - right).norm() / right.norm();
}

double order_inside(ElementKind kind, double poisson) {
  return std::log2(error_inside(kind, poisson, 8) / error_inside(kind, poisson, 16));
}

TEST(Locking, DisjointStarsConvergeWithOrderTwoWhateverPoissonsRatio) {
  for (const double nu : {0.3, 0.495, 0.4999}) {
    const double order = order_inside(ElementKind::tet4_star, nu);
    std::printf("inside a block, nu %g: order %.2f\n", nu, order);
    EXPECT_GT(order, 1.9) << nu;
  }
  EXPECT_LT(error_inside(ElementKind::tet4_star, 0.4999, 8),
            1.1 * error_inside(ElementKind::tet4_star, 0.495, 8));
  EXPECT_LT(error_inside(ElementKind::tet4_star, 0.4999, 8),
            3 * error_inside(ElementKind::tet4_star, 0.3, 8));
}

TEST(Locking, ThePlainTetrahedronFailsThatMeasure) {
  EXPECT_GT(order_inside(ElementKind::tet4, 0.3), 1.9);
  EXPECT_LT(order_inside(ElementKind::tet4, 0.4999), 1.2);
  EXPECT_GT(error_inside(ElementKind::tet4, 0.4999, 8),
            3 * error_inside(ElementKind::tet4, 0.3, 8));
}

/// Deflection of the tip of a cantilever of 10 x 1 x 1 under an end force, relative to beam theory
/// with shear (Timoshenko, shear factor 5/6).
double tip_of_beam(ElementKind kind, double poisson) {
  const auto box = test::box_mesh({20, 4, 4}, Vec3(10, 1, 1));
  System s;
  Assembler(box.nodes, box.tets, kind)
      .assemble(test::uniform_material(box.tets.rows(), 1e6, poisson, 0, 1), s);
  Points force = Points::Zero(box.nodes.rows(), 3);
  double share = 0;  // trapezoidal weights over the end face
  for (const bool count : {true, false})
    for (Eigen::Index n = 0; n < force.rows(); ++n)
      if (box.nodes(n, 0) > 10 - 1e-9) {
        const auto inner = [](double x) { return x > 1e-9 && x < 1 - 1e-9 ? 2.0 : 1.0; };
        const double weight = inner(box.nodes(n, 1)) * inner(box.nodes(n, 2));
        count ? share += weight : force(n, 2) = weight / share;
      }
  const auto held = test::unknowns_where(box.nodes, [](const Vec3& p) { return p.x() < 1e-9; });
  const Points d = test::unflat(
      StaticSolver(s.stiffness, held)
          .solve(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(held.size())), test::flat(force)));
  const double theory = 1000.0 / (3 * 1e6 / 12) + 10 * 6.0 / 5 / (1e6 / 2 / (1 + poisson));
  return d(box.node(20, 2, 2), 2) / theory;
}

TEST(Locking, ABeamBendsAtAnyPoissonsRatio) {
  const double star = tip_of_beam(ElementKind::tet4_star, 0.3);
  const double plain = tip_of_beam(ElementKind::tet4, 0.3);
  EXPECT_GT(star, plain);
  EXPECT_LT(star, 1);
  for (const double nu : {0.495, 0.4999}) {
    const double star_tight = tip_of_beam(ElementKind::tet4_star, nu);
    const double plain_tight = tip_of_beam(ElementKind::tet4, nu);
    std::printf(
        "tip of a beam over theory, nu 0.3 -> %g: tet4-star %.3f -> %.3f, tet4 %.3f -> %.3f\n", nu,
        star, star_tight, plain, plain_tight);
    EXPECT_LT(1 - star_tight, 1.2 * (1 - star)) << nu;
    EXPECT_GT(1 - plain_tight, 2 * (1 - plain)) << "tet4 must lock, or this shows nothing";
  }
}

}  // namespace
}  // namespace hyperex::fem
