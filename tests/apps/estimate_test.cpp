// SPDX-License-Identifier: GPL-3.0-or-later
// `hyperex estimate` as a user calls it.
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/malformed.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/motion/embedded_motion.hpp"
#include "hyperex/motion/read_motion.hpp"

namespace hyperex {
namespace {
using testing::HasSubstr;

class EstimateProgram : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    put(in("s.toml"),
        "scan = { file = \"embedded\" }\nmotion = { file = \"embedded\" }\n"
        "mesh = { element_size_mm = 9 }\n"
        "drive.points = [\"ibug68_48\", \"ibug68_54\", \"ibug68_51\", \"ibug68_57\", "
        "\"ibug68_8\"]\n");
  }
};

TEST_F(EstimateProgram, AnswersOrSaysWhatWouldHelp) {
  motion::write_motion_csv(in("again.csv"), motion::embedded_mouth_opening(good_landmarks()));
  const Outcome outcome = call(
      "estimate s.toml --recording again.csv --stiffness cheek_L:cheek_R --gain zygomatic_R "
      "--out o.json");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("cheek_L / cheek_R: "));
  // An opening mouth does not use the zygomatic branch.
  EXPECT_THAT(outcome.out, HasSubstr("zygomatic_R: these recordings cannot tell"));
  EXPECT_THAT(outcome.out, HasSubstr("A recording of \""));
  EXPECT_THAT(outcome.out, HasSubstr("no medical device"));
  EXPECT_THAT(outcome.err, HasSubstr("shows no jitter"));
  const auto json = nlohmann::json::parse(read_file(in("o.json")));
  ASSERT_EQ(json["findings"].size(), 2u);
  const auto& ratio = json["findings"][0];
  EXPECT_LE(ratio["interval_95"][0], ratio["value"]);
  EXPECT_GE(ratio["interval_95"][1], ratio["value"]);
  EXPECT_LT(ratio["interval_95"][0], 1) << "both sides moved alike";
  EXPECT_GT(ratio["interval_95"][1], 1);
  EXPECT_EQ(json["recordings"].size(), 2u);
  EXPECT_EQ(json["points"].size(), 5u);
}

TEST_F(EstimateProgram, FindsTheStiffnessOfTheTissueUnderAKnownLoad) {
  // Lying face up: mouth and chin sink by 1.5 mm, and the head has turned.
  const io::Landmarks upright = good_landmarks();
  const Eigen::AngleAxisd turn(-1.2, Vec3::UnitX());
  motion::Motion lying;
  lying.time_s = {0, 1};
  lying.positions.assign(2, Points(Eigen::Index(upright.size()), 3));
  for (const auto& [name, place] : upright) {
    const auto row = Eigen::Index(lying.names.size());
    const auto number = face::ibug_number(name);
    const bool sinks = number && (*number >= 48 || *number <= 16);
    lying.names.push_back(name);
    lying.positions[0].row(row) = place.transpose();
    lying.positions[1].row(row) = (turn * (place - Vec3(0, 0, sinks ? 0.0015 : 0))).transpose();
  }
  motion::write_motion_csv(in("lying.csv"), lying);
  Outcome outcome = call("estimate s.toml --lying lying.csv --out o.json");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("soft tissue: "));
  EXPECT_THAT(outcome.out, HasSubstr(" kPa"));
  const auto json = nlohmann::json::parse(read_file(in("o.json")));
  const auto& young = json["findings"][0];
  EXPECT_EQ(young["kind"], "young_kpa");
  EXPECT_LT(young["value"], json["scenes_young_kpa"]) << "softer than the scene has it";
  EXPECT_EQ(json["recordings"][1]["name"], "lying.csv");

  motion::write_motion_csv(in("again.csv"), motion::embedded_mouth_opening(good_landmarks()));
  outcome = call("estimate s.toml --weight again.csv:cheilion_R:20");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("soft tissue: "));
}

TEST_F(EstimateProgram, RefusesWhatCannotBeAsked) {
  const auto refused = [this](const std::string& arguments, const std::string& why) {
    const Outcome outcome = call("estimate s.toml " + arguments + " --out o.json");
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr(why));
    EXPECT_FALSE(std::filesystem::exists(in("o.json")));
  };
  refused("", "cheek_L:cheek_R");
  refused("--stiffness all", "Motion alone does not determine");
  refused("--stiffness all", "A known load");
  refused("--weight again.csv", "FILE:POINT:GRAMS");
  refused("--weight again.csv:cheilion_R:much", "FILE:POINT:GRAMS");
  motion::write_motion_csv(in("again.csv"), motion::embedded_mouth_opening(good_landmarks()));
  refused("--weight again.csv:cheilion_R:9000", "at most 500");
  refused("--weight again.csv:nowhere:20", "a landmark of the scan");
  refused("--lying none.csv", "none.csv");
  refused("--lying again.csv --recording again.csv", "is given twice");
  refused("--weight :cheilion_R:20", "FILE:POINT:GRAMS");
  refused("--stiffness chek_L", "did you mean cheek_L?");
  refused("--stiffness cheek_L:cheek_L", "two different parts");
  refused("--stiffness tissue.region[0]", "which has 0");
  refused("--gain zygomaticus", "did you mean zyg_major_R");
  refused("--gain zygomatic_R --recording none.csv", "none.csv");
  put(in("o.json"), "mine");
  EXPECT_EQ(call("estimate s.toml --gain zygomatic_R --out o.json").status, 2);
  EXPECT_EQ(read_file(in("o.json")), "mine");
}

}  // namespace
}  // namespace hyperex
