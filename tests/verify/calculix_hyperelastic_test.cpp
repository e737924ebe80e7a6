// SPDX-License-Identifier: GPL-3.0-or-later
// Equilibria at finite strain against CalculiX: the same linear tetrahedra, the same energy.
#include <gtest/gtest.h>

#include "hyperex/fem/time/finite_newton.hpp"
#include "support/calculix.hpp"
#include "support/fem_support.hpp"

namespace hyperex::fem {
namespace {

constexpr double kAgreement = 1e-6;  // of the greatest displacement; ccx prints seven digits
constexpr double kShear = 2e4, kPoisson = 0.45;

struct Pulled {
  test::BoxMesh box = test::box_mesh({4, 3, 3}, Vec3(0.04, 0.03, 0.03), 0.15);
  test::CalculixModel model;
  Material material;
  std::vector<int> prescribed;

  Pulled() {
    model.nodes = box.nodes;
    model.tets = box.tets;
    const double young = 2 * kShear * (1 + kPoisson);
    material = test::uniform_material(box.tets.rows(), young, kPoisson, 0, 1000);
    model.hyperelastic = {kShear / 2, 0, 0, bulk_modulus_pa(young, kPoisson)};
    model.dt_s = 0.25;
    // One end is held, the other stretched by half, sheared, and turned by 0.4 rad.
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.4, Vec3::UnitX()).toRotationMatrix();
    const Vec3 centre(0.04, 0.015, 0.015);
    std::vector<double> way;
    for (int n = 0; n < box.nodes.rows(); ++n) {
      const Vec3 p = box.nodes.row(n).transpose();
      if (p.x() < 1e-9) model.held_nodes.push_back(n);
      if (p.x() < 0.04 - 1e-9) continue;
      const Vec3 to = centre + turn * (p - centre) + Vec3(0.02, 0.01, 0) - p;
      for (int axis = 0; axis < 3; ++axis) {
        model.driven.push_back(3 * n + axis);
        way.push_back(to[axis]);
      }
    }
    const auto count = static_cast<Eigen::Index>(way.size());
    model.motion_m.resize(4, count);
    for (int i = 0; i < 4; ++i)
      model.motion_m.row(i) =
          (i + 1) / 4.0 * Eigen::Map<const Eigen::RowVectorXd>(way.data(), count);
    prescribed = model.driven;
    for (const int n : model.held_nodes)
      for (int axis = 0; axis < 3; ++axis) prescribed.push_back(3 * n + axis);
    std::sort(prescribed.begin(), prescribed.end());
  }

  test::History own(const Hyperelastic& law) const {
    const Assembler assembler(box.nodes, box.tets, ElementKind::tet4);
    FiniteStrain form(assembler, material, law);
    FiniteNewtonOptions options;
    options.tolerance = 1e-10;
    FiniteNewton newton(form, prescribed, options);
    test::History history;
    for (Eigen::Index i = 0; i < model.motion_m.rows(); ++i) {
      Eigen::VectorXd d = Eigen::VectorXd::Zero(box.nodes.size());
      d(model.driven) = model.motion_m.row(i).transpose();
      newton.equilibrium(d(prescribed));
      history.push_back(newton.displacement());
    }
    return history;
  }

  double apart(const Hyperelastic& law, const test::History& ccx, const char* what) const {
    const double d = test::difference(own(law), ccx);
    std::printf("  %-44s %.2e\n", what, d);
    return d;
  }
};

class CalculiXHyperelastic : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!test::find_calculix())
      GTEST_SKIP() << "ccx is not on the PATH (Debian: apt-get install calculix-ccx)";
  }
};

TEST_F(CalculiXHyperelastic, NeoHookean) {
  const Pulled pulled;
  Hyperelastic law;
  law.law = HyperelasticLaw::isochoric_neo_hookean;
  law.barrier = false;
  const auto ccx = test::run_calculix(pulled.model).displacement_m;
  EXPECT_LT(pulled.apart(law, ccx, "neo-Hookean"), kAgreement);
  // The check is worth something if it fails where a law is a little off.
  law.barrier = true;
  EXPECT_GT(pulled.apart(law, ccx, "with the barrier"), 10 * kAgreement);
  law.barrier = false;
  law.law = HyperelasticLaw::mooney_rivlin;
  law.c01 = 0.01;
  EXPECT_GT(pulled.apart(law, ccx, "a hundredth of I2bar"), 10 * kAgreement);
  law.law = HyperelasticLaw::neo_hookean;
  EXPECT_GT(pulled.apart(law, ccx, "I1 in place of I1bar"), 10 * kAgreement);
}

TEST_F(CalculiXHyperelastic, Yeoh) {
  Pulled pulled;
  Hyperelastic law;
  law.law = HyperelasticLaw::yeoh;
  law.c30 = 0.2;
  law.barrier = false;
  pulled.model.hyperelastic->c20_pa = law.c20 * kShear / 2;
  pulled.model.hyperelastic->c30_pa = law.c30 * kShear / 2;
  const auto ccx = test::run_calculix(pulled.model).displacement_m;
  EXPECT_LT(pulled.apart(law, ccx, "Yeoh"), kAgreement);
  law.c30 *= 1.01;
  EXPECT_GT(pulled.apart(law, ccx, "c30 by 1 %"), 10 * kAgreement);
}

}  // namespace
}  // namespace hyperex::fem
