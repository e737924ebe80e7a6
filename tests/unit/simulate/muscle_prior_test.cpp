// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/load/muscle_prior.hpp"

#include <gmock/gmock.h>

#include <Eigen/Eigenvalues>

#include "hyperex/core/error.hpp"
#include "support/refusal.hpp"

namespace hyperex::simulate {
namespace {

/// Three muscles on each side; `lifter` is correlated with the other two.
MuscleOptions options_with(double lifter_raiser, double lifter_puller = 0) {
  MuscleOptions options;
  for (const char* name : {"lifter", "raiser", "puller"}) {
    muscles::TemplateMuscle muscle;
    muscle.name = name;
    options.own.push_back(muscle);
  }
  options.own[0].together = {{"raiser", lifter_raiser}, {"puller", lifter_puller}};
  options.own[1].readiness = 0.5;
  options.own[2].yields = 6;
  options.side_correlation = 0.3;
  return options;
}

std::vector<muscles::MuscleLine> lines_of_three() {
  std::vector<muscles::MuscleLine> lines;
  for (int row = 0; row < 3; ++row)
    for (const bool left : {true, false}) {
      muscles::MuscleLine line;
      line.row = row;
      line.left = left;
      lines.push_back(line);
    }
  return lines;
}

TEST(MusclePrior, CorrelatesWhatIsNamedTogetherOnBothSidesAndLessAcross) {
  const FitPriors prior = muscle_prior(lines_of_three(), options_with(0.5, -0.2));
  Eigen::Matrix3d side;
  side << 1, 0.5, -0.2, 0.5, 1, 0, -0.2, 0, 1;
  ASSERT_EQ(prior.correlation.rows(), 6);
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b)
      EXPECT_DOUBLE_EQ(prior.correlation(a, b), side(a / 2, b / 2) * (a % 2 == b % 2 ? 1 : 0.3));
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(prior.correlation).eigenvalues()[0], 0);
  EXPECT_EQ(prior.readiness, Eigen::VectorXd(Eigen::VectorXd::Map(
                                 std::vector<double>{1, 1, 0.5, 0.5, 1, 1}.data(), 6)));
  EXPECT_EQ(prior.yields.tail<2>(), Eigen::Vector2d(6, 6));
  EXPECT_EQ(prior.yields.head<4>(), Eigen::Vector4d::Zero());
}

TEST(MusclePrior, RefusesCorrelationsThatCannotHoldTogether) {
  MuscleOptions options = options_with(0.9, 0.9);
  options.own[1].together = {{"puller", -0.9}};
  EXPECT_THAT(hyperex::test::refusal([&] { muscle_prior(lines_of_three(), options); }),
              testing::HasSubstr("can hold at the same time"));
}

TEST(MusclePrior, OfTheProgramsOwnMusclesHolds) {
  std::vector<muscles::MuscleLine> lines;
  const int rows = int(muscles::muscle_template().size());
  for (int row = 0; row < rows; ++row)
    for (const bool left : {true, false}) {
      muscles::MuscleLine line;
      line.row = row;
      line.left = left;
      lines.push_back(line);
    }
  EXPECT_NO_THROW(muscle_prior(lines, {}));
  for (const muscles::TemplateMuscle& muscle : muscles::muscle_template())
    for (const auto& [other, value] : muscle.together)
      EXPECT_TRUE(muscles::find_muscle(other)) << muscle.name << ": " << other;
}

}  // namespace
}  // namespace hyperex::simulate
