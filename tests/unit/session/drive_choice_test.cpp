// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/drive_choice.hpp"

#include <gmock/gmock.h>

#include "hyperex/session/face_session.hpp"
#include "support/note_matchers.hpp"

namespace hyperex::session {
using namespace scene;
namespace {
using simulate::DriveBy;
using test::is_warning;
using test::says;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
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

TEST(DriveChoice, KeysThatMusclesUseOrThatHaveNoEffectLeaveThemDriving) {
  for (const char* key :
       {"support.border=free", "support.skull=held", "support.mandible=held",
        "region.measured=none", "region.blend_mm=100", "region.measured_points=[\"ibug68_8\"]"})
    EXPECT_EQ(choice("one_sided_smile.toml", {key}).by, DriveBy::muscles) << key;
  EXPECT_EQ(choice("one_sided_smile.toml", {"region.measured=all"}).by, DriveBy::displacement);
}

TEST(DriveChoice, AKeyThatMakesDisplacementDriveIsWarnedOf) {
  const auto warned = [](const std::vector<std::string>& changes) {
    return drive_warnings(example("one_sided_smile.toml", changes));
  };
  EXPECT_THAT(warned({}), IsEmpty());
  EXPECT_THAT(warned({"support.field_kpa_per_mm=5"}),
              ElementsAre(AllOf(is_warning("drive.by_key"), says("support.field_kpa_per_mm"),
                                says("drive.by = \"displacement\""),
                                says("drive.by = \"muscles\", where it has no effect"))));
  EXPECT_THAT(warned({"region.measured=all"}),
              ElementsAre(AllOf(is_warning("drive.by_key"), says("region.measured"),
                                says("and region.measured = \"none\""))));
  for (const char* by : {"displacement", "reactions"})
    EXPECT_THAT(warned({"support.field_kpa_per_mm=5", std::string("drive.by=") + by}), IsEmpty());
}

TEST(DriveChoice, KeysOfSupportThatMusclesDoNotUseAreWarnedOf) {
  const std::vector<std::string> keys = {"drive.by=muscles", "support.field_kpa_per_mm=5",
                                         "support.jaw_points=[\"ibug68_8\"]"};
  EXPECT_THAT(drive_warnings(example("one_sided_smile.toml", keys)),
              ElementsAre(AllOf(is_warning("support.idle"), says("muscles drive the face"),
                                says(": support.field_kpa_per_mm, support.jaw_points"))));
  EXPECT_THAT(
      drive_warnings(example("one_sided_smile.toml", {"support.jaw_points=[\"ibug68_8\"]"})),
      ElementsAre(is_warning("support.idle")))
      << "muscles drive where nothing else is said";
  for (const char* used : {"support.border=free", "support.skull=held", "support.mandible=free"})
    EXPECT_THAT(drive_warnings(example("one_sided_smile.toml", {"drive.by=muscles", used})),
                IsEmpty())
        << used;
}

TEST(DriveChoice, KeysOfSupportThatOnlyAVariantGivesAreWarnedOf) {
  Scene scene = example("variants.toml", {"drive.by=muscles"});
  for (Variant& variant : scene.variants) variant.scene.drive.by = DriveBy::muscles;
  EXPECT_THAT(drive_warnings(scene),
              ElementsAre(AllOf(is_warning("support.idle"), says("support.field_kpa_per_mm"))));
  Variant& other = scene.variants.front();
  other.scene.drive.by = DriveBy::displacement;
  EXPECT_THAT(drive_warnings(scene), ElementsAre(is_warning("support.idle")))
      << "another variant would use it, and does not give it";
  other.changes["support.field_kpa_per_mm"] = 0.5;
  EXPECT_THAT(drive_warnings(scene), IsEmpty()) << "a variant uses it";
}

TEST(DriveChoice, AKeyOfAVariantIsWarnedOfWithItsName) {
  Scene scene = example("variants.toml");
  EXPECT_THAT(drive_warnings(scene), IsEmpty());
  scene.origins.erase("drive.by");
  EXPECT_THAT(drive_warnings(scene),
              ElementsAre(AllOf(is_warning("drive.by_key"), says("support.field_kpa_per_mm"),
                                says("softer under the skin"))));
  EXPECT_THAT(drive_choice(scene).why, HasSubstr("in variant softer under the skin"));
  scene.variants.front().changes["drive.by"] = "displacement";
  EXPECT_THAT(drive_warnings(scene), IsEmpty()) << "a variant says what drives";
}

TEST(DriveChoice, KeysOfARegionThatIsNotMeasuredAreWarnedOf) {
  const std::vector<std::string> keys = {"region.blend_mm=100",
                                         "region.measured_points=[\"ibug68_8\"]"};
  EXPECT_THAT(drive_warnings(example("one_sided_smile.toml", keys)),
              ElementsAre(AllOf(is_warning("region.idle"),
                                says(": region.measured_points, region.blend_mm"))));
  Scene scene = example("variants.toml", keys);
  EXPECT_THAT(drive_warnings(scene), Contains(is_warning("region.idle")));
  scene.variants.back().scene.region.measured = simulate::Measured::all;
  EXPECT_THAT(drive_warnings(scene), IsEmpty());
}

TEST(DriveChoice, WarningsFollowWhatIsSetLater) {
  std::vector<std::string> changes = {"support.field_kpa_per_mm=5", "mesh.element_size_mm=8",
                                      "mesh.layers=1"};
  FaceSession session(example("mouth_open.toml", changes), {.certainty = Certainty::on_request});
  EXPECT_THAT(session.warnings(), Contains(is_warning("drive.by_key")));
  changes.push_back("drive.by=displacement");
  EXPECT_TRUE(session.set_scene(example("mouth_open.toml", changes)));
  EXPECT_THAT(session.warnings(), Not(Contains(is_warning("drive.by_key"))));
}

TEST(DriveChoice, IsWarnedOfByCheck) {
  EXPECT_THAT(check(example("one_sided_smile.toml", {"support.field_kpa_per_mm=5"})),
              Contains(is_warning("drive.by_key")));
  EXPECT_THAT(check(example("one_sided_smile.toml", {"region.blend_mm=100"})),
              Contains(is_warning("region.idle")));
}

TEST(DriveChoice, IsNotedByCheck) {
  for (const std::vector<std::string>& changes :
       {std::vector<std::string>{}, {"drive.by=displacement"}, {"region.measured=all"}}) {
    const Scene scene = example("one_sided_smile.toml", changes);
    EXPECT_THAT(check(scene),
                Contains(make_note("drive.chosen", drive_choice(scene).why, "drive.by")));
  }
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
