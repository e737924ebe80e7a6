// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/drive_choice.hpp"

#include <gmock/gmock.h>

#include "hyperex/session/face_session.hpp"

namespace hyperex::session {
using namespace scene;
namespace {
using simulate::DriveBy;
using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

Scene example(const std::string& name, const std::vector<std::string>& changes = {}) {
  return read_scene(HYPEREX_SOURCE_DIR + ("/examples/" + name), changes);
}
DriveChoice choice(const std::string& name, const std::vector<std::string>& changes = {}) {
  return drive_choice(example(name, changes));
}

TEST(DriveChoice, IsMusclesForEveryMotionWhereNothingIsSaid) {
  for (const char* name : {"mouth_open.toml", "one_sided_smile.toml"}) {
    const DriveChoice found = drive_choice(example(name));
    EXPECT_EQ(found.by, DriveBy::muscles) << name;
    EXPECT_EQ(found.why, "driven by muscles: nothing in the scene says otherwise");
  }
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
  const std::string why = drive_choice(scene).why;
  EXPECT_EQ(session.drive_reason(), why);
  EXPECT_THAT(session.notes(), Contains(make_note("drive.chosen", why, "drive.by")));
}

}  // namespace
}  // namespace hyperex::session
