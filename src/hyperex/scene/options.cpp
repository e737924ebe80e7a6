// SPDX-License-Identifier: GPL-3.0-or-later
// The options of a scene, for messages and the echo.
#include "hyperex/scene/keys.hpp"

namespace hyperex::scene {
using nlohmann::json;

namespace {
/// The part of `value` (of "drive.points", for example) at `below`, "[2]" or "[0].landmark"; null
/// where there is no such part.
json part_of(json value, std::string below) {
  const auto open = below.find('['), close = below.find(']');
  if (open == 0 && close != std::string::npos) {
    const std::size_t index = std::strtoul(below.c_str() + 1, nullptr, 10);
    if (!value.is_array() || index >= value.size()) return nullptr;
    value = json(value[index]);
    below.erase(0, close + 1);
  }
  if (below.empty()) return value;
  const std::string column = below.substr(1);
  return value.is_object() && value.contains(column) ? value[column] : json(nullptr);
}
}  // namespace

InputProblem problem_at(const Scene& scene, const std::string& key, const std::string& expected) {
  const std::string whole = key.substr(0, key.find('['));
  const Key* found = find_key(whole);
  const json value = found ? part_of(found->get(scene), key.substr(whole.size())) : json(nullptr);
  Origin origin{scene.file, 0};
  for (const std::string& name : {whole, key})  // the more precise one last, so that it wins
    if (const auto at = scene.origins.find(name); at != scene.origins.end()) origin = at->second;
  return {origin.file, origin.line, key, value.is_null() ? "" : show(value), expected};
}

json options_json(const Scene& scene) {
  json options = json::object();
  for (const Key& key : keys()) {
    const std::string section = section_of(key.name);
    if (section.empty())
      options[key.name] = key.get(scene);
    else
      options[section][key.name.substr(section.size() + 1)] = key.get(scene);
  }
  return options;
}

}  // namespace hyperex::scene
