// SPDX-License-Identifier: GPL-3.0-or-later
// The hop from the scene to the options of mesh, tissue and simulation: each key changes exactly
// the options that the table below names, to the value that was given. A key that the table does
// not name must change none of them.
#include <fmt/format.h>
#include <gmock/gmock.h>

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
using Options = std::map<std::string, std::string>;

std::string shown(double value) {
  return fmt::format("{:.12g}", value);
}
std::string shown(bool value) {
  return value ? "true" : "false";
}
std::string shown(const std::filesystem::path& value) {
  return value.filename().string();
}
template <class Enum>
requires std::is_enum_v<Enum> std::string shown(Enum value) {
  return std::to_string(int(value));
}
std::string shown(const std::vector<std::string>& values) {
  std::string text;
  for (const auto& value : values) text += value + ";";
  return text;
}
std::string shown(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += shown(value) + ";";
  return text;
}

void add_simulation(const simulate::SimulationOptions& o, Options& all) {
  const auto add = [&](const std::string& name, const auto& value) { all[name] = shown(value); };
  add("model.element", o.model.element);
  add("model.viscous_form", o.model.viscous_form);
  add("solver.method", o.solver.method);
  add("solver.linear", o.solver.linear);
  add("solver.tolerance", o.solver.tolerance);
  add("solver.newmark_beta", o.solver.newmark_beta);
  add("solver.newmark_gamma", o.solver.newmark_gamma);
  add("solver.verify", o.solver.verify);
  add("tissue.young_pa", o.tissue.uniform[tissue::young]);
  add("tissue.poisson", o.tissue.uniform[tissue::poisson]);
  add("tissue.viscosity_pa_s", o.tissue.uniform[tissue::viscosity]);
  add("tissue.density_kg_m3", o.tissue.uniform[tissue::density]);
  add("support.border_held", o.support.border_held);
  add("support.skull", o.support.skull);
  add("support.mandible", o.support.mandible);
  add("support.skull_layer.across", o.support.skull_layer.across_pa_per_m);
  add("support.skull_layer.along", o.support.skull_layer.along_pa_per_m);
  add("support.mandible_layer.across", o.support.mandible_layer.across_pa_per_m);
  add("support.mandible_layer.along", o.support.mandible_layer.along_pa_per_m);
  add("support.field", o.support.field_pa_per_m);
  add("support.jaw_points", o.support.jaw_points);
  add("drive.by", o.drive.by);
  std::string gains;
  for (const simulate::MuscleGain& g : o.muscles.gains) gains += g.muscle + shown(g.gain) + ";";
  all["muscles.gains"] = gains;
  add("muscles.mirrored", o.muscles.mirrored);
  add("drive.points", o.drive.points);
  add("drive.still_points", o.drive.still_points);
  add("drive.patch_radius_m", o.drive.patch_radius_m);
  add("drive.gain", o.drive.gain);
  add("region.measured", o.region.measured);
  add("region.measured_points", o.region.measured_points);
  add("region.measured_radius_m", o.region.measured_radius_m);
  add("region.blend_m", o.region.blend_m);
  add("time.step_s", o.time.step_s);
  add("time.end_s", o.time.end_s);
  add("time.frame_rate_hz", o.time.frame_rate_hz);
  add("time.still_times_s", o.time.still_times_s);
  add("time.peak_time_s", o.time.peak_time_s);
}

void add_mesh(const tissue::TissueMeshOptions& o, Options& all) {
  all["mesh.element_size_m"] = shown(o.element_size_m);
  all["mesh.layers"] = shown(double(o.layers));
  all["mesh.thickness_m"] = shown(o.thickness_m);
  all["mesh.cut_lips"] = shown(o.cut_lips);
  all["mesh.trim_border_m"] = shown(o.trim_border_m);
  std::string depths;
  for (const auto& d : o.depths) depths += d.landmark + "=" + shown(d.depth_m) + ";";
  all["mesh.depths"] = depths;
  all["mesh.depth_per_vertex"] = o.depth_per_vertex.string();
  for (const auto& r : o.depth_regions)
    all["mesh.depth_regions"] += r.painted.string() + "=" + shown(r.depth_m) + ";";
}

std::string shown(const tissue::GivenParameters& given) {
  std::string text;
  for (const auto& value : given) text += (value ? shown(*value) : "-") + ",";
  return text;
}

void add_field(const tissue::TissueFieldOptions& o, Options& all) {
  all["field.uniform"] = shown(o.uniform);
  all["field.preset"] = o.preset;
  all["field.interpolation"] = shown(o.interpolation);
  all["field.mirror"] = shown(o.mirror);
  all["field.per_vertex"] = shown(o.per_vertex);
  for (const auto& p : o.points) all["field.points"] += p.landmark + p.side + shown(p.value);
  for (const auto& r : o.regions) all["field.regions"] += r.name + shown(r.value) + shown(r.factor);
}

Options options_of(const Scene& scene) {
  Options all;
  Inputs recorded;
  recorded.motion.motion.names = {"every", "point"};
  add_simulation(simulation_options(scene, inputs_of_variant(scene, recorded)), all);
  add_mesh(scene.mesh, all);
  add_field(scene.tissue, all);
  return all;
}

std::set<std::string> changed(const Options& before, const Options& after) {
  std::set<std::string> names;
  for (const auto& [name, value] : after)
    if (const auto old = before.find(name); old == before.end() || old->second != value)
      names.insert(name);
  for (const auto& [name, value] : before)
    if (!after.contains(name)) names.insert(name);
  return names;
}

using Targets = std::set<std::string>;
const std::map<std::string, Targets>& targets() {
  static const std::map<std::string, Targets> all = {
      {"motion.gain", {"drive.gain"}},
      {"region.measured", {"region.measured"}},
      {"region.measured_points", {"region.measured_points"}},
      {"region.measured_radius_mm", {"region.measured_radius_m"}},
      {"region.blend_mm", {"region.blend_m"}},
      {"mesh.element_size_mm", {"mesh.element_size_m"}},
      {"mesh.layers", {"mesh.layers"}},
      {"mesh.thickness_mm", {"mesh.thickness_m"}},
      {"mesh.cut_lips", {"mesh.cut_lips"}},
      {"mesh.trim_border_mm", {"mesh.trim_border_m"}},
      {"mesh.thickness_point", {"mesh.depths"}},
      {"mesh.thickness_per_vertex", {"mesh.depth_per_vertex"}},
      {"mesh.thickness_region", {"mesh.depth_regions"}},
      {"tissue.young_kpa", {"tissue.young_pa", "field.uniform"}},
      {"tissue.poisson", {"tissue.poisson", "field.uniform"}},
      {"tissue.viscosity_pa_s", {"tissue.viscosity_pa_s", "field.uniform"}},
      {"tissue.density_kg_m3", {"tissue.density_kg_m3", "field.uniform"}},
      {"tissue.viscous_form", {"model.viscous_form"}},
      {"tissue.element", {"model.element"}},
      {"tissue.interpolation", {"field.interpolation"}},
      {"tissue.mirror", {"field.mirror"}},
      {"tissue.per_vertex", {"field.per_vertex"}},
      {"tissue.point", {"field.points"}},
      {"tissue.region", {"field.regions"}},
      {"support.border", {"support.border_held"}},
      {"support.skull", {"support.skull"}},
      {"support.skull_across_kpa_per_mm", {"support.skull_layer.across"}},
      {"support.skull_along_kpa_per_mm", {"support.skull_layer.along"}},
      {"support.mandible", {"support.mandible"}},
      {"support.mandible_across_kpa_per_mm", {"support.mandible_layer.across"}},
      {"support.mandible_along_kpa_per_mm", {"support.mandible_layer.along"}},
      {"support.field_kpa_per_mm", {"support.field"}},
      {"support.jaw_points", {"support.jaw_points"}},
      {"drive.by", {"drive.by"}},
      {"muscles.gain", {"muscles.gains"}},
      {"muscles.mirrored", {"muscles.mirrored"}},
      {"drive.points", {"drive.points"}},
      {"drive.patch_radius_mm", {"drive.patch_radius_m"}},
      {"drive.still_points", {"drive.still_points"}},
      {"solver.method", {"solver.method"}},
      {"solver.linear", {"solver.linear"}},
      {"solver.tolerance", {"solver.tolerance"}},
      {"solver.newmark_beta", {"solver.newmark_beta"}},
      {"solver.newmark_gamma", {"solver.newmark_gamma"}},
      {"solver.verify", {"solver.verify"}},
      {"time.step_s", {"time.step_s"}},
      {"time.end_s", {"time.end_s"}},
      {"time.frame_rate_hz", {"time.frame_rate_hz"}},
      {"output.peak_time_s", {"time.peak_time_s"}},
      {"output.contact_times_s", {"time.still_times_s"}},
  };
  return all;
}

/// The scene with `key` at another value, and the same with that key back at its default.
struct Pair {
  Scene before, after;
  json value;
};

Pair scenes_of(const SceneFolder& folder, const Key& key) {
  Pair pair;
  pair.value = other_value(key);
  if (key.name == "tissue.preset") pair.value = tissue::tissue_presets().front().name;
  const auto file = folder.write("scene.toml", scene_with(key.name, toml(pair.value)));
  const bool needs_points = key.name == "region.measured";
  pair.after =
      read_scene(file, needs_points ? std::vector<std::string>{"region.measured_points=[\"a\"]"}
                                    : std::vector<std::string>{});
  pair.before = pair.after;
  pair.before.origins.erase(key.name);
  if (key.kind == Kind::path)  // an empty path is what no file says
    (key.name == "tissue.per_vertex" ? pair.before.tissue.per_vertex
                                     : pair.before.mesh.depth_per_vertex)
        .clear();
  else
    EXPECT_TRUE(key.set(pair.before, key.get(Scene{}), {}).empty()) << key.name;
  return pair;
}

TEST(SolverOptions, EachKeyChangesExactlyItsOwn) {
  const SceneFolder folder;
  std::set<std::string> seen;
  for (const Key& key : keys()) {
    SCOPED_TRACE(key.name);
    if (key.kind == Kind::path && !targets().contains(key.name)) continue;  // files to read
    if (key.name == "scan.file" || key.name == "motion.file") continue;
    const Pair pair = scenes_of(folder, key);
    const auto target = targets().find(key.name);
    Targets wanted = target == targets().end() ? Targets{} : target->second;
    if (key.name == "tissue.preset") {
      // The first preset's uniform values are the default ones.
      wanted = {"field.preset"};
    }
    seen.insert(key.name);
    EXPECT_EQ(changed(options_of(pair.before), options_of(pair.after)), wanted);
  }
  for (const auto& [name, options] : targets())
    EXPECT_TRUE(seen.contains(name)) << name << " is no key any more";
}

TEST(SolverOptions, NumbersArriveInSiUnits) {
  const SceneFolder folder;
  int count = 0;
  for (const Key& key : keys()) {
    const auto target = targets().find(key.name);
    if (key.kind != Kind::number || target == targets().end()) continue;
    const Pair pair = scenes_of(folder, key);
    const double factor = key.unit == "mm"       ? 1e-3
                          : key.unit == "kPa"    ? 1e3
                          : key.unit == "kPa/mm" ? 1e6
                                                 : 1;
    for (const std::string& option : target->second)
      if (option != "field.uniform") {
        EXPECT_NEAR(
            std::stod(options_of(pair.after).at(option)) / (factor * pair.value.get<double>()), 1,
            1e-9)
            << key.name << " as " << option;
        ++count;
      }
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
  EXPECT_EQ(options_of(scene).at("drive.points"), "every;point;");
}

}  // namespace
}  // namespace hyperex::session
