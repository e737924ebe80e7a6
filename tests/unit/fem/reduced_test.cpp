// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "hyperex/fem/form/assembler.hpp"
#include "hyperex/fem/reduced/basis.hpp"
#include "hyperex/fem/reduced/reduced_model.hpp"
#include "hyperex/fem/reduced/reduced_newmark.hpp"
#include "support/dense_newmark.hpp"
#include "support/layer.hpp"

namespace hyperex::fem {
namespace {

constexpr double kDt = 4e-3;

std::vector<test::SplineCourse> courses(int count, int knots = 10) {
  std::vector<test::SplineCourse> made;
  for (int k = 0; k < count; ++k)
    made.push_back(test::SplineCourse::random(1.0 / 30, knots, 50u + static_cast<unsigned>(k)));
  return made;
}

struct Driven {
  test::Layer layer;
  Drive drive;
  explicit Driven(int shapes, bool forces = true, test::LayerOptions options = {{7, 6, 2}})
      : layer(options), drive(layer.drive(2, forces, courses(shapes), kDt, 1)) {}
  Eigen::MatrixXd full() const {
    return test::full_run(layer.system, layer.prescribed, drive, {kDt});
  }
};

TEST(DenseProducts, EqualEigens) {
  const Driven on(1);
  const SparseMatrix& k = on.layer.system.stiffness;
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(k.cols(), 5),
                        b = Eigen::MatrixXd::Random(k.cols(), 3);
  EXPECT_LT((inner_products(a, b) - a.transpose() * b).norm(), 1e-12 * a.norm() * b.norm());
  EXPECT_LT((symmetric_product(k, b) - k * b).norm(), 1e-13 * (k * b).norm());
  Eigen::MatrixXd sum = b;
  const Eigen::MatrixXd mix = Eigen::MatrixXd::Random(5, 3);
  add_product(a, mix, -2, sum);
  EXPECT_LT((sum - (b - 2 * a * mix)).norm(), 1e-12 * sum.norm());
  EXPECT_EQ(inner_products(a.leftCols(0), b).rows(), 0);
}

TEST(Basis, IsOrthonormalInEnergyAndSpansWhatItWasGiven) {
  const Driven on(1);
  const System& s = on.layer.system;
  Basis basis(s);
  const Eigen::MatrixXd w = Eigen::MatrixXd::Random(s.mass.cols(), 5);
  EXPECT_EQ(basis.grow(w, 0).taken, 5);
  const Eigen::MatrixXd more =
      w * Eigen::MatrixXd::Random(5, 2) + 1e-3 * Eigen::MatrixXd::Random(s.mass.cols(), 2);
  EXPECT_EQ(basis.grow(more, 0).taken, 2);
  const Eigen::MatrixXd v = basis.vectors();
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(7, 7);
  EXPECT_LT((v.transpose() * (s.stiffness * v) - one).norm(), 1e-9);
  EXPECT_LT((basis.stiffness() - one).norm(), 1e-9);
  const Eigen::MatrixXd c = v.transpose() * (s.damping * v), m = v.transpose() * (s.mass * v);
  EXPECT_LT((basis.damping() - c).norm(), 1e-10 * c.norm());
  EXPECT_LT((basis.mass() - m).norm(), 1e-10 * m.norm());
  EXPECT_LT((basis.m_vectors() - s.mass * v).norm(), 1e-12 * (s.mass * v).norm());
  for (const Eigen::MatrixXd& given : {w, more}) {
    const Eigen::MatrixXd kept = v * (v.transpose() * (s.stiffness * given));
    EXPECT_LT((kept - given).norm(), 1e-7 * given.norm());
  }
}

TEST(Basis, TellsWhatItLeavesOut) {
  const Driven on(1);
  Basis basis(on.layer.system);
  Eigen::MatrixXd w = Eigen::MatrixXd::Random(on.layer.system.mass.cols(), 12);
  w.rightCols(4) *= 1e-6;
  const Basis::Grown grown = basis.grow(w, 1e-3);
  EXPECT_EQ(grown.taken, 8);
  EXPECT_GT(grown.skipped, 1e-7);
  EXPECT_LT(grown.skipped, 1e-4);
  EXPECT_EQ(basis.grow(Eigen::MatrixXd::Zero(w.rows(), 3), 0).taken, 0);
  EXPECT_EQ(basis.grow(w.leftCols(0), 0).taken, 0);
}

TEST(ReducedNewmark, EqualsADenseReference) {
  const auto box = test::box_mesh({1, 1, 1}, Vec3(0.01, 0.01, 0.01));
  System s =
      assemble(box.nodes, box.tets, test::varied_material(box.tets.rows()), ElementKind::tet4);
  for (int u = 0; u < s.stiffness.cols(); ++u) s.stiffness.coeffRef(u, u) += 100;
  Eigen::MatrixXd force(s.mass.cols(), 41);
  for (int t = 0; t <= 40; ++t)
    force.col(t) = std::cos(0.3 * t) * test::random_vector(force.rows(), 1);
  for (const NewmarkOptions& options :
       {NewmarkOptions{2e-3}, NewmarkOptions{2e-3, 0.3025, 0.6}, NewmarkOptions{5e-4, 0.5, 0.7}}) {
    const ReducedMotion found =
        integrate_reduced(Eigen::MatrixXd(s.stiffness), Eigen::MatrixXd(s.damping),
                          Eigen::MatrixXd(s.mass), force, options);
    test::DenseNewmark dense(s, {}, options);
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(force.rows());
    dense.start(zero, zero, Eigen::VectorXd(0), force.col(0));
    EXPECT_LT((found.a.col(0) - dense.a).norm(), 1e-9 * dense.a.norm());
    for (int t = 1; t <= 40; ++t) {
      dense.step(Eigen::VectorXd(0), force.col(t));
      EXPECT_LT((found.d.col(t) - dense.d).norm(), 1e-9 * dense.d.norm());
      EXPECT_LT((found.v.col(t) - dense.v).norm(), 1e-8 * dense.v.norm());
      EXPECT_LT((found.a.col(t) - dense.a).norm(), 1e-7 * dense.a.norm());
    }
  }
}

TEST(ReducedModel, GrowsUntilTheToleranceHolds) {
  const Driven on(3);
  const Eigen::MatrixXd full = on.full();
  ReducedModel model(on.layer.system, on.layer.prescribed);
  int before = 0;
  double error = 1;
  for (const double tolerance : {1e-1, 1e-3, 1e-5}) {
    const Response r = model.run(on.drive, {{kDt}, tolerance});
    EXPECT_TRUE(r.converged);
    EXPECT_GT(r.basis_size, before);
    EXPECT_LE(test::true_error(r, full), tolerance);
    EXPECT_LT(test::true_error(r, full), error);
    EXPECT_NEAR(r.greatest_displacement_m, test::greatest_motion(full),
                0.1 * test::greatest_motion(full));
    before = r.basis_size;
    error = test::true_error(r, full);
  }
  const Response few = model.run(on.drive, {{kDt}, 1e-9, 20});
  EXPECT_FALSE(few.converged);
  EXPECT_GT(few.estimated_error, 1e-9);
  EXPECT_LT(few.basis_size, 60) << "stopped soon after";
}

TEST(ReducedModel, TakesOtherValuesOfNewmark) {
  const Driven on(2);
  ReducedModel model(on.layer.system, on.layer.prescribed);
  const NewmarkOptions damped{kDt, 0.3025, 0.6};
  const Response r = model.run(on.drive, {damped, 1e-5});
  const Eigen::MatrixXd full =
      test::full_run(on.layer.system, on.layer.prescribed, on.drive, damped);
  EXPECT_LT(test::true_error(r, full), 1e-5);
  EXPECT_GT(test::true_error(r, on.full()), 1e-4);
}

TEST(ReducedModel, ServesStrainsAndStresses) {
  const Driven on(2);
  const Assembler assembler(on.layer.box.nodes, on.layer.box.tets, ElementKind::tet4_star);
  const Eigen::MatrixXd full = on.full();
  ReducedModel model(on.layer.system, on.layer.prescribed);
  const Eigen::MatrixXd d = test::all_steps(model.run(on.drive, {{kDt}, 1e-5}));
  double strain = 0, strain_apart = 0, stress = 0, stress_apart = 0;
  for (Eigen::Index t = 0; t < full.cols(); t += 5) {
    const Points x = test::unflat(d.col(t)), y = test::unflat(full.col(t));
    const VoigtRows e = assembler.strain(y);
    strain = std::max(strain, e.cwiseAbs().maxCoeff());
    strain_apart = std::max(strain_apart, (assembler.strain(x) - e).cwiseAbs().maxCoeff());
    const Eigen::VectorXd s = assembler.von_mises_pa(on.layer.material, y);
    stress = std::max(stress, s.maxCoeff());
    stress_apart = std::max(
        stress_apart, (assembler.von_mises_pa(on.layer.material, x) - s).cwiseAbs().maxCoeff());
  }
  EXPECT_LT(strain_apart, 1e-4 * strain);
  EXPECT_LT(stress_apart, 1e-4 * stress);
}

TEST(ReducedModel, ReadsOffBetweenSteps) {
  const Driven on(2);
  ReducedModel model(on.layer.system, on.layer.prescribed);
  const Response r = model.run(on.drive, {{kDt}, 1e-3});
  const Eigen::MatrixXd all = test::all_steps(r);
  const double last = on.drive.steps();
  const Eigen::MatrixXd at = r.displacement({0, 3, 3.25, last - 0.5, last, last + 7, -2});
  const Eigen::Index n = all.cols() - 1;
  const Eigen::MatrixXd expected =
      (Eigen::MatrixXd(all.rows(), 7) << all.col(0), all.col(3),
       0.75 * all.col(3) + 0.25 * all.col(4), 0.5 * (all.col(n - 1) + all.col(n)), all.col(n),
       all.col(n), all.col(0))
          .finished();
  EXPECT_LT((at - expected).cwiseAbs().maxCoeff(), 1e-12 * all.cwiseAbs().maxCoeff());
}

TEST(ReducedModel, StandsStillWithoutInput) {
  Driven on(2);
  ReducedModel model(on.layer.system, on.layer.prescribed);
  for (Eigen::MatrixXd* part : {&on.drive.s, &on.drive.rate, &on.drive.second}) part->setZero();
  Response r = model.run(on.drive, {{kDt}});
  EXPECT_TRUE(r.converged);
  EXPECT_EQ(test::all_steps(r).norm(), 0);
  EXPECT_EQ(r.estimated_error, 0);
  // No shapes at all.
  Drive none;
  none.prescribed.resize(on.drive.prescribed.rows(), 0);
  none.s = none.rate = none.second = Eigen::MatrixXd(0, 11);
  r = model.run(none, {{kDt}});
  EXPECT_TRUE(r.converged);
  EXPECT_EQ(r.displacement({0, 5}).norm(), 0);
  EXPECT_EQ(r.displacement({0, 5}).rows(), on.layer.system.mass.cols());
}

/// Superposition: the model is linear, so that the response to two drives is the sum of the
/// responses.
TEST(ReducedModel, AddsResponses) {
  const Driven whole(3);
  ReducedModel model(whole.layer.system, whole.layer.prescribed);
  Drive rest = whole.drive;
  for (Eigen::MatrixXd* part : {&rest.s, &rest.rate, &rest.second})
    for (Eigen::Index row = 0; row < 2; ++row) part->row(row).setZero();
  Drive first = whole.drive;
  for (Eigen::MatrixXd* part : {&first.s, &first.rate, &first.second}) part->row(2).setZero();
  const ReducedOptions how{{kDt}, 1e-4};
  const Response a = model.run(first, how), b = model.run(rest, how), sum = sum_of(a, b);
  EXPECT_EQ(sum.basis_size, a.basis_size + b.basis_size);
  EXPECT_TRUE(sum.converged);
  const Eigen::MatrixXd full = whole.full();
  EXPECT_LE(test::true_error(sum, full), sum.estimated_error);
  EXPECT_GT(test::true_error(a, full), 0.01) << "both parts matter";
  EXPECT_NEAR(sum.greatest_displacement_m, model.run(whole.drive, how).greatest_displacement_m,
              2e-4 * sum.greatest_displacement_m);
  // Where two parts nearly cancel, the error is not small relative to their sum.
  const Response little = sum_of(a, a, -0.999);
  EXPECT_GT(little.estimated_error, 100 * a.estimated_error);
  EXPECT_NEAR(little.greatest_displacement_m, 0.001 * a.greatest_displacement_m,
              1e-6 * a.greatest_displacement_m);
}

TEST(ReducedModel, TakesOneShapeAndOneStep) {
  const Driven on(1, false);
  ReducedModel model(on.layer.system, on.layer.prescribed);
  EXPECT_LE(test::true_error(model.run(on.drive, {{kDt}, 1e-4}), on.full()), 1e-4);
  Drive once = on.drive;
  for (Eigen::MatrixXd* part : {&once.s, &once.rate, &once.second})
    *part = part->leftCols(2).eval();
  const Response r = model.run(once, {{kDt}, 1e-4});
  const Eigen::MatrixXd full = test::full_run(on.layer.system, on.layer.prescribed, once, {kDt});
  // Short of the tolerance: all of a single step hangs on the acceleration at the start, which
  // static solutions hardly reach and the instants do not see.
  EXPECT_LE(test::true_error(r, full), 3e-3);
}

TEST(ReducedModel, TakesMoreShapesThanUnknowns) {
  test::Layer layer(test::LayerOptions{{2, 2, 1}});
  const Drive drive = layer.drive(1, true, courses(80), kDt, 1);
  ReducedModel model(layer.system, layer.prescribed);
  ASSERT_LT(model.free_count(), 80);
  const Response r = model.run(drive, {{kDt}, 1e-6});
  EXPECT_TRUE(r.converged);
  EXPECT_LE(r.basis_size, model.free_count());
  EXPECT_LE(test::true_error(r, test::full_run(layer.system, layer.prescribed, drive, {kDt})),
            1e-6);
}

TEST(ReducedModel, GivesTheSameNumbersOnEachRunAndOnAnyNumberOfThreads) {
  const Driven on(3);
  ReducedModel model(on.layer.system, on.layer.prescribed);
  const Eigen::MatrixXd first = test::all_steps(model.run(on.drive, {{kDt}}));
  EXPECT_EQ((test::all_steps(model.run(on.drive, {{kDt}})) - first).norm(), 0);
  for (const std::size_t threads : {1, 3}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    ReducedModel again(on.layer.system, on.layer.prescribed);
    EXPECT_EQ((test::all_steps(again.run(on.drive, {{kDt}})) - first).norm(), 0);
  }
}

TEST(ReducedModel, RefilledIsAsNew) {
  const Driven on(2);
  test::LayerOptions thin{{7, 6, 2}};
  thin.viscosity_pa_s = 100;
  const test::Layer other(thin);
  ReducedModel kept(on.layer.system, on.layer.prescribed), fresh(other.system, on.layer.prescribed);
  const Eigen::MatrixXd before = test::all_steps(kept.run(on.drive, {{kDt}}));
  System stiffer = other.system;
  stiffer.stiffness *= 1.5;
  kept.refill(stiffer);
  kept.refill(other.system);
  const Eigen::MatrixXd after = test::all_steps(kept.run(on.drive, {{kDt}}));
  EXPECT_EQ((after - test::all_steps(fresh.run(on.drive, {{kDt}}))).norm(), 0);
  EXPECT_GT((after - before).norm(), 1e-4 * before.norm());
}

}  // namespace
}  // namespace hyperex::fem
