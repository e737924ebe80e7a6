// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/idle_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "hyperex/scene/keys.hpp"

namespace hyperex::session {
namespace {

/// Names the given keys that apply `only_where` a condition holds, if neither the scene nor a
/// variant meets it. `why`: "tissue.strain is not \"finite\"".
template <class Condition>
std::optional<Note> idle_keys_warning(const scene::Scene& scene, const char* id,
                                      std::string_view only_where, const Condition& holds,
                                      const char* why) {
  if (holds(scene) || std::ranges::any_of(scene.variants, [&](const scene::Variant& variant) {
        return holds(variant.scene);
      }))
    return std::nullopt;
  std::vector<std::string> idle;
  for (const scene::Key& key : scene::keys())
    if (key.only_where == only_where && scene.origins.contains(key.name)) idle.push_back(key.name);
  if (idle.empty()) return std::nullopt;
  return make_warning(id, fmt::format("without effect, as {}: {}", why, fmt::join(idle, ", ")));
}

}  // namespace

std::optional<Note> idle_law_warning(const scene::Scene& scene) {
  return idle_keys_warning(
      scene, "law.idle", fem::Hyperelastic::only_where,
      [](const scene::Scene& s) { return s.model.strain == simulate::Strain::finite; },
      "tissue.strain is not \"finite\"");
}

std::optional<Note> idle_region_warning(const scene::Scene& scene) {
  return idle_keys_warning(
      scene, "region.idle", simulate::RegionOptions::only_where,
      [](const scene::Scene& s) { return s.region.measured != simulate::Measured::none; },
      "region.measured is \"none\"");
}

}  // namespace hyperex::session
