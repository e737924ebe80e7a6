// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/drive_choice.hpp"

#include <gmock/gmock.h>

#include <filesystem>

#include "hyperex/session/face_session.hpp"

namespace hyperex::session {
using namespace scene;
namespace {
using simulate::DriveBy;
using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

Scene example(const std::string& name, const std::vector<std::string>& changes = {}) {
  const bool shared = name.starts_with("subject_a");
  return read_scene(
      HYPEREX_SOURCE_DIR + std::string(shared ? "/bench/scenes/" : "/examples/") + name, changes);
}
DriveChoice choice(const std::string& name, const std::vector<std::string>& changes = {}) {
  const Scene scene = example(name, changes);
  return drive_choice(scene, read_inputs(scene));
}

TEST(DriveChoice, GoesByTheMotionWhereNothingIsSaid) {
  const DriveChoice jaw = choice("mouth_open.toml");
  EXPECT_EQ(jaw.by, DriveBy::displacement);
  EXPECT_THAT(jaw.why, StartsWith("driven by displacement: the mouth opens by "));
  EXPECT_THAT(jaw.why, HasSubstr("as by the jaw alone"));
  const DriveChoice smile = choice("one_sided_smile.toml");
  EXPECT_EQ(smile.by, DriveBy::muscles);
  EXPECT_THAT(smile.why,
              StartsWith("driven by muscles: the mouth opens by 9 mm, not more than 18"));
  EXPECT_EQ(choice("mouth_open.toml", {"motion.gain=0.2"}).by, DriveBy::muscles) << "not wide";
}

TEST(DriveChoice, TakesWhatTheSceneSays) {
  for (const char* by : {"displacement", "muscles", "reactions"}) {
    const DriveChoice said = choice("one_sided_smile.toml", {std::string("drive.by=") + by});
    EXPECT_EQ(said.why, std::string("driven by ") + by + ": the scene says so");
  }
  const DriveChoice support = choice("one_sided_smile.toml", {"support.field_kpa_per_mm=5"});
  EXPECT_EQ(support.by, DriveBy::displacement);
  EXPECT_THAT(support.why, HasSubstr("support.field_kpa_per_mm is given"));
  EXPECT_EQ(choice("one_sided_smile.toml", {"support.jaw_points=[\"ibug68_8\"]"}).by,
            DriveBy::muscles);
  EXPECT_EQ(choice("variants.toml").by, DriveBy::displacement);
  EXPECT_THAT(choice("demo.toml").why, StartsWith("driven by muscles"));
}

TEST(DriveChoice, HoldsForTheSceneAndIsNoted) {
  const Scene scene = example("one_sided_smile.toml");
  EXPECT_EQ(scene.drive.by, DriveBy::displacement);
  const FaceSession session(scene, {.certainty = Certainty::on_request});
  EXPECT_EQ(session.scene().drive.by, DriveBy::muscles);
  const std::string why = drive_choice(scene, session.inputs()).why;
  EXPECT_EQ(session.drive_reason(), why);
  EXPECT_THAT(session.notes(), Contains(make_note("drive.chosen", why, "drive.by")));
}

/// Of real and of rendered recordings: talking opens the mouth as wide as the jaw alone does.
TEST(DriveChoice, TellsTheJawAloneFromOtherMotions) {
  const std::filesystem::path data = std::filesystem::path(HYPEREX_SHARED_DIR) / "data";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "the shared recordings are not here";
  for (const char* scene : {"subject_a_mouth_open.toml", "subject_a_mouth_open_all.toml"})
    EXPECT_EQ(choice(scene).by, DriveBy::displacement) << scene << ": " << choice(scene).why;
  for (const char* scene : {"subject_a_talk.toml", "subject_a_talk_all.toml"})
    EXPECT_EQ(choice(scene).by, DriveBy::muscles) << scene << ": " << choice(scene).why;
  for (const char* file : {"real/spacetime/smile_7.toml", "real/spacetime/smile_all.toml",
                           "real/animface/cheeks_7.toml"}) {
    const Scene scene = read_scene(data / file);
    const DriveChoice found = drive_choice(scene, read_inputs(scene));
    EXPECT_EQ(found.by, DriveBy::muscles) << file << ": " << found.why;
  }
}

}  // namespace
}  // namespace hyperex::session
