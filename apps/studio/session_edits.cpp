// SPDX-License-Identifier: GPL-3.0-or-later
// Changes of the scene, and its history.
#include <fmt/format.h>

#include <algorithm>

#include "hyperex/core/error.hpp"
#include "hyperex/scene/keys.hpp"
#include "hyperex/scene/scene_text.hpp"
#include "hyperex/session/drive_choice.hpp"
#include "scene_files.hpp"
#include "session.hpp"

namespace hyperex::studio {

namespace {

constexpr std::size_t kMostSteps = 500;

bool adds_volume(const json& regions) {
  return regions.is_array() && std::ranges::any_of(regions, [](const json& region) {
           return region.is_object() && region.contains("volume_ml") &&
                  region["volume_ml"].is_number() && region["volume_ml"] != 0;
         });
}

/// Whether the changes need forces that drive the face.
bool need_muscles(const json& changes) {
  for (const auto& [key, value] : changes.items()) {
    if (key == "tissue.region" && adds_volume(value)) return true;
    if ((key.rfind("muscles.", 0) == 0 || key == "surgery.bone") && !value.is_null() &&
        !(value.is_array() && value.empty()))
      return true;
  }
  return false;
}

/// Sets a key in the block of a variant; null removes it.
void set_in_block(json& block, const std::string& key, const json& value) {
  const std::string section = scene::section_of(key);
  const std::string name = section.empty() ? key : key.substr(section.size() + 1);
  json& table = section.empty() ? block : block[section];
  if (value.is_null() && table.is_object())
    table.erase(name);
  else if (!value.is_null())
    table[name] = value;
  if (!section.empty() && table.empty()) block.erase(section);
}

}  // namespace

std::vector<std::string> Session::known_paths() const {
  const scene::Scene committed = scene::read_scene_text(now_.text, now_.file);
  std::vector<std::string> known = paths_of(options_json(committed));
  for (const scene::Variant& variant : committed.variants)
    for (const std::string& path : paths_of(options_json(variant.scene))) known.push_back(path);
  return known;
}

void Session::apply(const std::string& text) {
  if (text != now_.text) budget_due_ = false;
  if (require_face().set_text(text))
    refresh_live();
  else
    make_face(text, face_->scene().file);
}

void Session::commit(const std::string& text) {
  apply(text);
  motion_due_ = true;
  if (text == now_.text) return;
  undo_.push_back(now_);
  if (undo_.size() > kMostSteps) undo_.erase(undo_.begin());
  redo_.clear();
  now_.text = text;
  saved_ = false;
  autosave();
  send_scene();
}

std::string Session::text_with_changes(const json& wanted, int face) {
  if (!wanted.is_object()) throw InputError("changes: expected keys and values");
  std::string text = now_.text;
  json changes = json::object();
  require_face();
  const scene::Scene committed = scene::read_scene_text(now_.text, now_.file);
  const std::vector<std::string> known = known_paths();
  for (const auto& [key, value] : wanted.items()) {
    if (!scene::find_key(key)) throw InputError(key + ": no key of a scene");
    changes[key] = with_uploads(key, value, uploads(), known);
  }
  if (need_muscles(changes) && session::drive_choice(committed).by != simulate::DriveBy::muscles)
    text = scene::with_value(text, "drive.by", "muscles");
  if (face == 0) {
    for (const auto& [key, value] : changes.items()) text = scene::with_value(text, key, value);
    return text;
  }
  std::vector<json> blocks = scene::variant_blocks(text);
  if (std::size_t(face) > blocks.size())
    throw InputError(fmt::format("face {}: there are {}", face, blocks.size() + 1));
  json& block = blocks[std::size_t(face) - 1];
  for (const auto& [key, value] : changes.items()) set_in_block(block, key, value);
  // A variant must change something; this change has no effect.
  if (block.size() == 1) block["motion"]["gain"] = values_of(committed)["motion.gain"];
  return scene::with_variants(text, blocks);
}

json Session::set(const json& fields) {
  const int face = fields.at("face");
  const std::string text = text_with_changes(fields.at("changes"), face);
  const bool following = live_ && !live_->ended();
  if (following) live_face_ = std::size_t(face);
  if (!fields.at("live").get<bool>()) {
    const std::string name = fields.value("name", "");
    commit(name.empty() ? text : text_with_name(text, std::size_t(face), name));
    return {{"superseded", false}};
  }
  if (!require_face().set_text(text)) return {{"superseded", false}};  // no new mesh during a drag
  if (following) {
    refresh_live();
    return {{"superseded", false}};
  }
  send_shape(std::size_t(face), fields.at("time_s"));
  return {{"superseded", false}};
}

json Session::undo(const json&) {
  step_history(undo_, redo_);
  return json::object();
}

json Session::redo(const json&) {
  step_history(redo_, undo_);
  return json::object();
}

void Session::step_history(std::vector<Step>& from, std::vector<Step>& to) {
  if (from.empty()) return;
  const Step step = from.back();
  apply(step.text);
  from.pop_back();
  to.push_back(now_);
  now_ = step;
  motion_due_ = true;
  saved_ = false;
  autosave();
  send_scene();
}

}  // namespace hyperex::studio
