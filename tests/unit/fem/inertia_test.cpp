// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/time/inertia.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "support/fem_support.hpp"

namespace hyperex::fem {
namespace {

void expect_products(const InertiaRows& rows, const System& s) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Eigen::VectorXd u = 1e4 * test::random_vector(s.mass.cols(), seed);
    const Eigen::VectorXd w = test::random_vector(s.mass.cols(), seed + 10);
    const Eigen::VectorXd expected = s.mass * u + s.damping * w;
    Eigen::VectorXd out = Eigen::VectorXd::Constant(s.mass.cols(), NAN);
    rows.product(u, w, out);
    EXPECT_LT((out - expected).norm(), 1e-14 * expected.norm());
    rows.product(u, 0 * w, out);
    EXPECT_LT((out - s.mass * u).norm(), 1e-14 * (s.mass * u).norm());
    rows.product(0 * u, w, out);
    EXPECT_LT((out - s.damping * w).norm(), 1e-14 * (s.damping * w).norm());
  }
}

TEST(InertiaRows, MultipliesAsTheSparseMatricesDoAndTakesOtherValues) {
  const auto box = test::box_mesh({11, 10, 4}, Vec3(0.11, 0.1, 0.04), 0.1);  // 660 nodes
  for (const ElementKind kind : kElementKinds)
    for (const ViscousForm form : {ViscousForm::isotropic, ViscousForm::printed}) {
      Material material = test::varied_material(box.tets.rows(), 1);
      material.viscous_form = form;
      const System one = assemble(box.nodes, box.tets, material, kind);
      InertiaRows rows(one);
      expect_products(rows, one);
      Material other = test::varied_material(box.tets.rows(), 2);
      other.viscous_form = form;
      const System two = assemble(box.nodes, box.tets, other, kind);
      rows.refill(two);
      expect_products(rows, two);
    }
}

TEST(InertiaRows, GivesTheSameNumbersOnAnyNumberOfThreads) {
  const auto box = test::box_mesh({15, 15, 5}, Vec3(0.15, 0.15, 0.05), 0.1);
  const System s =
      assemble(box.nodes, box.tets, test::varied_material(box.tets.rows()), ElementKind::tet4);
  const InertiaRows rows(s);
  const Eigen::VectorXd u = test::random_vector(s.mass.cols(), 1);
  Eigen::VectorXd first(u.size()), again(u.size());
  rows.product(u, u, first);
  for (const std::size_t threads : {1, 2, 3}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    rows.product(u, u, again);
    EXPECT_EQ((first - again).norm(), 0);
  }
}

}  // namespace
}  // namespace hyperex::fem
