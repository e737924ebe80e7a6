// SPDX-License-Identifier: GPL-3.0-or-later
// Equilibria at finite strain compared with closed forms: affine fields, stretched blocks, an
// inflated sphere. For every law and both elements.
#include <gtest/gtest.h>

#include "hyperex/fem/time/finite_newton.hpp"
#include "support/conformance.hpp"
#include "support/laws.hpp"

namespace hyperex::fem {
namespace {

using Eigen::Matrix3d;
using Eigen::VectorXd;

struct Case {
  ElementKind element;
  Hyperelastic law;
  friend void PrintTo(const Case& c, std::ostream* out) { *out << name(c); }
  static std::string name(const Case& c) {
    std::string text = std::string(to_string(c.element)) + "_" + std::string(to_string(c.law.law));
    std::replace(text.begin(), text.end(), '-', '_');
    return text;
  }
};

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const ElementKind element : kElementKinds)
    for (const Hyperelastic& law : test::finite_laws()) cases.push_back({element, law});
  return cases;
}

/// Conditions for every law on a distorted mesh of either element.
class FiniteConformance : public testing::TestWithParam<Case>, protected test::DistortedBox {
 protected:
  static test::BoxMesh box() { return test::box_mesh({4, 3, 3}, kSize, 0.15); }
  static Assembler assembler(const test::BoxMesh& box) {
    return {box.nodes, box.tets, GetParam().element};
  }
};

INSTANTIATE_TEST_SUITE_P(AllLaws, FiniteConformance, testing::ValuesIn(all_cases()),
                         [](const auto& tested) { return Case::name(tested.param); });

FiniteNewtonOptions exact() {
  FiniteNewtonOptions options;
  options.tolerance = 1e-11;
  options.full_newton = true;
  return options;
}

VectorXd affine(const Points& nodes, const Matrix3d& f) {
  VectorXd d(nodes.size());
  for (Eigen::Index n = 0; n < nodes.rows(); ++n)
    d.segment<3>(3 * n) = (f - Matrix3d::Identity()) * nodes.row(n).transpose();
  return d;
}

TEST_P(FiniteConformance, AnAffineMotionOfTheBoundaryGoesThroughTheWholeBody) {
  const auto box = this->box();
  const auto boundary = test::unknowns_where(box.nodes, on_boundary);
  Matrix3d f;
  f << 1.25, 0.3, -0.1, 0.05, 0.85, 0.2, 0.1, -0.15, 1.05;
  for (const double nu : {0.3, 0.495}) {
    const Material m = test::uniform_material(box.tets.rows(), 192.4e3, nu, 0, 1100);
    const Assembler mesh = assembler(box);
    FiniteStrain form(mesh, m, GetParam().law);
    FiniteNewton newton(form, boundary, exact());
    const VectorXd d = affine(box.nodes, f);
    newton.equilibrium(d(boundary));
    EXPECT_LT((newton.displacement() - d).cwiseAbs().maxCoeff(), 1e-9 * d.cwiseAbs().maxCoeff());
    // The stress is that of the law at a point, and the forces are in equilibrium with it.
    const double shear = shear_modulus_pa(192.4e3, nu), bulk = bulk_modulus_pa(192.4e3, nu);
    const Matrix3d piola =
        first_piola_pa(GetParam().law, shear, f) + bulk * (f.determinant() - 1) * cofactor(f);
    Matrix3d sum = Matrix3d::Zero();
    for (Eigen::Index n = 0; n < box.nodes.rows(); ++n)
      sum += newton.reaction().segment<3>(3 * n) * box.nodes.row(n);
    EXPECT_LT((sum / kSize.prod() - piola).norm(), 1e-7 * piola.norm());
  }
}

/// The stretch l2 at which the free sides carry no force, found by bisection: uniaxial where two
/// sides are free, biaxial where one is.
double free_stretch(const Hyperelastic& law, double shear, double bulk, double l, bool biaxial) {
  const auto force = [&](double s) {
    const Matrix3d f = Vec3(l, biaxial ? l : s, s).asDiagonal();
    return (first_piola_pa(law, shear, f) + bulk * (f.determinant() - 1) * cofactor(f))(2, 2);
  };
  double low = 0.2, high = 3;
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    (force(middle) < 0 ? low : high) = middle;
  }
  return (low + high) / 2;
}

TEST_P(FiniteConformance, AStretchedBlockContractsAsThePointDoes) {
  const auto box = this->box();
  const double young = 2e4, nu = 0.49;
  const double shear = shear_modulus_pa(young, nu), bulk = bulk_modulus_pa(young, nu);
  const Material m = test::uniform_material(box.tets.rows(), young, nu, 0, 1100);
  const Assembler mesh = assembler(box);
  for (const bool biaxial : {false, true})
    for (const double l : {0.7, 1.5}) {
      FiniteStrain form(mesh, m, GetParam().law);
      const auto side = [](double at, double to) { return std::abs(at - to) < 1e-9; };
      std::vector<int> prescribed;  // planes of symmetry and the loaded ends
      for (int n = 0; n < box.nodes.rows(); ++n)
        for (int axis = 0; axis < 3; ++axis)
          if (side(box.nodes(n, axis), 0) ||
              (axis < (biaxial ? 2 : 1) && side(box.nodes(n, axis), kSize[axis])))
            prescribed.push_back(3 * n + axis);
      FiniteNewton newton(form, prescribed, exact());
      const double s = free_stretch(GetParam().law, shear, bulk, l, biaxial);
      const Matrix3d f = Vec3(l, biaxial ? l : s, s).asDiagonal();
      const VectorXd d = affine(box.nodes, f);
      newton.equilibrium(d(prescribed));
      EXPECT_LT((newton.displacement() - d).norm(), 1e-8 * d.norm()) << l << " " << biaxial;
      const VoigtRows cauchy = form.cauchy_stress_pa(newton.displacement());
      EXPECT_LT(cauchy.col(2).cwiseAbs().maxCoeff(), 1e-6 * cauchy.col(0).cwiseAbs().minCoeff());
      // Nearly incompressible: the uniaxial stress of textbooks, up to terms of 1/bulk.
      if (GetParam().law.law == HyperelasticLaw::neo_hookean && !biaxial) {
        EXPECT_NEAR(cauchy(0, 0), shear * (l * l - 1 / l), 0.06 * std::abs(cauchy(0, 0)));
      }
    }
}

TEST_P(FiniteConformance, ARotatedBodyRestsWhereItIs) {
  const auto box = this->box();
  const Material m = test::varied_material(box.tets.rows());
  const Assembler mesh = assembler(box);
  FiniteStrain form(mesh, m, GetParam().law);
  const Matrix3d q = Eigen::AngleAxisd(2, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const VectorXd d = affine(box.nodes, q);
  VectorXd force;
  EXPECT_LT(form.energy_and_gradient(d, force), 1e-14);
  EXPECT_LT(force.norm(), 1e-9);
  EXPECT_LT(form.green_lagrange(d).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT(form.cauchy_stress_pa(d).cwiseAbs().maxCoeff(), 1e-7);
}

/// A thick sphere with radii A and B; its inner radius is expanded to a. Without change of volume
/// r^3 = R^3 + a^3 - A^3, and the pressure inside is (Green and Zerna, Theoretical Elasticity,
/// 1954)
///   p = mu [2/x + 1/(2 x^4)] from x = a/A to b/B   (neo-Hookean).
/// The mesh is the part over a quarter of one side of the surrounding cube: between the planes x =
/// 0, y = 0, x = z and y = z, which all contain the centre.
constexpr double kInner = 0.01, kOuter = 0.02;

test::BoxMesh sphere_mesh(int cells) {
  test::BoxMesh box = test::box_mesh({cells, cells, cells}, Vec3::Ones(), 0.1);
  for (Eigen::Index n = 0; n < box.nodes.rows(); ++n) {
    const Vec3 p = box.nodes.row(n).transpose();
    const double u = std::tan(M_PI / 4 * p.x()), v = std::tan(M_PI / 4 * p.y());
    const double r = kInner * std::pow(kOuter / kInner, p.z());
    box.nodes.row(n) = r * Vec3(u, v, 1).normalized().transpose();
  }
  return box;
}

double sphere_error(int cells, double& pressure_error) {
  const test::BoxMesh sphere = sphere_mesh(cells);
  const double shear = 2e4, nu = 0.4999, young = 2 * shear * (1 + nu);
  const double a = 1.5 * kInner;
  const Points& nodes = sphere.nodes;
  const auto moved = [&](double radius) {
    return std::cbrt(std::pow(radius, 3) + std::pow(a, 3) - std::pow(kInner, 3)) / radius;
  };
  // The exact motion is prescribed on the inner surface and the oblique planes. The nodes slide in
  // the planes x = 0 and y = 0; the outer surface is free.
  std::vector<int> prescribed;
  VectorXd exact_d(nodes.size());
  for (int n = 0; n < nodes.rows(); ++n) {
    const Vec3 p = nodes.row(n).transpose();
    exact_d.segment<3>(3 * n) = (moved(p.norm()) - 1) * p;
    const bool all = p.x() > p.z() - 1e-9 || p.y() > p.z() - 1e-9 || p.norm() < kInner * (1 + 1e-9);
    for (int axis = 0; axis < 3; ++axis)
      if (all || (axis < 2 && p[axis] < 1e-9)) prescribed.push_back(3 * n + axis);
  }
  const Material material = test::uniform_material(sphere.tets.rows(), young, nu, 0, 1000);
  const Assembler assembler(nodes, sphere.tets, ElementKind::tet4_star);
  FiniteStrain form(assembler, material, {});
  FiniteNewtonOptions options;
  options.tolerance = 1e-6;
  FiniteNewton newton(form, prescribed, options);
  newton.equilibrium(exact_d(prescribed));

  // The pressure by virtual work: the work of all reactions in the radial motion 1/r^2, which
  // preserves volume, is the pressure times the solid angle.
  double work = 0;
  for (int n = 0; n < nodes.rows(); ++n) {
    const Vec3 p = nodes.row(n).transpose();
    const double r = moved(p.norm()) * p.norm();
    work += newton.reaction().segment<3>(3 * n).dot(p.normalized()) / (r * r);
  }
  const double solid = 4 * M_PI / 24;
  const auto bracket = [](double x) { return 2 / x + 1 / (2 * std::pow(x, 4)); };
  const double expected = shear * (bracket(moved(kOuter)) - bracket(moved(kInner))) * solid;
  pressure_error = std::abs(work / expected - 1);
  return (newton.displacement() - exact_d).norm() / exact_d.norm();
}

TEST(FiniteStrainSphere, InflatedToHalfAsMuchAgainConvergesToTheClosedForm) {
  std::vector<double> error, pressure;
  for (const int cells : {3, 6, 12}) {
    pressure.push_back(0);
    error.push_back(sphere_error(cells, pressure.back()));
    std::printf("%2d cells: displacement %.2e, pressure %.2e\n", cells, error.back(),
                pressure.back());
  }
  EXPECT_LT(error[2], 2e-3);
  EXPECT_LT(pressure[2], 0.02);
  EXPECT_GT(std::log2(error[1] / error[2]), 1.5);
  EXPECT_GT(std::log2(pressure[1] / pressure[2]), 1.5);
}

}  // namespace
}  // namespace hyperex::fem
