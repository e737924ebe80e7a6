// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/idle_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

#include "hyperex/scene/keys.hpp"
#include "hyperex/session/drive_choice.hpp"

namespace hyperex::session {
using simulate::DriveBy;

namespace {

/// Whether a given key is without effect in the scene and in each of its variants.
template <class Act>
bool is_idle(const scene::Scene& scene, const std::string& key, const Act& act) {
  const bool of_scene = scene.origins.contains(key);
  if (of_scene && act(scene, drive_choice(scene).by)) return false;
  bool given = of_scene;
  for (const scene::Variant& variant : scene.variants) {
    if (!of_scene && !variant.changes.contains(key)) continue;
    if (act(variant.scene, variant.scene.drive.by)) return false;
    given = true;
  }
  return given;
}

std::optional<Note> warning_of(const std::vector<std::string>& idle, const char* id,
                               std::string_view why, const std::string& by = "") {
  if (idle.empty()) return std::nullopt;
  return make_warning(id, fmt::format("without effect, as {}: {}", why, fmt::join(idle, ", ")), by);
}

/// Names the idle keys among those that act `only_where` a condition holds.
template <class Act>
std::optional<Note> idle_keys_warning(const scene::Scene& scene, const char* id,
                                      std::string_view only_where, const Act& act,
                                      const char* why) {
  std::vector<std::string> idle;
  for (const scene::Key& key : scene::keys())
    if (key.only_where == only_where && is_idle(scene, key.name, act)) idle.push_back(key.name);
  return warning_of(idle, id, why);
}

}  // namespace

std::optional<Note> idle_law_warning(const scene::Scene& scene) {
  return idle_keys_warning(
      scene, "law.idle", fem::Hyperelastic::only_where,
      [](const scene::Scene& s, DriveBy) { return s.model.strain == simulate::Strain::finite; },
      "tissue.strain is not \"finite\"");
}

std::optional<Note> idle_region_warning(const scene::Scene& scene) {
  return idle_keys_warning(
      scene, "region.idle", simulate::RegionOptions::only_where,
      [](const scene::Scene& s, DriveBy) { return s.region.measured != simulate::Measured::none; },
      "region.measured is \"none\"");
}

std::optional<Note> idle_support_warning(const scene::Scene& scene) {
  return idle_keys_warning(
      scene, "support.idle", simulate::kNotByMuscles,
      [](const scene::Scene&, DriveBy drive) { return drive != DriveBy::muscles; },
      "muscles drive the face");
}

std::vector<Note> idle_keys_warnings(const scene::Scene& scene) {
  std::vector<Note> warnings;
  for (const IdleRule& rule : idle_rules()) {
    std::vector<std::string> idle;
    for (const std::string& key : rule.keys)
      if (is_idle(scene, key, rule.act)) idle.push_back(key);
    add(warnings, warning_of(idle, "keys.idle", rule.why, rule.by));
  }
  return warnings;
}

}  // namespace hyperex::session
