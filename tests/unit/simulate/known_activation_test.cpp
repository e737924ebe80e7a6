// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/load/known_activation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace hyperex::simulate {
namespace {

TEST(KnownActivation, DiffersFromZeroWhereItsIntervalLeavesZeroOut) {
  EXPECT_TRUE(differs_from_zero(0.5, 0.25));
  EXPECT_FALSE(differs_from_zero(0.5, 0.26));
  EXPECT_TRUE(differs_from_zero(-0.5, 0.25)) << "below rest";
  EXPECT_FALSE(differs_from_zero(0, 0)) << "a palsy";
  EXPECT_FALSE(differs_from_zero(std::nan(""), 0.1));
  EXPECT_FALSE(differs_from_zero(0.5, std::nan("")));
}

TEST(KnownActivation, TheRecordingsShareIsWhatThePriorsVarianceLoses) {
  EXPECT_DOUBLE_EQ(determined_share(0.1, 0.2), 0.75);
  EXPECT_EQ(determined_share(0.2, 0.2), 0);
  EXPECT_TRUE(std::isnan(determined_share(0, 0)));
}

TEST(KnownActivation, IsMostlyThePriorsChoiceBelowAThird) {
  MuscleCourse course;
  course.sigma = Eigen::MatrixXd{{0.16, 0.17}, {0, 0.2}};
  course.prior_sigma = Eigen::MatrixXd{{0.2, 0.2}, {0, 0.2}};
  EXPECT_EQ(muscle_words(course, 0, 0), "") << "1 - 0.8^2 is 0.36";
  EXPECT_EQ(muscle_words(course, 0, 1), "mostly the prior's choice") << "1 - 0.85^2 is 0.28";
  EXPECT_EQ(muscle_words(course, 1, 0), "") << "a palsy";
  EXPECT_EQ(muscle_words(course, 1, 1), "mostly the prior's choice") << "no point sees it";
  EXPECT_EQ(muscle_words(course, -1, 0), "") << "no such muscle";
  EXPECT_EQ(group_words(course, 0, 0), "") << "no groups";
  std::swap(course.sigma, course.group_sigma);
  std::swap(course.prior_sigma, course.group_prior_sigma);
  EXPECT_EQ(group_words(course, 0, 1), "mostly the prior's choice");
  EXPECT_EQ(muscle_words(course, 0, 1), "");
  course.group_prior_sigma.resize(0, 0);
  EXPECT_EQ(group_words(course, 0, 1), "") << "not known";
}

}  // namespace
}  // namespace hyperex::simulate
