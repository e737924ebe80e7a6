// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/scene_source.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "hyperex/core/error.hpp"
#include "hyperex/scene/given_text.hpp"
#include "hyperex/scene/keys.hpp"
#include "hyperex/scene/override.hpp"
#include "hyperex/scene/scene_text.hpp"
#include "hyperex/scene/variant_names.hpp"

namespace hyperex::session {
namespace {
using nlohmann::json;

/// A key and the position within its value: "tissue.region" and "[0].young_factor".
struct PartName {
  std::string key, below;
};

PartName part_name(const std::string& name) {
  const auto bracket = name.find('[');
  if (bracket == std::string::npos) return {name, ""};
  return {name.substr(0, bracket), name.substr(bracket)};
}

/// `list` with another value at `below`: "[0]" or "[0].young_factor".
json with_part(json list, const PartName& name, const json& value) {
  const auto wrong = [&](const std::string& expected) {
    return InputError(InputProblem{{}, 0, name.key + name.below, "", expected});
  };
  const auto close = name.below.find(']');
  if (close == std::string::npos)
    throw wrong("a part of a list, as in tissue.region[0].young_factor");
  const std::size_t index = std::strtoul(name.below.c_str() + 1, nullptr, 10);
  if (!list.is_array() || index >= list.size())
    throw wrong("a place in the list, which has " +
                std::to_string(list.is_array() ? list.size() : 0) + " from 0 on");
  const std::string column = name.below.substr(close + 1);
  if (column.empty()) {
    list[index] = value;
  } else {
    if (column[0] != '.' || !list[index].is_object())
      throw wrong("a column, as in [0].young_factor");
    list[index][column.substr(1)] = value;
  }
  return list;
}

const scene::Key& known_key(const std::string& name) {
  if (const scene::Key* key = scene::find_key(name)) return *key;
  throw InputError(InputProblem{{}, 0, name, "", scene::unknown_key(name)});
}

json parsed(const Value& value) {
  return json::parse(value.json());
}

/// The block of this name; appended where there is none.
json& block_of(std::vector<json>& blocks, const std::string& name) {
  for (json& block : blocks)
    if (scene::name_of_block(block) == name) return block;
  blocks.push_back({{"name", name}});
  return blocks.back();
}

const scene::Scene* variant_of(const scene::Scene& scene, const std::string& name) {
  for (const scene::Variant& variant : scene.variants)
    if (variant.name == name) return &variant.scene;
  return nullptr;
}

/// The problem's key without its place among the variants: "tissue.young_kpa" of set()'s own, else
/// "variant weak: tissue.young_kpa".
std::string named_by_variant(const std::string& key, const std::string& text) {
  constexpr std::string_view start = "variant[";
  const auto close = key.find(']');
  if (!key.starts_with(start) || close == std::string::npos) return key;
  const std::vector<json> blocks = scene::variant_blocks(text);
  const std::size_t number = std::strtoul(key.c_str() + start.size(), nullptr, 10);
  if (number >= blocks.size()) return key;
  const std::string name = scene::name_of_block(blocks[number]);
  const std::string own = key.substr(std::min(close + 2, key.size()));
  if (name == kChanged && !own.empty()) return own;
  return "variant " + name + (own.empty() ? "" : ": " + own);
}

/// The error of a text that the program made, without places in it.
InputError by_name(const InputError& error, const std::filesystem::path& file,
                   const std::string& text) {
  if (error.problems().empty()) return error;
  std::vector<InputProblem> problems = error.problems();
  for (InputProblem& problem : problems) {
    if (problem.file != file) continue;
    problem.file.clear();
    problem.line = 0;
    problem.key = named_by_variant(problem.key, text);
  }
  return InputError(problems);
}

/// The places of keys whose values are as before; those of others are empty.
void keep_places(const scene::Scene& before, const std::string& changed,
                 std::map<std::string, scene::Origin>& places) {
  for (auto& [key, place] : places) {
    const auto found = before.origins.find(key);
    const bool is_new =
        key == changed ||
        (!changed.empty() && (key.starts_with(changed + ".") || key.starts_with(changed + "[")));
    place = found == before.origins.end() || is_new ? scene::Origin{} : found->second;
  }
}

/// The same of a scene and of its variants, of which the one called `variant` is new.
void keep_places(const scene::Scene& before, const std::string& changed, const std::string& variant,
                 scene::Scene& now) {
  keep_places(before, changed, now.origins);
  for (scene::Variant& own : now.variants) {
    const scene::Scene* known = own.name == variant ? nullptr : variant_of(before, own.name);
    keep_places(known ? *known : before, changed, own.scene.origins);
    if (known) continue;
    for (auto& [key, place] : own.scene.origins)
      if (own.changes.contains(key.substr(0, key.find('[')))) place = {};
  }
}

}  // namespace

bool is_variant_key(const std::string& key) {
  return scene::may_vary(part_name(key).key);
}

SceneSource::SceneSource(scene::Scene scene) : scene_(std::move(scene)), given_(scene_.given) {}

SceneSource::SceneSource(scene::GivenFace given, const Changes& changes)
    : given_(std::move(given)) {
  // Placeholders, which the given face and motion replace.
  text_ = scene::with_value("", "scan.file", "embedded");
  text_ = scene::with_value(text_, "motion.file", "embedded");
  for (const auto& [key, value] : changes)
    text_ = scene::with_value(text_, known_key(key).name, parsed(value));
  read();
}

void SceneSource::replace(scene::Scene scene) {
  scene_ = std::move(scene);
  text_.clear();
}

std::string SceneSource::text_now() const {
  return text_.empty() ? scene::given_text(scene_) : text_;
}

void SceneSource::read(const std::string& changed, const std::string& variant) {
  const scene::Scene before = std::move(scene_);
  try {
    scene_ = scene::read_scene_text(text_, before.file);
  } catch (const InputError& error) {
    throw by_name(error, before.file, text_);
  }
  keep_places(before, changed, variant, scene_);
  scene_.kept = before.kept;
  if (!given_.scan) return;
  scene_.given = given_;
  scene_.scan.source = {false, given_.scan->file};
  scene_.motion.source = {false, given_.motion->source};
}

SceneSource SceneSource::with_value(const std::string& key, const Value& value) const {
  SceneSource next = *this;
  next.text_ = scene::with_value(text_now(), known_key(key).name, parsed(value));
  next.read(known_key(key).name);
  return next;
}

SceneSource SceneSource::with_variant(const std::string& name, const Changes& changes) const {
  SceneSource next = *this;
  next.text_ = text_now();
  std::vector<json> blocks = scene::variant_blocks(next.text_);
  json& block = block_of(blocks, name);
  block = {{"name", name}};
  for (const auto& [key, value] : changes)
    scene::put_value(block, known_key(key).name, parsed(value));
  next.text_ = scene::with_variants(next.text_, blocks);
  next.read("", name);
  return next;
}

SceneSource SceneSource::with_change(const std::string& name, const std::string& key,
                                     const Value& value) const {
  const PartName part = part_name(key);
  const scene::Key& found = known_key(part.key);
  json whole = parsed(value);
  if (!part.below.empty()) {
    const scene::Scene* variant = variant_of(scene_, name);
    whole = with_part(found.get(variant ? *variant : scene_), part, whole);
  }
  SceneSource next = *this;
  next.text_ = text_now();
  std::vector<json> blocks = scene::variant_blocks(next.text_);
  scene::put_value(block_of(blocks, name), part.key, whole);
  next.text_ = scene::with_variants(next.text_, blocks);
  next.read("", name);
  return next;
}

}  // namespace hyperex::session
