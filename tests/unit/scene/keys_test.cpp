// SPDX-License-Identifier: GPL-3.0-or-later
// Tests over all keys of the table: what the table says of a key must hold in the file and for
// --set.
#include "hyperex/scene/keys.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <set>

#include "unit/scene/other_values.hpp"
#include "unit/scene/scene_files.hpp"

namespace hyperex::scene {
namespace {
using nlohmann::json;

/// The value as it is stored: paths, also those in columns of rows, are relative to the scene's
/// folder.
json expected_echo(const Key& key, json value, const std::filesystem::path& folder) {
  const auto place = [&](json& path) {
    path = (folder / path.get<std::string>()).generic_string();
  };
  if (key.kind == Kind::path) place(value);
  for (const KeyInfo& column : key.columns)
    if (column.kind == Kind::path)
      for (json& row : value)
        if (row.contains(column.name)) place(row[column.name]);
  return value;
}

TEST(Keys, AreNamedOnceInKnownSectionsInOrder) {
  std::set<std::string> names;
  std::size_t section = 0;
  for (const Key& key : keys()) {
    EXPECT_TRUE(names.insert(key.name).second) << key.name;
    EXPECT_FALSE(key.description.empty()) << key.name;
    while (section < sections().size() && sections()[section].name != section_of(key.name))
      ++section;
    ASSERT_LT(section, sections().size()) << key.name << " is out of order or in no section";
  }
  EXPECT_EQ(find_key("time.step_s")->name, "time.step_s");
  EXPECT_EQ(find_key("time.step"), nullptr);
}

TEST(Keys, HaveTheDefaultOfTheirMembersOrWhatASceneChooses) {
  for (const Key& key : keys()) {
    if (key.name == "drive.by" || key.name == "contact.lips") continue;
    EXPECT_TRUE(key.scene_default.empty()) << key.name;
    EXPECT_EQ(default_of(key), key.get(Scene{})) << key.name;
  }
  EXPECT_EQ(default_of(*find_key("drive.by")), "muscles");
  EXPECT_EQ(default_of(*find_key("contact.lips")), true);
}

/// "patch_radius_mm" and "patch_radius_m" without their units.
std::string without_unit(std::string name) {
  for (const char* ending : {"_kpa_per_mm", "_pa_per_m", "_pa_s", "_kg_m3", "_kpa", "_pa", "_mm",
                             "_hz", "_mb", "_gb", "_deg", "_ml", "_m3", "_m", "_s"})
    if (name.ends_with(ending)) return name.substr(0, name.size() - std::string(ending).size());
  return name;
}

/// Keys whose names differ from those of their members. All others must agree.
const std::map<std::string, std::string> kOtherMembers = {
    {"scan.file", "scan.source"},
    {"motion.file", "motion.source"},
    {"motion.point_gain", "motion.point_gains"},
    {"motion.gain", "drive.gain"},
    {"mesh.thickness_point", "mesh.depths"},
    {"mesh.thickness_per_vertex", "mesh.depth_per_vertex"},
    {"mesh.thickness_region", "mesh.depth_regions"},
    {"tissue.young_kpa", "tissue.uniform[young]"},
    {"tissue.viscosity_pa_s", "tissue.uniform[viscosity]"},
    {"tissue.poisson", "tissue.uniform[poisson]"},
    {"tissue.density_kg_m3", "tissue.uniform[density]"},
    {"tissue.layer", "tissue.layers"},
    {"tissue.point", "tissue.points"},
    {"tissue.region", "tissue.regions"},
    {"surgery.bone", "surgery.bones"},
    {"tissue.yeoh_c20", "model.law.c20"},
    {"tissue.yeoh_c30", "model.law.c30"},
    {"tissue.mooney_c01", "model.law.c01"},
    {"tissue.maxwell", "model.law.branches"},
    {"support.border", "support.border_held"},
    {"support.skull_across_kpa_per_mm", "support.skull_layer.across_pa_per_m"},
    {"support.skull_along_kpa_per_mm", "support.skull_layer.along_pa_per_m"},
    {"support.mandible_across_kpa_per_mm", "support.mandible_layer.across_pa_per_m"},
    {"support.mandible_along_kpa_per_mm", "support.mandible_layer.along_pa_per_m"},
    {"muscles.gain", "muscles.gains"},
    {"muscles.file", "muscles_file"},
    {"muscles.without", "muscles_without"},
    {"time.start_s", "motion.start_s"},
    {"output.peak_time_s", "time.peak_time_s"},
    {"output.picture_times_s", "time.still_times_s"}};

TEST(Keys, AreCalledAsTheMembersThatTheyReach) {
  std::size_t others = 0;
  for (const Key& key : keys()) {
    SCOPED_TRACE(key.name + " reaches " + key.member);
    if (const auto other = kOtherMembers.find(key.name); other != kOtherMembers.end()) {
      EXPECT_EQ(key.member, other->second);
      ++others;
      continue;
    }
    const std::size_t key_dot = key.name.rfind('.'), member_dot = key.member.rfind('.');
    EXPECT_EQ(without_unit(key.member.substr(member_dot + 1)),
              without_unit(key.name.substr(key_dot + 1)));
    if (section_of(key.name) != "tissue") {  // of which the model is a part
      EXPECT_EQ(section_of(key.member), section_of(key.name));
    }
  }
  EXPECT_EQ(others, kOtherMembers.size());
}

TEST(Keys, NumbersHaveBoundsAndTheUnitOfTheirName) {
  const auto check = [](const KeyInfo& key) {
    const bool number = key.kind == Kind::number || key.kind == Kind::integer ||
                        key.kind == Kind::numbers || key.kind == Kind::factors;
    EXPECT_EQ(number, key.range.least < key.range.most) << key.name;
    EXPECT_TRUE(key.name.ends_with(key.unit.ending)) << key.name;
    EXPECT_EQ(*key.unit.name == 0, without_unit(key.name) == key.name) << key.name;
  };
  for (const Key& key : keys()) {
    check(key);
    for (const KeyInfo& column : key.columns) check(column);
  }
}

TEST(Keys, DefaultsAreAllowed) {
  for (const Key& key : keys()) {
    if (key.kind == Kind::path) continue;
    Scene scene;
    EXPECT_TRUE(key.set(scene, key.get(scene), {}).empty()) << key.name;
  }
}

TEST(Keys, EachReachesItsFieldFromTheFileAndNoOther) {
  const SceneFolder folder;
  for (const Key& key : keys()) {
    SCOPED_TRACE(key.name);
    const json value = other_value(key);
    const auto file = folder.write("scene.toml", scene_with(key.name, toml(value)));
    const Scene scene =
        read_scene(file, key.name == "region.measured"
                             ? std::vector<std::string>{"region.measured_points=[\"a\"]"}
                             : std::vector<std::string>{});
    EXPECT_EQ(key.get(scene), expected_echo(key, value, folder / ""));
    EXPECT_EQ(scene.origins.at(key.name).line, 1);
    for (const Key& other : keys()) {
      if (other.name == key.name || scene.origins.count(other.name)) continue;
      if (other.name == "contact.lips") {
        EXPECT_EQ(other.get(scene), key.name != "tissue.strain") << "a scene chooses by strain";
        continue;
      }
      EXPECT_EQ(other.get(scene), other.get(Scene{})) << other.name << " changed as well";
    }
  }
}

TEST(Keys, EachReachesItsFieldFromSet) {
  const SceneFolder folder;
  for (const Key& key : keys()) {
    SCOPED_TRACE(key.name);
    const auto file = folder.write("scene.toml", scene_with("scan.file", "\"face.ply\"") +
                                                     "region.measured_points = [\"a\"]\n" +
                                                     "solver.newmark_beta = 0.5\n");
    const json value = expected_echo(key, other_value(key), folder / "");
    std::vector<std::string> overrides = {key.name + "=" + toml(value)};
    if (key.name.starts_with("muscles.") || key.name.starts_with("surgery."))
      overrides.push_back("drive.by=muscles");
    const Scene scene = read_scene(file, overrides);
    EXPECT_EQ(key.get(scene), value);
    EXPECT_EQ(scene.origins.at(key.name).file, "--set");
    const bool bare = key.kind == Kind::choice || key.kind == Kind::path;
    if (bare) {
      overrides.front() = key.name + "=" + value.get<std::string>();
      EXPECT_EQ(key.get(read_scene(file, overrides)), value);
    }
  }
}

TEST(Keys, NumbersOutOfRangeAreRefusedOnEachSide) {
  const SceneFolder folder;
  const auto refused = [&](const Key& key, const std::string& value) {
    const bool list = key.kind == Kind::numbers;
    const auto file =
        folder.write("scene.toml", scene_with(key.name, list ? "[" + value + "]" : value));
    const auto problems = problems_of(file);
    ASSERT_EQ(problems.size(), 1u) << key.name << " = " << value << "\n" << sentences(problems);
    EXPECT_EQ(problems[0].key, key.name + (list ? "[0]" : ""));
    EXPECT_EQ(problems[0].line, 1);
    EXPECT_THAT(problems[0].expected, testing::HasSubstr(key.range.text()));
  };
  int count = 0;
  for (const Key& key : keys()) {
    if (key.kind != Kind::integer && key.kind != Kind::number && key.kind != Kind::numbers)
      continue;
    ++count;
    const auto& [low, high, above, or_zero] = key.range;
    if (key.kind == Kind::integer) {
      refused(key, fmt::format("{}", int(low) - 1));
      refused(key, fmt::format("{}", int(high) + 1));
      refused(key, "9000000000000000000");
      refused(key, fmt::format("{:.1f}", low));  // not an integer
    } else {
      refused(key, fmt::format("{:.17f}", above ? low : std::nextafter(low, -1e9) - 1e-12));
      refused(key, fmt::format("{:.17g}", std::nextafter(high, 1e99)));
    }
    for (const char* never : {"nan", "inf", "-inf", "1e300", "\"1\"", "true", "2024-01-01"})
      refused(key, never);
  }
  EXPECT_GE(count, 15);
}

TEST(Keys, LimitsThemselvesAreAllowed) {
  for (const Key& key : keys()) {
    if (key.kind != Kind::integer && key.kind != Kind::number) continue;
    std::vector<double> limits = {key.range.most};
    if (!key.range.above_least) limits.push_back(key.range.least);
    if (key.range.or_zero) limits.push_back(0);
    for (const double limit : limits) {
      Scene scene;
      const json value = key.kind == Kind::integer ? json(int(limit)) : json(limit);
      EXPECT_TRUE(key.set(scene, value, {}).empty()) << key.name << " = " << limit;
      EXPECT_EQ(key.get(scene), value) << key.name;
    }
  }
}

TEST(Keys, WrongTypesAreRefusedWithWhatWasExpected) {
  const SceneFolder folder;
  for (const Key& key : keys()) {
    for (const char* wrong :
         {"{a = 1}", "[[1]]", "1979-05-27", "\"no such word\"", "-77.5", "true"}) {
      const std::string text = wrong;
      if (key.kind == Kind::text && text[0] == '"') continue;
      if (key.kind == Kind::flag && text == "true") continue;
      if (key.name == "output.peak_time_s" && text == "true") continue;
      const auto problems = problems_of(folder.write("scene.toml", scene_with(key.name, text)));
      ASSERT_GE(problems.size(), 1u) << key.name << " = " << wrong;
      bool named = false;
      for (const auto& problem : problems) {
        named = named || problem.key.rfind(key.name, 0) == 0;
        EXPECT_FALSE(problem.expected.empty());
        EXPECT_EQ(problem.sentence().find('\n'), std::string::npos);
      }
      EXPECT_TRUE(named) << key.name << " = " << wrong << "\n" << sentences(problems);
    }
  }
}

TEST(Keys, NearestAllowsForSlipsUnitsAndSections) {
  std::vector<std::string> names;
  for (const Key& key : keys()) names.push_back(key.name);
  EXPECT_EQ(nearest("time.setp_s", names), "time.step_s");
  EXPECT_EQ(nearest("time.step_ms", names), "time.step_s");
  EXPECT_EQ(nearest("time.step", names), "time.step_s");
  EXPECT_EQ(nearest("step_s", names), "time.step_s");
  EXPECT_EQ(nearest("mesh.young_kpa", names), "tissue.young_kpa");
  EXPECT_EQ(nearest("mesh.Thickness", names), "mesh.thickness_mm");
  EXPECT_EQ(nearest("time.colour_of_the_sky", names), "");
  const std::vector<std::string> gains = {"motion.gain", "muscles.gain"};
  EXPECT_EQ(nearest("muscle.gain", gains), "muscles.gain");
  EXPECT_EQ(nearest("mucsle.gain", gains), "muscles.gain");
  EXPECT_EQ(nearest("motoin.gain", gains), "motion.gain");
  EXPECT_EQ(nearest("", names), "");
}

}  // namespace
}  // namespace hyperex::scene
