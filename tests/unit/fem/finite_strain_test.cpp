// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/form/finite_strain.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "hyperex/fem/solve/partition.hpp"
#include "support/fem_support.hpp"
#include "support/laws.hpp"

namespace hyperex::fem {
namespace {

using Eigen::Matrix3d;
using Eigen::VectorXd;

const Vec3 kBlockSize{0.04, 0.03, 0.02};

test::BoxMesh box() {
  return test::box_mesh({3, 2, 2}, kBlockSize, 0.15);
}

std::vector<DilatationGroups> all_groups(const test::BoxMesh& mesh) {
  DilatationGroups kept = disjoint_stars(mesh.nodes.rows(), mesh.tets);
  kept.kept = 2;
  return {DilatationGroups{}, disjoint_stars(mesh.nodes.rows(), mesh.tets), kept};
}

/// Large displacements, different at each node, without inverted elements up to about 2 mm.
VectorXd motion(const test::BoxMesh& mesh, double size_m, unsigned seed = 5) {
  return size_m * test::random_vector(mesh.nodes.size(), seed);
}

/// The displacement after a rigid motion: Q (x + d) + c - x.
VectorXd turned(const test::BoxMesh& mesh, const VectorXd& d, const Matrix3d& q) {
  VectorXd out(d.size());
  for (Eigen::Index n = 0; n < mesh.nodes.rows(); ++n) {
    const Vec3 x = mesh.nodes.row(n).transpose();
    out.segment<3>(3 * n) = q * (x + d.segment<3>(3 * n)) + Vec3(0.1, 0.2, -0.1) - x;
  }
  return out;
}

Matrix3d rotation(double angle = 1.1) {
  return Eigen::AngleAxisd(angle, Vec3(1, 2, -0.5).normalized()).toRotationMatrix();
}

const RateRule kEuler{100, -100, 0, 0.01};
/// BDF2 after a step of half the length.
RateRule bdf2(double w = 2, double h = 0.01) {
  return {(1 + 2 * w) / ((1 + w) * h), -(1 + w) / h, w * w / ((1 + w) * h), h};
}

/// |gradient - central differences of the energy| and |K v - differences of the gradient|.
std::pair<double, double> errors(FiniteStrain& form, const VectorXd& d, double h = 1e-7) {
  VectorXd gradient, up, down, numeric(d.size());
  form.energy_and_gradient(d, gradient);
  for (Eigen::Index i = 0; i < d.size(); ++i) {
    VectorXd x = d;
    x[i] += h;
    const double more = form.energy(x);
    x[i] -= 2 * h;
    numeric[i] = (more - form.energy(x)) / (2 * h);
  }
  SparseMatrix k;
  form.tangent(d, 0, false, k);
  const VectorXd v = test::random_vector(d.size(), 77);
  form.energy_and_gradient(d + h * v, up);
  form.energy_and_gradient(d - h * v, down);
  const VectorXd kv = k * v;
  return {(gradient - numeric).norm() / gradient.norm(),
          (kv - (up - down) / (2 * h)).norm() / kv.norm()};
}

TEST(FiniteStrain, TangentAtRestIsTheLinearStiffness) {
  const auto mesh = box();
  const Material material = test::varied_material(mesh.tets.rows());
  for (const DilatationGroups& groups : all_groups(mesh)) {
    const Assembler assembler(mesh.nodes, mesh.tets, groups);
    System system;
    assembler.assemble(material, system);
    for (const Hyperelastic& law : test::all_laws()) {
      FiniteStrain form(assembler, material, law);
      SparseMatrix k;
      VectorXd d = VectorXd::Zero(mesh.nodes.size()), gradient;
      form.tangent(d, 0, false, k);
      ASSERT_EQ(k.nonZeros(), system.stiffness.nonZeros());
      EXPECT_LT((k - system.stiffness).norm(), 1e-12 * system.stiffness.norm())
          << to_string(law.law);
      form.tangent(d, 0, true, k);
      EXPECT_LT((k - system.stiffness).norm(), 1e-12 * system.stiffness.norm());
      // Rates and mass: A of the linear time step.
      form.begin_step(kEuler, d, d);
      form.tangent(d, 1e4, false, k);
      const SparseMatrix a = combined(system, kEuler.now, 1e4);
      EXPECT_LT((k - a).norm(), 1e-12 * a.norm()) << to_string(law.law);
      EXPECT_LT(form.energy_and_gradient(d, gradient), 1e-15);
      EXPECT_LT(gradient.norm(), 1e-11);
      form.mass_product(motion(mesh, 1), d);
      EXPECT_LT((d - system.mass * motion(mesh, 1)).norm(), 1e-13 * d.norm());
    }
  }
}

TEST(FiniteStrain, GradientAndTangentAreDerivatives) {
  const auto mesh = box();
  const Material material = test::varied_material(mesh.tets.rows());
  for (const DilatationGroups& groups : all_groups(mesh)) {
    const Assembler assembler(mesh.nodes, mesh.tets, groups);
    for (Hyperelastic law : test::all_laws()) {
      FiniteStrain form(assembler, material, law);
      // 5 mm turn elements inside out: the barrier's and the powers' continuation.
      for (const double size : {5e-4, 1.5e-3, 5e-3}) {
        const auto [gradient, tangent] = errors(form, motion(mesh, size));
        EXPECT_LT(gradient, 2e-6) << to_string(law.law) << " " << size;
        EXPECT_LT(tangent, 2e-6) << to_string(law.law) << " " << size;
      }
    }
  }
}

TEST(FiniteStrain, ViscousAndMaxwellPotentialsHaveTheirDerivatives) {
  const auto mesh = box();
  Material material = test::varied_material(mesh.tets.rows());
  const Assembler assembler(mesh.nodes, mesh.tets, ElementKind::tet4_star);
  for (Hyperelastic law : test::all_laws()) {
    law.branches = {{0.5, 0.02}, {0.3, 0.2}};
    FiniteStrain form(assembler, material, law);
    for (const RateRule& rule : {kEuler, bdf2(1), bdf2(0.5)}) {
      const VectorXd before = motion(mesh, 1e-3, 1), last = before + motion(mesh, 1e-4, 2);
      form.begin_step(kEuler, before, before);
      form.accept(last);
      form.begin_step(rule, last, before);
      const auto [gradient, tangent] = errors(form, motion(mesh, 1.2e-3, 3));
      EXPECT_LT(gradient, 2e-6) << to_string(law.law);
      EXPECT_LT(tangent, 2e-6) << to_string(law.law);
    }
  }
}

TEST(FiniteStrain, RigidMotionCostsNothingAndTurnsForces) {
  const auto mesh = box();
  const Material material = test::varied_material(mesh.tets.rows());
  const Assembler assembler(mesh.nodes, mesh.tets, ElementKind::tet4_star);
  for (Hyperelastic law : test::finite_laws()) {
    law.branches = {{0.5, 0.02}};
    FiniteStrain form(assembler, material, law);
    const VectorXd rest = VectorXd::Zero(mesh.nodes.size());
    VectorXd gradient, other;
    const double unit = 2e5 * kBlockSize.prod();
    for (const RateRule& rule : {kEuler, bdf2()}) {
      form.rest_at(rest);
      form.begin_step(rule, turned(mesh, rest, rotation(0.5)), rest);
      EXPECT_LT(form.energy_and_gradient(turned(mesh, rest, rotation()), gradient), 1e-12 * unit);
      EXPECT_LT(gradient.norm(), 1e-11 * unit / kBlockSize.norm());
    }
    // A history turned as a whole, each instant by the same rotation, gives turned forces.
    const VectorXd a = motion(mesh, 1e-3, 1), b = a + motion(mesh, 1e-4, 2),
                   c = b + motion(mesh, 1e-3, 3);
    const auto run = [&](const Matrix3d& q, VectorXd& force) {
      form.rest_at(rest);
      form.begin_step(kEuler, turned(mesh, a, q), turned(mesh, a, q));
      form.accept(turned(mesh, b, q));
      form.begin_step(bdf2(1), turned(mesh, b, q), turned(mesh, a, q));
      return form.energy_and_gradient(turned(mesh, c, q), force);
    };
    const double energy = run(Matrix3d::Identity(), gradient), same = run(rotation(), other);
    EXPECT_NEAR(same, energy, 1e-11 * std::abs(energy)) << to_string(law.law);
    for (Eigen::Index n = 0; n < mesh.nodes.rows(); ++n)
      EXPECT_LT((other.segment<3>(3 * n) - rotation() * gradient.segment<3>(3 * n)).norm(),
                1e-10 * gradient.norm());
  }
}

/// At small strain the dissipation follows Stokes' law.
TEST(FiniteStrain, ViscousForceAtSmallStrainIsStokes) {
  const auto mesh = box();
  const Material material = test::varied_material(mesh.tets.rows());
  const Assembler assembler(mesh.nodes, mesh.tets, ElementKind::tet4);
  System system;
  assembler.assemble(material, system);
  FiniteStrain form(assembler, material, {});
  const VectorXd before = motion(mesh, 1e-8, 1), last = motion(mesh, 1e-8, 2),
                 now = motion(mesh, 1e-8, 3);
  const RateRule rule = bdf2(0.7);
  form.begin_step(rule, last, before);
  VectorXd with, without;
  form.energy_and_gradient(now, with);
  form.rest_at(last);
  form.energy_and_gradient(now, without);
  const VectorXd expected =
      system.damping * (rule.now * now + rule.last * last + rule.before * before);
  EXPECT_LT((with - without - expected).norm(), 1e-5 * expected.norm());
}

/// A given rate at large strain: uniform stretching F = diag(l, 1, 1), where Cauchy's viscous
/// stress is 2 eta dev(D) with D = diag(l'/l, 0, 0).
TEST(FiniteStrain, ViscousStressAtLargeStrainIsNewtonsLaw) {
  const auto mesh = box();
  const double eta = 400, rate = 3;  // 1/s
  const Material material = test::uniform_material(mesh.tets.rows(), 1e-3, 0.3, eta, 1000);
  const Assembler assembler(mesh.nodes, mesh.tets, ElementKind::tet4);
  FiniteStrain form(assembler, material, {});
  const auto at = [&](double t) {
    VectorXd d = VectorXd::Zero(mesh.nodes.size());
    for (Eigen::Index n = 0; n < mesh.nodes.rows(); ++n)
      d[3 * n] = (std::exp(rate * t) - 1) * mesh.nodes(n, 0);
    return d;
  };
  std::vector<double> errors;
  for (const double h : {0.01, 0.005, 0.0025}) {
    const double t = 0.2;
    form.begin_step(bdf2(1, h), at(t - h), at(t - 2 * h));
    VectorXd gradient;
    form.energy_and_gradient(at(t), gradient);
    // Force on the side x = size: Piola's stress is Cauchy's times J / l = 1.
    double force = 0;
    for (Eigen::Index n = 0; n < mesh.nodes.rows(); ++n)
      if (mesh.nodes(n, 0) > kBlockSize.x() - 1e-9) force += gradient[3 * n];
    const double exact = 2 * eta * 2 / 3 * rate * kBlockSize.y() * kBlockSize.z();
    errors.push_back(std::abs(force / exact - 1));
  }
  EXPECT_LT(errors[0], 0.01);
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.2);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2, 0.2);
}

TEST(FiniteStrain, BranchesRelaxAtHeldStretch) {
  const auto mesh = box();
  const Material material = test::uniform_material(mesh.tets.rows(), 1e5, 0.45, 0, 1000);
  const Assembler assembler(mesh.nodes, mesh.tets, ElementKind::tet4_star);
  for (Hyperelastic law : test::all_laws()) {
    law.barrier = false;
    law.branches = {{0.5, 0.05}, {0.25, 0.4}};
    FiniteStrain form(assembler, material, law);
    const VectorXd rest = VectorXd::Zero(mesh.nodes.size());
    // A stretch without change of volume, so that there is no other stress.
    VectorXd held = rest, force, law_force;
    for (Eigen::Index n = 0; n < mesh.nodes.rows(); ++n) {
      const Vec3 stretch =
          law.law == HyperelasticLaw::linear ? Vec3(1.3, 0.85, 0.85) : Vec3(1.3, 1, 1 / 1.3);
      held.segment<3>(3 * n) = mesh.nodes.row(n).transpose().cwiseProduct(stretch - Vec3::Ones());
    }
    form.rest_at(rest);
    form.energy_and_gradient(held, law_force);
    // At once, in a step much shorter than both times; then steps of unequal length.
    double t = 0;
    form.begin_step({1e9, -1e9, 0, 1e-9}, rest, rest);
    form.accept(held);
    for (const double h : {0.01, 0.03, 0.1, 0.2}) {
      form.begin_step({1 / h, -1 / h, 0, h}, held, held);
      t += h;
      form.energy_and_gradient(held, force);
      const double ratio = 1 + 0.5 * std::exp(-t / 0.05) + 0.25 * std::exp(-t / 0.4);
      EXPECT_LT((force - ratio * law_force).norm(), 1e-6 * law_force.norm())
          << to_string(law.law) << " " << t;
      form.accept(held);
    }
  }
}

/// For a stress that rises linearly the recursion is exact for any step: g (1 - exp(-t / tau)) tau
/// times the rate of the stress.
TEST(FiniteStrain, BranchesAreExactForALinearCourseOfStress) {
  const auto mesh = box();
  const Material material = test::uniform_material(mesh.tets.rows(), 1e5, 0.45, 0, 1000);
  const Assembler assembler(mesh.nodes, mesh.tets, ElementKind::tet4);
  Hyperelastic law = test::law_of(HyperelasticLaw::linear);
  law.branches = {{0.5, 0.05}};
  FiniteStrain form(assembler, material, law);
  VectorXd way = VectorXd::Zero(mesh.nodes.size()), unit, force;
  for (Eigen::Index n = 0; n < mesh.nodes.rows(); ++n) way[3 * n] = mesh.nodes(n, 1);
  form.energy_and_gradient(way, unit);
  VectorXd last = 0 * way;
  double t = 0;
  for (const double h : {0.02, 0.05, 0.01}) {
    form.begin_step({1 / h, -1 / h, 0, h}, last, last);
    t += h;
    last = t * way;
    form.energy_and_gradient(last, force);
    const double expected = t + 0.5 * 0.05 * (1 - std::exp(-t / 0.05));
    EXPECT_LT((force - expected * unit).norm(), 1e-12 * force.norm());
    form.accept(last);
  }
}

TEST(FiniteStrain, ProjectedTangentIsSemidefiniteWhereTheExactOneIsNot) {
  const auto mesh = box();
  const Material material = test::uniform_material(mesh.tets.rows(), 1e5, 0.495, 0, 1000);
  const Assembler assembler(mesh.nodes, mesh.tets, ElementKind::tet4_star);
  for (const Hyperelastic& law : test::finite_laws()) {
    FiniteStrain form(assembler, material, law);
    VectorXd d(mesh.nodes.size());
    for (Eigen::Index n = 0; n < mesh.nodes.rows(); ++n)
      d.segment<3>(3 * n) = -0.4 * mesh.nodes.row(n).transpose();
    SparseMatrix k;
    form.tangent(d, 0, false, k);
    const auto least = [&] {
      return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(Eigen::MatrixXd(k)).eigenvalues()[0];
    };
    EXPECT_LT(least(), -1e-3 * k.norm()) << to_string(law.law);
    form.tangent(d, 0, true, k);
    EXPECT_GT(least(), -1e-12 * k.norm()) << to_string(law.law);
    EXPECT_LT((k - SparseMatrix(k.transpose())).norm(), 1e-13 * k.norm());
  }
}

TEST(FiniteStrain, OutputsOfAnAffineMotion) {
  const auto mesh = box();
  const double shear = 3e4, nu = 0.4, young = 2 * shear * (1 + nu), bulk = young / 3 / (1 - 2 * nu);
  const Material material = test::uniform_material(mesh.tets.rows(), young, nu, 0, 1000);
  Matrix3d f;
  f << 1.2, 0.3, -0.1, 0.05, 0.9, 0.2, 0.1, -0.15, 1.1;
  VectorXd d(mesh.nodes.size());
  for (Eigen::Index n = 0; n < mesh.nodes.rows(); ++n)
    d.segment<3>(3 * n) = (f - Matrix3d::Identity()) * mesh.nodes.row(n).transpose();
  const double j = f.determinant();
  const Matrix3d e = (f.transpose() * f - Matrix3d::Identity()) / 2;
  for (const DilatationGroups& groups : all_groups(mesh)) {
    const Assembler assembler(mesh.nodes, mesh.tets, groups);
    for (const Hyperelastic& law : test::finite_laws()) {
      FiniteStrain form(assembler, material, law);
      EXPECT_LT((form.volume_ratio(d).array() - j).abs().maxCoeff(), 1e-12);
      for (const Matrix3d& found : form.deformation_gradient(d))
        EXPECT_LT((found - f).norm(), 1e-12);
      Eigen::Matrix<double, 1, 6> row;
      row << e(0, 0), e(1, 1), e(2, 2), 2 * e(0, 1), 2 * e(1, 2), 2 * e(2, 0);
      EXPECT_LT((form.green_lagrange(d).rowwise() - row).cwiseAbs().maxCoeff(), 1e-12);
      const Matrix3d stress =
          first_piola_pa(law, shear, f) * f.transpose() / j + bulk * (j - 1) * Matrix3d::Identity();
      row << stress(0, 0), stress(1, 1), stress(2, 2), stress(0, 1), stress(1, 2), stress(2, 0);
      EXPECT_LT((form.cauchy_stress_pa(d).rowwise() - row).cwiseAbs().maxCoeff(),
                1e-9 * row.norm());
      const Vec3 singular = f.jacobiSvd().singularValues().reverse();
      EXPECT_LT((form.principal_stretches(d).rowwise() - singular.transpose()).norm(), 1e-11);
    }
  }
}

TEST(FiniteStrain, NumbersDoNotDependOnTheNumberOfThreads) {
  const auto mesh = test::box_mesh({8, 7, 6}, kBlockSize, 0.1);
  Material material = test::varied_material(mesh.tets.rows());
  const Assembler assembler(mesh.nodes, mesh.tets, ElementKind::tet4_star);
  const auto run = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    FiniteStrain form(assembler, material, {});
    const VectorXd d = motion(mesh, 3e-4);
    form.begin_step(kEuler, 0.5 * d, d);
    VectorXd gradient;
    const double energy = form.energy_and_gradient(d, gradient);
    SparseMatrix k;
    form.tangent(d, 3, false, k);
    return std::tuple(energy, gradient, k);
  };
  const auto [e1, g1, k1] = run(1);
  const auto [e2, g2, k2] = run(4);
  EXPECT_EQ(e1, e2);
  EXPECT_EQ(g1, g2);
  EXPECT_TRUE(std::equal(k1.valuePtr(), k1.valuePtr() + k1.nonZeros(), k2.valuePtr()));
}

/// Springs to the ground, as an energy of the nodes.
class Spring : public NodalPotential {
 public:
  double add_gradient(const VectorXd& d, VectorXd& gradient) const override {
    gradient.segment<3>(6) += 5 * d.segment<3>(6);
    return 2.5 * d.segment<3>(6).squaredNorm();
  }
  void add_tangent(const VectorXd&, TangentBlocks& blocks) const override {
    blocks.add(2, 5 * Matrix3d::Identity());
    Matrix3d coupling = Matrix3d::Zero();
    coupling(0, 1) = 7;
    EXPECT_TRUE(blocks.add(2, 3, coupling));
    EXPECT_FALSE(blocks.add(0, 35, coupling)) << "nodes at opposite ends";
  }
};

TEST(NodalPotential, AddsBlocksToAMatrixOfThisPattern) {
  const auto mesh = box();
  const Assembler assembler(mesh.nodes, mesh.tets, ElementKind::tet4);
  SparseMatrix k = assembler.stiffness_pattern();
  TangentBlocks blocks(assembler.stiffness_neighbours(), k);
  Spring().add_tangent({}, blocks);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(k.rows(), k.cols());
  expected.block<3, 3>(6, 6).diagonal().setConstant(5);
  expected(6, 10) = 7;
  EXPECT_TRUE(Eigen::MatrixXd(k) == expected);
}

}  // namespace
}  // namespace hyperex::fem
