// SPDX-License-Identifier: GPL-3.0-or-later
// The energy balance of driven viscoelastic tissue on springs: a conformance test of the integrator
// with every element kind and viscous form.
#include "support/energy_balance.hpp"

#include <gtest/gtest.h>

#include "support/conformance.hpp"
#include "support/spline_course.hpp"

namespace hyperex::fem {
namespace {

class DrivenEnergy : public test::Conformance {
 protected:
  const test::BoxMesh box_ = test::box_mesh({4, 3, 2}, Vec3(0.04, 0.03, 0.02), 0.15);
  const Material material_ = varied(box_);
  /// One end is driven, the other is on springs; nothing is held.
  const std::vector<int> driven_ =
      test::unknowns_where(box_.nodes, [](const Vec3& p) { return p.x() < 1e-9; });
  const std::vector<int> sprung_ =
      test::unknowns_where(box_.nodes, [](const Vec3& p) { return p.x() > 0.04 - 1e-9; });
  static constexpr double kSpring = 40;  // N/m
  const System system_ = with_springs();
  static constexpr double kEnd = 12.0 / 30;

  System with_springs() const {
    System s = assembled(box_, material_);
    for (const int u : sprung_) s.stiffness.coeffRef(u, u) += kSpring;
    return s;
  }
  test::EnergyBalance balance() const {
    return {system_, driven_,
            [this](const Eigen::VectorXd& d) {
              return strain_energy(box_, material_, test::unflat(d)) +
                     kSpring / 2 * d(sprung_).squaredNorm();
            },
            [this](const Eigen::VectorXd& v) {
              return test::kinetic_energy(box_, material_, test::unflat(v));
            },
            [this](const Eigen::VectorXd& v) {
              return 2 * dissipation(box_, material_, test::unflat(v));
            }};
  }
  Drive drive(double dt_s) const {
    Drive drive;
    drive.prescribed.resize(static_cast<Eigen::Index>(driven_.size()), 2);
    drive.force.resize(system_.mass.cols(), 2);
    for (int r = 0; r < 2; ++r) {
      const Vec3 way = 3e-3 * test::random_vector(3, 1 + r);
      const Vec3 pull = 5e-2 * test::random_vector(3, 3 + r);
      drive.prescribed.col(r) = 5e-5 * test::random_vector(drive.prescribed.rows(), 5 + r) +
                                way.replicate(drive.prescribed.rows() / 3, 1);
      drive.force.col(r) = 1e-3 * test::random_vector(drive.force.rows(), 7 + r) +
                           pull.replicate(drive.force.rows() / 3, 1);
    }
    test::set_courses(
        {test::SplineCourse::random(1.0 / 30, 12, 5), test::SplineCourse::random(1.0 / 30, 12, 6)},
        dt_s, static_cast<int>(std::lround(kEnd / dt_s)), drive);
    return drive;
  }
  /// The balance at the end; `worst`: greatest gap in any step, divided by the greatest work.
  test::EnergyBalance run(double dt_s, bool displacement_alone, double& worst) const {
    const Drive drive = this->drive(dt_s);
    Newmark newmark(system_, driven_, {dt_s});
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(system_.mass.cols());
    newmark.start(zero, zero, drive.prescribed_at(0).a, drive.force_at(0));
    test::EnergyBalance account = balance();
    account.begin(newmark.state(), drive.force_at(0));
    worst = 0;
    for (int i = 1; i <= drive.steps(); ++i) {
      if (displacement_alone)
        newmark.step(drive.prescribed_at(i).d, drive.force_at(i));
      else
        newmark.step(drive.prescribed_at(i), drive.force_at(i));
      account.add(newmark.state(), drive.force_at(i), dt_s);
      worst = std::max(worst, std::abs(account.gap()));
    }
    worst /= account.most_work;
    return account;
  }
};

TEST_P(DrivenEnergy, BalancesToRoundingForAMotionThatNewmarksFormulasMake) {
  for (const double dt_s : {1.0 / 480, 1.0 / 120}) {
    double worst = 0;
    const test::EnergyBalance e = run(dt_s, true, worst);
    EXPECT_LT(worst, 1e-8);
    // Each part must be significant: otherwise the test would not detect that it is missing.
    EXPECT_GT(e.dissipated, 0.1 * e.most_work);
    EXPECT_GT(e.stored, 1e-4 * e.most_work);
    EXPECT_GT(e.kinetic, 1e-4 * e.most_work);
    EXPECT_GT(std::abs(e.force_work), 1e-4 * e.most_work);
    EXPECT_GT(std::abs(e.reaction_work), 0.1 * e.most_work);
  }
}

TEST_P(DrivenEnergy, ClosesWithOrderTwoForAMotionGivenWithItsDerivatives) {
  std::vector<double> gaps;
  for (const int rate : {480, 960, 1920, 3840}) {
    double worst = 0;
    run(1.0 / rate, false, worst);
    gaps.push_back(worst);
  }
  std::printf("energy that does not balance, of the work done: %.1e %.1e %.1e %.1e\n", gaps[0],
              gaps[1], gaps[2], gaps[3]);
  for (std::size_t i = 0; i + 1 < gaps.size(); ++i)
    EXPECT_NEAR(std::log2(gaps[i] / gaps[i + 1]), 2, 0.25) << i;
  EXPECT_LT(gaps[0], 0.02);
  EXPECT_GT(gaps[3], 1e-9) << "or the order is that of rounding";
}

INSTANTIATE_TEST_SUITE_P(Cases, DrivenEnergy, testing::ValuesIn(test::all_cases()),
                         [](const auto& c) { return test::Case::name(c.param); });

}  // namespace
}  // namespace hyperex::fem
