// SPDX-License-Identifier: GPL-3.0-or-later
// A block held at a stretch, compared with the measured relaxation of living skin. Its viscoelastic
// branches are those that bench/skin_relaxation.py finds (docs/mechanics.md). Skipped where the
// data are missing.
#include <gtest/gtest.h>

#include <filesystem>

#include "hyperex/fem/time/finite_newton.hpp"
#include "hyperex/io/csv.hpp"
#include "support/fem_support.hpp"

namespace hyperex::fem {
namespace {

constexpr double kArea_m2 = 1e-4;

/// The first ramp and hold.
struct Traction {
  std::vector<double> time_s, stretch, force_n;  ///< force minus the force at rest
  std::size_t held = 0;                          ///< the first sample of the hold
};

Traction read_traction(const std::filesystem::path& file) {
  constexpr double kLength_mm = 30, kHeld_mm = 9.4;
  const io::CsvTable table = io::read_csv(file);
  const int time = table.column("time_s"), moved = table.column("displacement_mm"),
            force = table.column("force_N");
  Traction t;
  double rest_n = 0;
  Eigen::Index row = 0;
  for (; row + 1 < table.values.rows() && table.values(row + 1, moved) <= 0; ++row)
    rest_n += table.values(row, force);
  rest_n /= static_cast<double>(row);
  for (; row < table.values.rows() && (t.held == 0 || table.values(row, moved) > kHeld_mm); ++row) {
    if (t.held == 0 && table.values(row, moved) > kHeld_mm) t.held = t.time_s.size();
    t.time_s.push_back(table.values(row, time));
    t.stretch.push_back(1 + table.values(row, moved) / kLength_mm);
    t.force_n.push_back(table.values(row, force) - rest_n);
  }
  return t;
}

/// The force at the end of a block that follows the stretches, at each of them.
std::vector<double> pulled(const Traction& t, double stiffness_n,
                           const std::vector<MaxwellBranch>& branches) {
  const double poisson = 0.4999, length = 0.03, width = std::sqrt(kArea_m2);
  const auto box = test::box_mesh({2, 2, 2}, Vec3(length, width, width), 0.1);
  const Material material = test::uniform_material(
      box.tets.rows(), 2 * (1 + poisson) * stiffness_n / kArea_m2, poisson, 0, 1000);
  Hyperelastic law;
  law.law = HyperelasticLaw::yeoh;
  law.branches = branches;
  const Assembler assembler(box.nodes, box.tets, ElementKind::tet4_star);
  FiniteStrain form(assembler, material, law);
  std::vector<int> prescribed, end;  // planes of symmetry and the end
  for (int n = 0; n < box.nodes.rows(); ++n)
    for (int axis = 0; axis < 3; ++axis) {
      const bool moves = axis == 0 && box.nodes(n, 0) > length - 1e-9;
      if (moves || box.nodes(n, axis) < 1e-9) prescribed.push_back(3 * n + axis);
      if (moves) end.push_back(3 * n);
    }
  FiniteNewtonOptions options;
  options.inertia = false;
  options.tolerance = 1e-6;
  FiniteNewton newton(form, prescribed, options);
  newton.start();
  std::vector<double> force{0};
  for (std::size_t k = 1; k < t.time_s.size(); ++k) {
    Eigen::VectorXd to = Eigen::VectorXd::Zero(box.nodes.size());
    for (const int unknown : end) to[unknown] = (t.stretch[k] - 1) * length;
    newton.step(t.time_s[k] - t.time_s[k - 1], to(prescribed));
    force.push_back(newton.reaction()(end).sum());
  }
  return force;
}

double rms_in_hold(const Traction& t, const std::vector<double>& force) {
  double sum = 0;
  for (std::size_t k = t.held; k < force.size(); ++k) sum += std::pow(force[k] - t.force_n[k], 2);
  return std::sqrt(sum / static_cast<double>(force.size() - t.held));
}

TEST(SkinRelaxation, MaxwellBranchesFollowTheForceOfSkinHeldAtAStretch) {
  const std::filesystem::path file =
      std::filesystem::path(HYPEREX_SHARED_DIR) / "data/real/skin_relaxation.csv";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no ../shared/data";
  const Traction t = read_traction(file);
  ASSERT_GT(t.force_n.size() - t.held, 590U);
  const auto two = pulled(t, 0.2525, {{3.4375, 1.217}, {0.6415, 60.1}});
  const auto one = pulled(t, 0.2899, {{0.5369, 31.375}});
  const auto none = pulled(t, 0.36, {});
  const double with_two = rms_in_hold(t, two), with_one = rms_in_hold(t, one),
               with_none = rms_in_hold(t, none);
  std::printf("rms in the hold: two branches %.1f mN, one %.1f mN, none %.1f mN\n", 1e3 * with_two,
              1e3 * with_one, 1e3 * with_none);
  EXPECT_LT(with_two, 0.014);  // as for the fit; noise alone gives 0.0104
  EXPECT_LT(with_one, 0.0175);
  EXPECT_GT(with_one, 1.2 * with_two);
  EXPECT_GT(with_none, 2 * with_two);
  const auto fallen = [&](const std::vector<double>& force) {
    const auto at = [&](double time_s) {  // mean of two seconds
      double sum = 0;
      int count = 0;
      for (std::size_t k = 0; k < force.size(); ++k)
        if (std::abs(t.time_s[k] - time_s) < 1.05) sum += force[k], ++count;
      return sum / count;
    };
    return at(30) - at(75);
  };
  std::printf("from 30 s to 75 s: measured %.4f N less, two branches %.4f N\n", fallen(t.force_n),
              fallen(two));
  EXPECT_NEAR(fallen(two), fallen(t.force_n), 0.015);
}

}  // namespace
}  // namespace hyperex::fem
