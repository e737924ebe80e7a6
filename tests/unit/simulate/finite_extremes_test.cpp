// SPDX-License-Identifier: GPL-3.0-or-later
// Motions that are impossible for a face: finite strain gives finite numbers, or an error of one
// line that says where.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hyperex/core/error.hpp"
#include "hyperex/simulate/run/simulator.hpp"
#include "simulate/small_face.hpp"

namespace hyperex::simulate {
namespace {

class FiniteExtremes : public testing::Test {
 protected:
  FiniteExtremes() {
    options_.time.step_s = 0.01;
    options_.model.strain = Strain::finite;
    options_.drive.points = test::seven_points();
  }
  void expect_an_end(const AlignedMotion& motion, const char* what) {
    try {
      const SimulationResult result = Simulator(mesh_, face_.landmarks, motion, options_).run();
      for (const PointsF& skin : result.performance.skin_displacement_m)
        EXPECT_TRUE(skin.allFinite()) << what;
      EXPECT_LE(result.report.estimated_error, options_.solver.finite_tolerance) << what;
      std::printf("%s: to the end, %d iterations, %d inverted\n", what, result.report.iterations,
                  result.report.inverted_tets);
    } catch (const NumericalError& error) {
      const std::string line = error.what();
      EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 0) << what;
      EXPECT_NE(line.find("t = "), std::string::npos) << line;
      std::printf("%s: %s\n", what, error.what());
    }
  }
  AlignedMotion opening(double peak_deg) const {
    return test::mouth_opening(face_.landmarks, peak_deg, 9, 10);
  }

  const test::SmallFace face_ = test::small_face();
  std::shared_ptr<const tissue::TissueMesh> mesh_ =
      std::make_shared<const tissue::TissueMesh>(face_.mesh);
  SimulationOptions options_;
};

TEST_F(FiniteExtremes, TissueAsSoftAsAllowed) {
  options_.tissue.uniform[tissue::young] = 1;
  expect_an_end(opening(13), "E of 1 Pa");
}

TEST_F(FiniteExtremes, TissueAsStiffAndAsIncompressibleAsAllowed) {
  options_.tissue.uniform[tissue::young] = 1e9;
  options_.tissue.uniform[tissue::poisson] = 0.4999;
  expect_an_end(opening(13), "E of 1 GPa, nu 0.4999");
}

TEST_F(FiniteExtremes, AMouthThatOpensByTenCentimetres) {
  expect_an_end(opening(65), "65 degrees");
}

TEST_F(FiniteExtremes, LipsThatPassThroughEachOther) {
  const AlignedMotion crossing = test::motion_of(
      face_.landmarks, 9, 10, [&](const std::string& name, const Vec3&, int k) -> Vec3 {
        const Vec3 up =
            (face_.landmarks.at("ibug68_27") - face_.landmarks.at("ibug68_8")).normalized();
        const double way_m = 0.008 * std::pow(std::sin(M_PI * k / 8), 2);
        if (name == "ibug68_51") return -way_m * up;
        if (name == "ibug68_57" || name == "ibug68_58" || name == "ibug68_56") return way_m * up;
        return Vec3::Zero();
      });
  expect_an_end(crossing, "lips that cross by 16 mm");
}

TEST_F(FiniteExtremes, StepsOfHalfASecond) {
  options_.solver.finite_step_s = 0.5;
  expect_an_end(opening(40), "steps of 0.5 s");
}

TEST_F(FiniteExtremes, EveryLawWithStrongBranchesAndNoViscosity) {
  options_.tissue.uniform[tissue::viscosity] = 0;
  options_.model.law.branches = {{100, 1e-6}, {100, 1e6}};
  for (const auto law : fem::kHyperelasticLaws) {
    if (law == fem::HyperelasticLaw::linear) continue;
    options_.model.law.law = law;
    expect_an_end(opening(30), std::string(to_string(law)).c_str());
  }
}

}  // namespace
}  // namespace hyperex::simulate
