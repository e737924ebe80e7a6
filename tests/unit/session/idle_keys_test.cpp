// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/idle_keys.hpp"

#include <gmock/gmock.h>

#include <map>
#include <set>

#include "hyperex/core/progress.hpp"
#include "hyperex/scene/keys.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/session/face_session.hpp"
#include "support/note_matchers.hpp"
#include "support/noted_scenes.hpp"
#include "unit/scene/scene_files.hpp"

namespace hyperex::session {
namespace {
using test::is_about;
using test::is_warning;
using test::says;
using testing::AllOf;
using testing::Contains;
using testing::IsEmpty;

/// Lines of a scene in which a rule applies, and another value for each of its keys.
struct IdleCase {
  std::string scene;
  std::map<std::string, std::string> other;
};

/// One for each of idle_rules(), in their order.
/// `weights`: a file of blend shapes.
std::vector<IdleCase> idle_cases(const std::string& file, const std::string& weights) {
  const std::string displacement = "drive.by=\"displacement\"\n",
                    finite = "tissue.strain=\"finite\"\n";
  return {
      {displacement + "support.skull=\"held\"",
       {{"support.skull_across_kpa_per_mm", "50"}, {"support.skull_along_kpa_per_mm", "50"}}},
      {displacement + "support.mandible=\"held\"",
       {{"support.mandible_across_kpa_per_mm", "3"}, {"support.mandible_along_kpa_per_mm", "50"}}},
      {displacement + "region.measured=\"all\"",
       {{"region.measured_points", "[\"ibug68_8\"]"},
        {"region.measured_radius_mm", "30"},
        {"region.blend_mm", "20"}}},
      {displacement + finite + "tissue.law=\"mooney-rivlin\"",
       {{"tissue.yeoh_c20", "1"}, {"tissue.yeoh_c30", "1"}}},
      {displacement + finite + "tissue.law=\"yeoh\"", {{"tissue.mooney_c01", "1"}}},
      {finite, {{"solver.method", "direct"}, {"solver.verify", "true"}}},
      {displacement + finite + "solver.newmark_beta=0.5",
       {{"solver.newmark_beta", "0.7"}, {"solver.newmark_gamma", "0.7"}}},
      {displacement + "solver.method=\"direct\"", {{"solver.verify", "true"}}},
      {displacement + "teeth.shape=\"none\"", {{"contact.teeth", "true"}}},
      {displacement, {{"teeth.unit", "cm"}}},
      {displacement, {{"anatomy.unit", "cm"}}},
      {displacement + "scan.file=\"embedded\"\nscan.unit=\nscan.landmarks=",
       {{"scan.landmarks_unit", "cm"}}},
      {displacement, {{"motion.candide", file}}},
      {displacement, {{"tissue.interpolation", "linear"}}},
      {displacement, {{"tissue.mirror", "true"}}},
      {displacement + "motion.file=\nmotion.arkit=\"" + weights + "\"",
       {{"motion.rigid_points", R"(["ibug68_27", "ibug68_36", "ibug68_45"])"}}}};
}

class IdleKeys : public testing::Test {
 protected:
  IdleKeys() { Progress::silence(true); }
  ~IdleKeys() override { Progress::silence(false); }

  static std::vector<PointsF> skin_of(const scene::Scene& scene) {
    FaceSession face(scene, {.certainty = Certainty::on_request});
    face.run_base();
    return face.performance().skin_displacement_m;
  }

  /// A scene of `lines`, with `changes` of them.
  scene::Scene scene_of(const std::string& lines, std::vector<std::string> changes = {}) const {
    changes.push_back("time.end_s=0.1");
    return scene::read_scene(
        test::write_noted_scene({.id = "", .when_read = true, .keys = lines, .spoil = nullptr},
                                folder_ / "idle"),
        changes);
  }

  const scene::SceneFolder folder_;
};

TEST_F(IdleKeys, EachChangesNothingAndIsWarnedOf) {
  const std::string weights =
      folder_.write("weights.csv", "time_s,mouthSmileLeft\n0,0\n0.1,0.5\n0.2,1\n").string();
  const auto cases = idle_cases((folder_ / "motion.csv").string(), weights);
  ASSERT_EQ(cases.size(), idle_rules().size());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const IdleRule& rule = idle_rules()[i];
    const auto skin = skin_of(scene_of(cases[i].scene));
    std::set<std::string> tried;
    for (const auto& [key, value] : cases[i].other) {
      SCOPED_TRACE(key + " where " + rule.why);
      tried.insert(key);
      const scene::Scene scene = scene_of(cases[i].scene, {key + "=" + value});
      EXPECT_THAT(
          idle_keys_warnings(scene),
          Contains(AllOf(is_warning("keys.idle"), is_about(rule.by), says(rule.why), says(key))));
      EXPECT_TRUE(skin_of(scene) == skin);
    }
    EXPECT_EQ(tried, std::set<std::string>(rule.keys.begin(), rule.keys.end()));
    EXPECT_TRUE(scene::find_key(rule.by)) << rule.by;
  }
}

TEST_F(IdleKeys, AreNotThoseThatAct) {
  for (const std::vector<std::string>& changes : std::vector<std::vector<std::string>>{
           {},
           {"drive.by=displacement", "support.skull_across_kpa_per_mm=50",
            "support.mandible_along_kpa_per_mm=50", "solver.verify=true"},
           {"tissue.strain=finite", "tissue.law=yeoh", "tissue.yeoh_c20=1"},
           {"tissue.strain=finite", "tissue.law=mooney-rivlin", "tissue.mooney_c01=1"},
           {"contact.teeth=true"},
           {"scan.landmarks_unit=mm"},
           {R"(motion.rigid_points=["ibug68_27", "ibug68_36", "ibug68_45"])"},
           {"region.measured=points", "region.measured_points=[\"ibug68_8\"]", "region.blend_mm=9"},
           {"tissue.preset=source_model_1", "tissue.interpolation=linear", "tissue.mirror=true"}})
    EXPECT_THAT(idle_keys_warnings(scene_of("", changes)), IsEmpty())
        << testing::PrintToString(changes);
}

TEST_F(IdleKeys, ActWhereForcesAreFoundAtSmallStrain) {
  const std::vector<std::string> changes = {"tissue.strain=finite", "solver.newmark_beta=0.5"};
  EXPECT_THAT(idle_keys_warnings(scene_of("", changes)), IsEmpty()) << "muscles drive";
  EXPECT_THAT(idle_keys_warnings(scene_of("drive.by=\"displacement\"", changes)),
              Contains(says("solver.newmark_beta")));
}

TEST_F(IdleKeys, AreSaidByCheckAndBySessions) {
  const scene::Scene scene = scene_of("", {"teeth.shape=none", "contact.teeth=true"});
  EXPECT_THAT(check(scene), Contains(is_warning("keys.idle")));
  const FaceSession face(scene, {.certainty = Certainty::on_request});
  EXPECT_THAT(face.warnings(), Contains(is_warning("keys.idle")));
}

}  // namespace
}  // namespace hyperex::session
