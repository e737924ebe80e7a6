// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/drive_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "hyperex/scene/keys.hpp"
#include "hyperex/session/idle_keys.hpp"

namespace hyperex::session {
using simulate::DriveBy;

namespace {

bool says_what_drives(const scene::Scene& scene) {
  return scene.origins.contains("drive.by");
}

bool a_variant_says_what_drives(const scene::Scene& scene) {
  return std::ranges::any_of(scene.variants, [](const scene::Variant& variant) {
    return variant.changes.contains("drive.by");
  });
}

/// The given keys that muscles do not use: of the scene, or of its variants where it has none.
struct KeysForDisplacement {
  std::vector<std::string> names;
  std::string variant;  ///< the first that gives one; empty: the scene does
};

KeysForDisplacement keys_for_displacement(const scene::Scene& scene) {
  KeysForDisplacement found;
  for (const scene::Key& key : scene::keys())
    if (scene.origins.contains(key.name) && scene::needs_displacement(key.name, key.get(scene)))
      found.names.push_back(key.name);
  for (const scene::Variant& variant : scene.variants) {
    if (!found.names.empty()) break;
    for (const auto& [key, value] : variant.changes.items())
      if (scene::needs_displacement(key, value)) found.names.push_back(key);
    if (!found.names.empty()) found.variant = variant.name;
  }
  return found;
}

std::optional<Note> by_key_warning(const scene::Scene& scene) {
  if (says_what_drives(scene) || drive_choice(scene).by != DriveBy::displacement)
    return std::nullopt;
  const auto [names, variant] = keys_for_displacement(scene);
  if (names.empty() || (!variant.empty() && a_variant_says_what_drives(scene))) return std::nullopt;
  const bool several = names.size() > 1;
  const bool measured = std::ranges::count(names, "region.measured") > 0;
  return make_warning(
      "drive.by_key",
      fmt::format("displacement drives the face, as {} {} given{}, which muscles do not use; say "
                  "drive.by = \"displacement\" to confirm this, or drive.by = \"muscles\"{}",
                  fmt::join(names, ", "), several ? "are" : "is",
                  variant.empty() ? "" : " in variant " + variant,
                  measured  ? " and region.measured = \"none\""
                  : several ? ", where they have no effect"
                            : ", where it has no effect"));
}

}  // namespace

Note DriveChoice::note() const {
  return make_note("drive.chosen", why);
}

DriveChoice drive_choice(const scene::Scene& scene) {
  const auto chosen = [](DriveBy by, const std::string& why) {
    return DriveChoice{by, fmt::format("driven by {}: {}", word_of(by), why)};
  };
  if (says_what_drives(scene)) return chosen(scene.drive.by, "the scene says so");
  const auto [keys, variant] = keys_for_displacement(scene);
  if (!keys.empty() && variant.empty())
    return chosen(scene.drive.by, keys.front() + " is given, which applies to displacement");
  if (scene.variants.empty())
    return chosen(DriveBy::muscles, "nothing in the scene says otherwise");
  if (scene.drive.by == DriveBy::muscles)
    return chosen(scene.drive.by, "its variants respond to the same forces");
  return chosen(scene.drive.by,
                keys.empty() || a_variant_says_what_drives(scene)
                    ? "a variant says so"
                    : fmt::format("{} is given in variant {}, which applies to displacement",
                                  keys.front(), variant));
}

std::vector<Note> drive_warnings(const scene::Scene& scene) {
  std::vector<Note> warnings;
  add(warnings, by_key_warning(scene));
  add(warnings, idle_region_warning(scene));
  add(warnings, idle_support_warning(scene));
  append(warnings, idle_keys_warnings(scene));
  return warnings;
}

}  // namespace hyperex::session
