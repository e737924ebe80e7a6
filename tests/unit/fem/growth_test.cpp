// SPDX-License-Identifier: GPL-3.0-or-later
// Tissue with another volume at rest, against what theory says of growth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hyperex/core/error.hpp"
#include "hyperex/fem/form/finite_strain.hpp"
#include "hyperex/fem/solve/static_solve.hpp"
#include "hyperex/fem/time/finite_newton.hpp"
#include "support/fem_support.hpp"
#include "support/laws.hpp"

namespace hyperex::fem {
namespace {
using Eigen::VectorXd;

test::BoxMesh grown_box() {
  return test::box_mesh({4, 3, 3}, {0.04, 0.03, 0.02}, 0.15);
}

std::vector<DilatationGroups> both_groups(const test::BoxMesh& mesh) {
  return {DilatationGroups{}, disjoint_stars(mesh.nodes.rows(), mesh.tets)};
}

/// Three unknowns of one corner, two of the next and one of a third: they prevent rigid motion and
/// nothing else.
std::vector<int> six_unknowns(const test::BoxMesh& mesh) {
  const auto node_at = [&](const Vec3& at) {
    Eigen::Index best = 0;
    (mesh.nodes.rowwise() - at.transpose()).rowwise().squaredNorm().minCoeff(&best);
    return int(best);
  };
  const Vec3 low = mesh.nodes.colwise().minCoeff(), high = mesh.nodes.colwise().maxCoeff();
  const int a = node_at(low), b = node_at({high.x(), low.y(), low.z()}),
            c = node_at({low.x(), high.y(), low.z()});
  std::vector<int> out = {3 * a, 3 * a + 1, 3 * a + 2, 3 * b + 1, 3 * b + 2, 3 * c + 2};
  std::sort(out.begin(), out.end());
  return out;
}

double volume_of(const test::BoxMesh& mesh, const VectorXd& d) {
  double sum = 0;
  for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t) {
    Points nodes = mesh.nodes;
    for (int k = 0; k < 4; ++k)
      nodes.row(mesh.tets(t, k)) += d.segment<3>(3 * mesh.tets(t, k)).transpose();
    sum += make_tet4(corners_of(nodes, mesh.tets, t)).volume;
  }
  return sum;
}

using Growths = std::vector<Eigen::Matrix3d>;

/// Different in each tetrahedron and in each direction, up to `size`.
Growths uneven(const test::BoxMesh& mesh, double size) {
  const VectorXd random = test::random_vector(9 * mesh.tets.rows(), 9);
  Growths out;
  for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t) {
    const Eigen::Matrix3d any = Eigen::Map<const Eigen::Matrix3d>(random.data() + 9 * t);
    out.emplace_back(Eigen::Matrix3d::Identity() + size / 3 * any * any.transpose());
  }
  return out;
}

VectorXd at_small_strain(const Assembler& assembler, const test::BoxMesh& mesh,
                         const Material& material, const Growths& growth) {
  System system;
  assembler.assemble(material, system);
  return StaticSolver(system.stiffness, six_unknowns(mesh))
      .solve(VectorXd::Zero(6), assembler.growth_force(material, growth));
}

VectorXd at_finite_strain(const Assembler& assembler, const test::BoxMesh& mesh,
                          const Material& material, const Hyperelastic& law,
                          const Growths& growth) {
  const Assembler grown = assembler.grown(growth);
  FiniteStrain form(grown, material, law);
  FiniteNewtonOptions how;
  how.tolerance = 1e-10;
  FiniteNewton newton(form, six_unknowns(mesh), how);
  newton.start();
  const VectorXd guess = at_small_strain(assembler, mesh, material, growth);
  newton.equilibrium(VectorXd::Zero(6), {}, {}, &guess);
  return newton.displacement();
}

TEST(Growth, OfAFreeBodyIsFreeOfStress) {
  const auto mesh = grown_box();
  const Material material = test::varied_material(mesh.tets.rows());
  const Vec3 stretch(1.2, 0.9, 1.3);
  const Growths growth(std::size_t(mesh.tets.rows()), stretch.asDiagonal());
  const Vec3 low = mesh.nodes.colwise().minCoeff();
  for (const DilatationGroups& groups : both_groups(mesh)) {
    const Assembler assembler(mesh.nodes, mesh.tets, groups);
    const VectorXd small = at_small_strain(assembler, mesh, material, growth);
    const Assembler grown = assembler.grown(growth);
    EXPECT_NEAR(grown.shapes()[5].volume, stretch.prod() * assembler.shapes()[5].volume,
                1e-12 * assembler.shapes()[5].volume);
    for (const Hyperelastic& law : test::all_laws()) {
      if (law.law == HyperelasticLaw::linear) continue;
      const VectorXd d = at_finite_strain(assembler, mesh, material, law, growth);
      for (Eigen::Index n = 0; n < mesh.nodes.rows(); ++n) {
        const Vec3 from_corner = mesh.nodes.row(n).transpose() - low;
        const Vec3 expected = stretch.cwiseProduct(from_corner) - from_corner;
        EXPECT_LT((d.segment<3>(3 * n) - expected).norm(), 1e-8);
        EXPECT_LT((small.segment<3>(3 * n) - expected).norm(), 1e-10);
      }
      FiniteStrain form(grown, material, law);
      EXPECT_LT(form.elastic_energy(d), 1e-10);
      EXPECT_LT(form.cauchy_stress_pa(d).cwiseAbs().maxCoeff(), 0.1) << to_string(law.law);
    }
  }
}

TEST(Growth, ForceIsTheGradientOfTheEnergyAtSmallStrain) {
  const auto mesh = grown_box();
  const Material material = test::varied_material(mesh.tets.rows());
  const Growths growth = uneven(mesh, 1e-6);
  for (const DilatationGroups& groups : both_groups(mesh)) {
    const Assembler assembler(mesh.nodes, mesh.tets, groups);
    const VectorXd force = assembler.growth_force(material, growth);
    const Assembler grown = assembler.grown(growth);
    for (const Hyperelastic& law : test::all_laws()) {
      FiniteStrain form(grown, material, law);
      VectorXd gradient;
      form.energy_and_gradient(VectorXd::Zero(force.size()), gradient);
      EXPECT_LT((gradient + force).norm(), 1e-4 * force.norm()) << to_string(law.law);
    }
  }
}

/// The mean stress of a body that no force acts on is zero. With one stiffness the mean strain is
/// therefore that of the growth, whatever its place.
TEST(Growth, OfAPartAddsItsVolumeToAFreeBodyOfOneStiffness) {
  const auto mesh = grown_box();
  const Material material = test::uniform_material(mesh.tets.rows(), 2e5, 0.4, 0, 1000);
  const VectorXd none = VectorXd::Zero(mesh.nodes.size());
  for (const DilatationGroups& groups : both_groups(mesh)) {
    const Assembler assembler(mesh.nodes, mesh.tets, groups);
    for (const double size : {1e-3, 0.2}) {
      const Growths growth = uneven(mesh, size);
      double added = 0;
      for (std::size_t t = 0; t < growth.size(); ++t)
        added += (growth[t].trace() - 3) * assembler.shapes()[t].volume;
      const VectorXd d = at_small_strain(assembler, mesh, material, growth);
      double gained = 0;
      for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t)
        for (int a = 0; a < 4; ++a)
          gained += assembler.shapes()[std::size_t(t)].volume *
                    assembler.shapes()[std::size_t(t)].gradient.row(a).dot(
                        d.segment<3>(3 * mesh.tets(t, a)));
      EXPECT_NEAR(gained, added, 1e-9 * std::abs(added));
      const VectorXd finite = at_finite_strain(assembler, mesh, material, Hyperelastic{}, growth);
      EXPECT_NEAR(volume_of(mesh, finite) - volume_of(mesh, none), added, size * added);
      EXPECT_LT((finite - d).norm(), size * d.norm());
    }
  }
}

TEST(Growth, HasItsDerivativesAtFiniteStrain) {
  const auto mesh = grown_box();
  const Material material = test::varied_material(mesh.tets.rows());
  const Growths growth = uneven(mesh, 0.3);
  for (const DilatationGroups& groups : both_groups(mesh)) {
    const Assembler grown = Assembler(mesh.nodes, mesh.tets, groups).grown(growth);
    for (const Hyperelastic& law : test::all_laws()) {
      FiniteStrain form(grown, material, law);
      const VectorXd d = 5e-4 * test::random_vector(mesh.nodes.size(), 5),
                     v = test::random_vector(mesh.nodes.size(), 6);
      constexpr double h = 1e-7;
      VectorXd gradient, up, down;
      form.energy_and_gradient(d, gradient);
      EXPECT_NEAR((form.energy(d + h * v) - form.energy(d - h * v)) / (2 * h), gradient.dot(v),
                  2e-6 * gradient.norm() * v.norm())
          << to_string(law.law);
      SparseMatrix k;
      form.tangent(d, 0, false, k);
      form.energy_and_gradient(d + h * v, up);
      form.energy_and_gradient(d - h * v, down);
      const VectorXd kv = k * v;
      EXPECT_LT((kv - (up - down) / (2 * h)).norm(), 2e-6 * kv.norm()) << to_string(law.law);
    }
  }
}

/// J. D. Eshelby, Proc. R. Soc. A 241 (1957) 376: a sphere (radius a) in a large body wants to
/// stretch by e in all directions. Inside, the displacement is (1 + nu) / (3 (1 - nu)) e r; outside
/// it falls off as a^3 / r^2. In a ball of radius R whose surface is free, the image field
/// 2 (1 - 2 nu) / (3 (1 - nu)) e (a / R)^3 r is added. Here e = 1/3 % in a ball of a = R / 2.
TEST(Growth, OfABallWithinABallIsEshelbys) {
  const test::BoxMesh cube = test::box_mesh({16, 16, 16}, {2, 2, 2}, 0);
  test::BoxMesh mesh = cube;
  for (Eigen::Index n = 0; n < mesh.nodes.rows(); ++n) {  // spheres in place of the cube's shells
    const Vec3 p = cube.nodes.row(n).transpose() - Vec3(1, 1, 1);
    const double shell = p.cwiseAbs().maxCoeff();
    mesh.nodes.row(n) =
        (shell > 0 ? Vec3(0.02 * shell * p.normalized()) : Vec3::Zero()).transpose();
  }
  constexpr double radius = 0.02, inner = 0.01, stretch = 1e-3, nu = 0.4;
  const Material material = test::uniform_material(mesh.tets.rows(), 2e5, nu, 0, 1000);
  const Assembler assembler(mesh.nodes, mesh.tets, DilatationGroups{});
  Growths growth(std::size_t(mesh.tets.rows()), Eigen::Matrix3d::Identity());
  for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t)
    if (corners_of(mesh.nodes, mesh.tets, t).rowwise().norm().maxCoeff() < inner * (1 + 1e-6))
      growth[std::size_t(t)] *= 1 + stretch;
  System system;
  assembler.assemble(material, system);
  // The middle is held, and rigid turns by the plane of the cube's middle.
  const auto node_at = [&](const Vec3& at) {
    Eigen::Index best = 0;
    (mesh.nodes.rowwise() - at.transpose()).rowwise().squaredNorm().minCoeff(&best);
    return int(best);
  };
  const int middle = node_at(Vec3::Zero()), x = node_at({radius, 0, 0}),
            y = node_at({0, radius, 0});
  std::vector<int> held = {3 * middle, 3 * middle + 1, 3 * middle + 2,
                           3 * x + 1,  3 * x + 2,      3 * y + 2};
  std::sort(held.begin(), held.end());
  const VectorXd d = StaticSolver(system.stiffness, held)
                         .solve(VectorXd::Zero(6), assembler.growth_force(material, growth));
  const double image = 2 * (1 - 2 * nu) / (3 * (1 - nu)) * std::pow(inner / radius, 3);
  const double inside = (1 + nu) / (3 * (1 - nu));
  double worst = 0, mean = 0;
  int count = 0;
  for (Eigen::Index n = 0; n < mesh.nodes.rows(); ++n) {
    const Vec3 p = mesh.nodes.row(n);
    const double r = p.norm();
    if (r == 0) continue;
    const double exact =
        stretch * (image * r + inside * (r < inner ? r : std::pow(inner, 3) / (r * r)));
    const double error = (d.segment<3>(3 * n) - exact * p / r).norm();
    worst = std::max(worst, error);
    mean += error;
    ++count;
  }
  mean /= count;
  const double at_border = stretch * (image + inside) * inner;
  EXPECT_LT(mean, 0.05 * at_border);
  EXPECT_LT(worst, 0.15 * at_border);
  RecordProperty("mean_share", std::to_string(mean / at_border));
  RecordProperty("worst_share", std::to_string(worst / at_border));
}

TEST(Growth, RefusesTensorsThatAreNone) {
  const auto mesh = grown_box();
  const Assembler assembler(mesh.nodes, mesh.tets, DilatationGroups{});
  const auto of_one = [&](const Eigen::Matrix3d& tensor) {
    Growths out(std::size_t(mesh.tets.rows()), Eigen::Matrix3d::Identity());
    out[3] = tensor;
    return out;
  };
  Eigen::Matrix3d skew = Eigen::Matrix3d::Identity();
  skew(0, 1) = 0.2;
  const auto material = test::varied_material(mesh.tets.rows());
  for (const Eigen::Matrix3d& tensor : {Eigen::Matrix3d(-Eigen::Matrix3d::Identity()), skew,
                                        Eigen::Matrix3d(Eigen::Matrix3d::Constant(std::nan("")))}) {
    EXPECT_THROW(assembler.grown(of_one(tensor)), InputError);
    EXPECT_THROW(assembler.growth_force(material, of_one(tensor)), InputError);
  }
  EXPECT_THROW(assembler.grown({Eigen::Matrix3d::Identity()}), InputError);
}

}  // namespace
}  // namespace hyperex::fem
