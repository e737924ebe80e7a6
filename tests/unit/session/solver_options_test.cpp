// SPDX-License-Identifier: GPL-3.0-or-later
// Conversion of every key of the scene to the options of the simulation: a key changes exactly its
// own member, there and in the scene, to the given value.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <set>

#include "hyperex/scene/keys.hpp"
#include "hyperex/session/simulation_options.hpp"
#include "hyperex/tissue/field/presets.hpp"
#include "hyperex/tissue/field/tissue_field.hpp"
#include "unit/scene/other_values.hpp"
#include "unit/scene/scene_files.hpp"

namespace hyperex::session {
using namespace scene;
namespace {
using nlohmann::json;

/// Every described option of a struct as text, by member name.
class Shown {
 public:
  template <class Struct>
  Shown(const Struct& options, const std::string& prefix) {
    add(options, prefix);
  }
  std::map<std::string, std::string> all;

 private:
  template <class Struct>
  struct Visitor {
    Shown& shown;
    const Struct& options;
    std::string prefix;
    template <class At>
    void option(const char* name, At at, const char*, const OptionDetails& = {}) {
      shown.show(prefix + name, at(options));
    }
    template <class At, class AllAt>
    void one_or_all(const char* name, At at, const char* all_name, AllAt all_at, const char*) {
      shown.show(prefix + name, at(options));
      shown.show(prefix + all_name, all_at(options));
    }
    template <class At, class Words>
    void factors(const char* name, At at, const Words&, const char*, const OptionDetails&) {
      shown.show(prefix + name, at(options));
    }
  };
  template <class Struct>
  void add(const Struct& options, const std::string& prefix) {
    Visitor<Struct> visitor{*this, options, prefix};
    Struct::describe(visitor);
  }
  template <class Value>
  void show(const std::string& name, const Value& value) {
    if constexpr (Described<Value>) {
      add(value, name + ".");
    } else if constexpr (std::is_enum_v<Value>) {
      all[name] = std::to_string(int(value));
    } else if constexpr (std::is_same_v<Value, scene::Source>) {
      all[name] = value.embedded ? "embedded" : value.file.string();
    } else if constexpr (std::is_arithmetic_v<Value>) {
      all[name] = fmt::format("{:.12g}", double(value));
    } else if constexpr (requires { std::string(value); }) {
      all[name] = std::string(value);
    } else if constexpr (requires { value.has_value(); }) {
      if (value) show(name, *value);
    } else if constexpr (requires { value.begin(); }) {
      std::size_t i = 0;
      all[name] = std::to_string(value.size());
      for (const auto& one : value) show(fmt::format("{}[{}]", name, i++), one);
    }
  }
};

using Names = std::set<std::string>;

/// The names of the members that differ: "mesh.depths" where any of its rows does.
Names changed(const Shown& before, const Shown& after) {
  Names names;
  const auto compare = [&](const Shown& a, const Shown& b) {
    for (const auto& [name, value] : a.all)
      if (const auto other = b.all.find(name); other == b.all.end() || other->second != value) {
        const auto list = std::find_if(a.all.begin(), a.all.end(), [&](const auto& one) {
          return name.starts_with(one.first + "[") && name != one.first;
        });
        names.insert(list == a.all.end() ? name : list->first);
      }
  };
  compare(before, after);
  compare(after, before);
  return names;
}

simulate::SimulationOptions simulation_of(const Scene& scene) {
  Inputs recorded;
  recorded.motion.motion.names = {"every", "point"};
  return simulation_options(scene, inputs_of_variant(scene, recorded));
}

/// The members that a key should change in the options of the simulation: its own member, if they
/// have it.
Names wanted_in_simulation(const Key& key) {
  const std::string section = key.member.substr(0, key.member.find('.'));
  for (const char* part :
       {"model", "support", "drive", "muscles", "region", "contact", "solver", "time"})
    if (section == part) return {key.member};
  return {};
}

/// A scene with `key` at another value, and the same scene with that key back at its default.
struct Pair {
  Scene before, after;
  json value;
};

Pair scenes_of(const SceneFolder& folder, const Key& key) {
  Pair pair;
  pair.value = other_value(key);
  if (key.name == "tissue.preset") pair.value = tissue::tissue_presets().front().name;
  const auto file = folder.write("scene.toml", scene_with(key.name, toml(pair.value)));
  pair.after = read_scene(file, key.name == "region.measured"
                                    ? std::vector<std::string>{"region.measured_points=[\"a\"]"}
                                    : std::vector<std::string>{});
  // The same file without the key; a source must be there.
  std::string rest = scene_with(key.name, toml(pair.value));
  rest.erase(0, rest.find('\n') + 1);
  if (key.name == "scan.file") rest += "scan.file = \"embedded\"\n";
  if (key.name.starts_with("motion.") && rest.find("motion.file") == std::string::npos)
    rest += "motion.file = \"embedded\"\n";
  if (key.name == "region.measured") rest += "region.measured_points = [\"a\"]\n";
  pair.before = read_scene(folder.write("before.toml", rest));
  return pair;
}

TEST(SolverOptions, EachKeyChangesExactlyItsOwn) {
  const SceneFolder folder;
  std::size_t simulated = 0;
  for (const Key& key : keys()) {
    SCOPED_TRACE(key.name);
    const Pair pair = scenes_of(folder, key);
    Names own = {key.member};
    if (key.kind == Kind::path && key.name == "muscles.file") continue;  // an empty file is refused
    // Another source of motion takes the place of the embedded one.
    if (key.name.starts_with("motion.") && key.kind == Kind::path && key.name != "motion.candide" &&
        key.name != "motion.rig")
      own.insert("motion.source");
    // At finite strain the lips are not kept apart by default.
    if (key.name == "tissue.strain") own.insert("contact.lips");
    EXPECT_EQ(changed(Shown(pair.before, ""), Shown(pair.after, "")), own);
    Names wanted = wanted_in_simulation(key);
    if (key.name == "tissue.strain") wanted.insert("contact.lips");
    // Without points named it drives those of the default that the model has.
    if (key.name == "motion.candide") wanted = {"drive.points"};
    if (key.name == "surgery.bone") wanted = {"surgery.bones"};
    simulated += wanted.size();
    EXPECT_EQ(changed(Shown(simulation_of(pair.before), ""), Shown(simulation_of(pair.after), "")),
              wanted);
  }
  EXPECT_GE(simulated, 45u);
}

/// Bones that move push the lips against each other.
TEST(SolverOptions, MovedBonesKeepTheLipsApartWhateverTheSceneSays) {
  const SceneFolder folder;
  const Key& bones = *find_key("surgery.bone");
  const auto file = folder.write("scene.toml", scene_with(bones.name, toml(other_value(bones))));
  EXPECT_TRUE(simulation_of(read_scene(file, {"contact.lips=false"})).contact.lips);
  EXPECT_FALSE(
      simulation_of(read_scene(folder.write("plain.toml", smallest), {"contact.lips=false"}))
          .contact.lips);
}

TEST(SolverOptions, UniformParametersArriveInTheSimulation) {
  const SceneFolder folder;
  const auto file = folder.write("scene.toml", smallest);
  for (int p = 0; p < tissue::parameter_count; ++p) {
    const Key& key = *find_key("tissue." + tissue::parameter_info(p).key);
    const json value = other_value(key);
    tissue::TissueParameters wanted = simulation_of(read_scene(file)).tissue.uniform;
    wanted[std::size_t(p)] = key.unit.to_si(value.get<double>());
    EXPECT_EQ(simulation_of(read_scene(file, {key.name + "=" + toml(value)})).tissue.uniform,
              wanted)
        << key.name;
  }
}

/// The SI unit follows from the ending of the member's name, independently of its described unit.
TEST(SolverOptions, NumbersArriveInSiUnits) {
  const SceneFolder folder;
  int count = 0;
  for (const Key& key : keys()) {
    if (key.kind != Kind::number || wanted_in_simulation(key).empty()) continue;
    const Pair pair = scenes_of(folder, key);
    const double factor = key.name.ends_with("_mm") && !key.name.ends_with("_kpa_per_mm") ? 1e-3
                          : key.name.ends_with("_kpa_per_mm")                             ? 1e6
                          : key.name.ends_with("_kpa")                                    ? 1e3
                                                                                          : 1;
    const auto all = Shown(simulation_of(pair.after), "").all;
    EXPECT_NEAR(std::stod(all.at(key.member)) / (factor * pair.value.get<double>()), 1, 1e-9)
        << key.name << " as " << key.member;
    ++count;
  }
  EXPECT_GE(count, 20);
}

TEST(SolverOptions, AValueSetInCodeWinsOverThePreset) {
  Scene scene;
  int presets = 0;
  for (const tissue::TissuePreset& preset : tissue::tissue_presets()) {
    scene.tissue = {};
    scene.tissue.preset = preset.name;
    if (!preset.uniform[tissue::young]) continue;
    scene.tissue.uniform[tissue::young] = 77e3;
    EXPECT_EQ(simulation_options(scene, Inputs{}).tissue.uniform[tissue::young],
              77e3 * preset.factor[tissue::young].value_or(1))
        << preset.name;
    ++presets;
  }
  EXPECT_GE(presets, 1);
}

TEST(SolverOptions, AllPointsDriveWhereTheSceneSaysAll) {
  const SceneFolder folder;
  const Scene scene =
      read_scene(folder.write("scene.toml", smallest), {std::string("drive.points=all")});
  EXPECT_THAT(simulation_of(scene).drive.points, testing::ElementsAre("every", "point"));
}

}  // namespace
}  // namespace hyperex::session
