// SPDX-License-Identifier: GPL-3.0-or-later
// The reduced model compared with the full one, over all steps and nodes: for random driven
// patches, courses and forces, and for difficult cases of inertia and resonance.
#include <gtest/gtest.h>

#include "support/layer.hpp"

namespace hyperex::fem {
namespace {

struct Outcome {
  double error, estimate;
  int basis;
  bool converged;
};

std::vector<Outcome> outcomes(const test::Layer& layer, const Drive& drive, double dt_s,
                              const std::vector<double>& tolerances, const char* what) {
  const Eigen::MatrixXd full = test::full_run(layer.system, layer.prescribed, drive, {dt_s});
  ReducedModel model(layer.system, layer.prescribed);
  std::vector<Outcome> found;
  for (const double tolerance : tolerances) {
    const Response r = model.run(drive, {{dt_s}, tolerance});
    found.push_back({test::true_error(r, full), r.estimated_error, r.basis_size, r.converged});
    std::printf("%s: tolerance %.0e: error %.1e, estimated %.1e, %d vectors, %d passes\n", what,
                tolerance, found.back().error, found.back().estimate, r.basis_size, r.passes);
  }
  return found;
}

/// The error must not exceed the estimate by more than a half, and the model must not report a
/// tolerance as reached that it does not meet.
void expect_honest(const std::vector<Outcome>& found, const std::vector<double>& tolerances) {
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_LE(found[i].error, std::max(1.5 * found[i].estimate, 1e-9));
    if (found[i].converged) {
      EXPECT_LE(found[i].error, tolerances[i]);
      EXPECT_LE(found[i].estimate, tolerances[i]);
    } else {
      EXPECT_GT(found[i].estimate, tolerances[i]);
    }
    if (i > 0 && found[i].converged) {
      EXPECT_GE(found[i].basis, found[i - 1].basis);
    }
  }
}

void expect_kept(const std::vector<Outcome>& found, const std::vector<double>& tolerances) {
  for (const Outcome& o : found) EXPECT_TRUE(o.converged);
  expect_honest(found, tolerances);
}

const std::vector<double> kTolerances = {1e-2, 1e-3, 1e-5};

class RandomDrive : public testing::TestWithParam<unsigned> {};

TEST_P(RandomDrive, IsMetToTheTolerance) {
  const unsigned seed = GetParam();
  test::LayerOptions options;
  options.bonded = seed % 2;
  options.element = seed % 3 ? ElementKind::tet4_star : ElementKind::tet4;
  const double dt_s = 2e-3;
  test::Layer layer(options);
  std::vector<test::SplineCourse> courses;
  for (unsigned k = 0; k < 1 + seed % 4; ++k)
    courses.push_back(test::SplineCourse::random(1.0 / 30, 20, 100 * seed + k));
  const Drive drive =
      layer.drive(1 + static_cast<int>(seed % 5), seed % 3 == 1, courses, dt_s, seed);
  expect_kept(outcomes(layer, drive, dt_s, kTolerances, ("seed " + std::to_string(seed)).c_str()),
              kTolerances);
}
INSTANTIATE_TEST_SUITE_P(Seeds, RandomDrive, testing::Range(1u, 11u));

/// A course A sin(2 pi t / period), with or without a jump of velocity at its start.
Drive sine(test::Layer& layer, double period_s, double dt_s, double end_s, bool from_rest) {
  const test::SplineCourse any = test::SplineCourse::random(end_s, 1, 1);
  Drive drive = layer.drive(3, false, {any}, dt_s, 3);
  const double w = 2 * M_PI / period_s;
  for (int i = 0; i <= drive.steps(); ++i) {
    const double x = w * i * dt_s;
    drive.s(0, i) = from_rest ? 1 - std::cos(x) : std::sin(x);
    drive.rate(0, i) = w * (from_rest ? std::sin(x) : std::cos(x));
    drive.second(0, i) = w * w * (from_rest ? std::cos(x) : -std::sin(x));
  }
  return drive;
}

TEST(ReducedModelHard, SineOfAQuarterSecondWithTenTimesLessViscosity) {
  test::LayerOptions options;
  options.viscosity_pa_s = 47.68;
  test::Layer smooth(options), sudden(options);
  const Drive from_rest = sine(smooth, 0.27, 2e-3, 1.08, true);
  expect_kept(outcomes(smooth, from_rest, 2e-3, kTolerances, "from rest"), kTolerances);
  // A driven velocity that starts suddenly sends a wave through the whole layer, whose front no
  // small basis can represent. Tight tolerances cannot be reached.
  const Drive at_speed = sine(sudden, 0.27, 2e-3, 1.08, false);
  const std::vector<double> loose = {1e-2, 1e-3};
  expect_kept(outcomes(sudden, at_speed, 2e-3, loose, "at speed"), loose);
}

/// Hardly any damping, and driven at a resonance: vibrations do not decay, and the basis must
/// contain all that were excited. The model must not report a tolerance that it cannot reach.
TEST(ReducedModelHard, RingingWithHardlyAnyDamping) {
  for (const double period_s : {0.1, 0.02}) {
    test::LayerOptions options;
    options.cells = {8, 7, 2};
    options.viscosity_pa_s = 0.5;
    test::Layer layer(options);
    const Drive drive = sine(layer, period_s, 5e-4, 0.4, true);
    const auto found =
        outcomes(layer, drive, 5e-4, kTolerances, ("period " + std::to_string(period_s)).c_str());
    expect_honest(found, kTolerances);
    EXPECT_TRUE(found[0].converged);
  }
}

}  // namespace
}  // namespace hyperex::fem
