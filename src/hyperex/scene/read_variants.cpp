// SPDX-License-Identifier: GPL-3.0-or-later
// [[variant]] of a scene.
#include <fmt/format.h>

#include "hyperex/scene/keys.hpp"
#include "hyperex/scene/scene_reader.hpp"
#include "hyperex/scene/values.hpp"
#include "hyperex/scene/variant_names.hpp"
#include "hyperex/scene/variant_presets.hpp"

namespace hyperex::scene {

std::map<std::string, json> SceneReader::changes_with_preset(const json& block,
                                                             const std::string& at) {
  const json given = block.value("preset", json());
  json own = block;
  own.erase("preset");
  std::map<std::string, json> changes = changes_of(own);
  if (given.is_null()) return changes;
  const VariantPreset* preset =
      given.is_string() ? find_variant_preset(given.get<std::string>()) : nullptr;
  if (!preset) {
    complain(in_file(at + ".preset"), at + ".preset", given,
             expected_preset(given.is_string() ? given.get<std::string>() : ""));
    return {};
  }
  changes.merge(changes_of(preset->changes));  // keys that are there stay: the variant's own
  return changes;
}

std::optional<std::string> SceneReader::name_of_variant(const json& block, const std::string& at) {
  const bool by_preset = !block.contains("name") && block.contains("preset");
  const std::string place = at + (by_preset ? ".preset" : ".name");
  const json name = block.value(by_preset ? "preset" : "name", json());
  const std::string expected = by_preset ? "" : expected_variant_name(name);
  if (!expected.empty()) {
    complain(in_file(name.is_null() ? at : place), place, name, expected);
    return std::nullopt;
  }
  for (const Variant& other : scene.variants)
    if (other.name == name)
      complain(in_file(place), place, name,
               by_preset ? "a name beside it, as another variant is called so"
                         : "a name that no other variant has");
  return name.get<std::string>();
}

void SceneReader::settle_variant(const json& block, const std::string& at) {
  if (!block.is_object()) {
    complain(in_file(at), at, block, "a table, [[variant]]");
    return;
  }
  const std::size_t wrong = problems.size();
  const std::map<std::string, json> changes = changes_with_preset(block, at);
  if (problems.size() > wrong) return;
  const std::optional<std::string> name = name_of_variant(block, at);
  if (!name) return;
  SceneReader varied = *this;
  varied.problems.clear();
  varied.scene.variants.clear();
  Variant variant;
  variant.name = *name;
  variant.folder = variant_folder(variant.name, scene.variants);
  variant.changes = json::object();
  for (const auto& [key, value] : changes) {
    // surgery.bone may be written as bone.
    const bool brief = key == "surgery.bone" && lines_.count(at + ".bone") > 0;
    const std::string own = at + "." + (brief ? "bone" : key);
    const bool of_preset = !lines_.count(own) && block.contains("preset");
    const std::string place = of_preset ? at + ".preset" : own;
    if (find_key(key) != nullptr && !may_vary(key)) {
      complain(in_file(place), place, value, "a key of what may vary: " + what_may_vary());
      continue;
    }
    varied.take(key, {value, in_file(place), false, scene.file.parent_path()});
    varied.lines_[key] = in_file(place).line;
    variant.changes[key] = value;
  }
  if (changes.empty())
    complain(in_file(at), at, nullptr,
             "at least one key that it changes, as in tissue.young_kpa = 400, or a preset");
  varied.fill();
  varied.check_together();
  for (InputProblem& problem : varied.problems) {
    problem.key = at + "." + problem.key;
    problems.push_back(std::move(problem));
  }
  variant.scene = std::move(varied.scene);
  scene.variants.push_back(std::move(variant));
}

void SceneReader::settle_variants() {
  if (variants_.is_null() || !problems.empty()) return;  // else each would repeat them
  if (!variants_.is_array()) {
    complain(in_file("variant"), "variant", nullptr, "tables, [[variant]]");
    return;
  }
  for (std::size_t i = 0; i < variants_.size(); ++i) {
    const std::size_t sound = scene.variants.size(), wrong = problems.size();
    settle_variant(variants_[i], fmt::format("variant[{}]", i));
    if (scene.variants.size() > sound) scene.variants.back().number = i;
    if (!left_out || problems.size() == wrong) continue;
    const std::vector<InputProblem> own(problems.begin() + std::ptrdiff_t(wrong), problems.end());
    left_out->push_back({i, name_of_block(variants_[i]), InputError(own).what()});
    problems.resize(wrong);
    scene.variants.resize(sound);
  }
}

}  // namespace hyperex::scene
