// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/idle_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

#include "hyperex/scene/keys.hpp"
#include "hyperex/session/drive_choice.hpp"

namespace hyperex::session {
namespace {

/// Whether a condition holds for the scene or for a variant.
template <class Condition>
bool holds_somewhere(const scene::Scene& scene, const Condition& holds) {
  return holds(scene) || std::ranges::any_of(scene.variants, [&](const scene::Variant& variant) {
           return holds(variant.scene);
         });
}

bool is_given(const scene::Scene& scene, const std::string& key) {
  return scene.origins.contains(key) ||
         std::ranges::any_of(scene.variants, [&](const scene::Variant& variant) {
           return variant.changes.contains(key);
         });
}

/// Names the keys of a kind that the scene or a variant gives; nothing where none is given. `why`:
/// "tissue.strain is not \"finite\"".
template <class OfKind>
std::optional<Note> idle_keys_warning(const scene::Scene& scene, const char* id,
                                      const OfKind& of_kind, const char* why) {
  std::vector<std::string> idle;
  for (const scene::Key& key : scene::keys())
    if (of_kind(key) && is_given(scene, key.name)) idle.push_back(key.name);
  if (idle.empty()) return std::nullopt;
  return make_warning(id, fmt::format("without effect, as {}: {}", why, fmt::join(idle, ", ")));
}

bool muscles_drive_all(const scene::Scene& scene) {
  constexpr auto muscles = simulate::DriveBy::muscles;
  return drive_choice(scene).by == muscles &&
         std::ranges::all_of(scene.variants, [](const scene::Variant& variant) {
           return variant.scene.drive.by == muscles;
         });
}

}  // namespace

std::optional<Note> idle_law_warning(const scene::Scene& scene) {
  if (holds_somewhere(
          scene, [](const scene::Scene& s) { return s.model.strain == simulate::Strain::finite; }))
    return std::nullopt;
  return idle_keys_warning(
      scene, "law.idle",
      [](const scene::Key& key) { return key.only_where == fem::Hyperelastic::only_where; },
      "tissue.strain is not \"finite\"");
}

std::optional<Note> idle_region_warning(const scene::Scene& scene) {
  if (holds_somewhere(scene, [](const scene::Scene& s) {
        return s.region.measured != simulate::Measured::none;
      }))
    return std::nullopt;
  return idle_keys_warning(
      scene, "region.idle",
      [](const scene::Key& key) { return key.only_where == simulate::RegionOptions::only_where; },
      "region.measured is \"none\"");
}

std::optional<Note> idle_support_warning(const scene::Scene& scene) {
  if (!muscles_drive_all(scene)) return std::nullopt;
  return idle_keys_warning(
      scene, "support.idle",
      [](const scene::Key& key) { return key.only_where == simulate::kNotByMuscles; },
      "muscles drive the face");
}

}  // namespace hyperex::session
