// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/activations.hpp"

#include <gtest/gtest.h>

namespace hyperex::run {
namespace {
using Json = nlohmann::ordered_json;

/// Two samples; the muscles are most active in the second.
simulate::MuscleCourse told_course() {
  simulate::MuscleCourse course;
  course.names = {"zyg_major_L", "zyg_major_R", "corrugator_L", "corrugator_R"};
  course.time_s = {0, 0.5};
  course.activation = Eigen::MatrixXd{{0.1, 0.6}, {0.1, 0.3}, {0, 0.02}, {0, 0.01}};
  course.sigma = Eigen::MatrixXd{{0.2, 0.2}, {0.2, 0.2}, {0.28, 0.28}, {0.1, 0.1}};
  course.prior_sigma = Eigen::MatrixXd::Constant(4, 2, 0.3);
  course.jaw_opening_deg = Eigen::Vector2d(0, 4);
  course.groups = {"elevators_L", "elevators_R"};
  course.group_activation = course.activation.topRows(2);
  course.group_sigma = Eigen::MatrixXd{{0.3, 0.1}, {0.1, 0.3}};
  course.group_prior_sigma = Eigen::MatrixXd::Constant(2, 2, 0.32);
  return course;
}

TEST(Activations, AreToldAtTheSampleOfMostActivationWithWhatThePriorDecides) {
  const Json json = activations_json(told_course());
  EXPECT_EQ(json["time_s"], 0.5);
  EXPECT_EQ(json["jaw_opening_deg"], 4);
  const Json& group = json["groups"]["elevators"];
  EXPECT_EQ(group["activation"]["L"], 0.6);
  EXPECT_EQ(group["sigma"]["R"], 0.3);
  EXPECT_NEAR(group["determined"]["L"].get<double>(), 1 - 100. / 1024, 1e-12);
  EXPECT_EQ(group["note"], Json({{"R", "mostly the prior's choice"}})) << "1 - (0.3 / 0.32)^2";
  EXPECT_EQ(json["count"], 4);
  EXPECT_EQ(json["differ_from_zero"], Json::array({"zyg_major_L"})) << "three sigmas";
  EXPECT_EQ(json["mostly_prior"], Json::array({"corrugator_L"})) << "1 - (0.28 / 0.3)^2";
}

/// As the fit judged the points, whatever their number.
TEST(Activations, AreReadAsTheFitTookItsPoints) {
  simulate::MuscleCourse course = told_course();
  course.few_points = true;
  EXPECT_TRUE(activations_json(course)["reading"].get<std::string>().starts_with("so few points"));
  course.few_points = false;
  EXPECT_TRUE(activations_json(course)["reading"].get<std::string>().starts_with("sums over"));
}

TEST(Activations, ALineCountsThem) {
  EXPECT_EQ(activations_line({{"muscles", activations_json(told_course())}}),
            "activations of the 4 muscles at 0.50 s: different from 0 (95 %) 1, mostly the prior's "
            "choice 1\n");
  simulate::MuscleCourse changed = told_course();
  changed.groups.clear();
  EXPECT_EQ(activations_line({{"muscles", activations_json(changed)}}), "");
  EXPECT_EQ(activations_line(Json::object()), "");
}

}  // namespace
}  // namespace hyperex::run
