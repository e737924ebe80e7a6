// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>

#include "hyperex/core/files.hpp"
#include "hyperex/scene/keys.hpp"
#include "hyperex/scene/toml_values.hpp"
#include "hyperex/scene/variant_presets.hpp"
#include "hyperex/tissue/field/facial_regions.hpp"
#include "hyperex/tissue/field/presets.hpp"
#include "session.hpp"

namespace hyperex::studio {

namespace {

const char* kind_name(scene::Kind kind) {
  using enum scene::Kind;
  switch (kind) {
    case flag:
      return "flag";
    case integer:
      return "integer";
    case number:
      return "number";
    case numbers:
      return "numbers";
    case text:
      return "text";
    case choice:
      return "choice";
    case path:
      return "path";
    case names:
      return "names";
    case places:
      return "places";
    case factors:
      return "factors";
    case rows:
      return "rows";
  }
  return "";
}

/// A key, or a column of its tables.
json described(const scene::KeyInfo& key) {
  json out = {{"name", key.name},
              {"kind", kind_name(key.kind)},
              {"unit", key.unit.name},
              {"choices", key.choices},
              {"description", key.description}};
  if (key.range.least < key.range.most) {
    out["low"] = key.range.least;
    out["high"] = key.range.most;
    out["above_low"] = key.range.above_least;
    out["or_zero"] = key.range.or_zero;
  }
  for (const scene::KeyInfo& column : key.columns) out["columns"].push_back(described(column));
  return out;
}

json keys_json() {
  json out = json::array();
  for (const scene::Key& key : scene::keys()) {
    json one = described(key);
    one["default"] = scene::default_of(key);
    out.push_back(std::move(one));
  }
  return out;
}

json presets_json() {
  json out = json::array();
  for (const scene::VariantPreset& preset : scene::variant_presets())
    out.push_back({{"name", preset.name},
                   {"summary", preset.summary},
                   {"source", preset.source},
                   {"assumed", preset.assumed},
                   {"changes", preset.changes}});
  return out;
}

json tissues_json() {
  json out = json::array();
  for (const tissue::TissuePreset& preset : tissue::tissue_presets())
    if (const auto& factor = preset.factor[tissue::young])
      out.push_back({{"name", preset.name},
                     {"summary", preset.summary},
                     {"source", preset.source},
                     {"young_factor", *factor}});
  return out;
}

json regions_json() {
  json out = json::array();
  for (const tissue::FacialRegion& region : tissue::facial_regions())
    out.push_back({{"name", region.name}, {"meaning", region.meaning}});
  return out;
}

/// The work of a crashed session: its title or its scan's name, and its age; null where there is
/// none.
json rescued_json(const fs::path& folder) {
  const fs::path file = folder / "scene.toml";
  std::error_code error;
  if (folder.empty() || !fs::exists(file, error)) return nullptr;
  std::string title;
  try {
    const json root = scene::parse_toml(read_file(file)).root;
    title = root.value("title", "");
    if (title.empty() && root.contains("scan"))
      title = fs::path(root["scan"].value("file", "")).filename().string();
  } catch (const std::exception&) {
    // Opening it reports the error.
  }
  const auto age = fs::file_time_type::clock::now() - fs::last_write_time(file, error);
  return {{"title", title},
          {"seconds_ago", std::chrono::duration<double>(error ? age.zero() : age).count()}};
}

}  // namespace

bool Session::offers_rescued() const {
  const bool open = face_ && now_.file.parent_path() == options_.rescued;
  return keeps_rescued_ && !open;
}

json Session::hello(const json&) {
  face_sent_ = false;
  motion_due_ = face_ != nullptr;
  // A slider that was being dragged when the page closed is released.
  if (face_ && face_->text() != now_.text) apply(now_.text);
  return {{"program", options_.program},
          {"keys", keys_json()},
          {"presets", presets_json()},
          {"tissues", tissues_json()},
          {"regions", regions_json()},
          {"places",
           {{"started", options_.started.empty() ? json() : json(options_.started.filename())},
            {"autosave", offers_rescued() ? rescued_json(options_.rescued) : json()},
            {"folder", options_.save_into},
            {"save_into", options_.save_into},
            {"device", options_.device.empty() ? json() : json(options_.device)},
            {"open", face_ != nullptr}}}};
}

}  // namespace hyperex::studio
