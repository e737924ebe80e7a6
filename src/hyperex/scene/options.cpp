// SPDX-License-Identifier: GPL-3.0-or-later
// What is said of a scene's values: in messages and in the echo of the options.
#include <cmath>

#include "hyperex/scene/keys.hpp"

namespace hyperex::scene {
using nlohmann::json;

std::string show(const json& value) {
  std::string text;
  if (value.is_number_float() && !std::isfinite(value.get<double>())) {
    const double number = value.get<double>();
    text = std::isnan(number) ? "nan" : number > 0 ? "inf" : "-inf";
  } else if (value.is_array()) {
    for (const json& item : value) {
      text += (text.empty() ? "" : ", ") + show(item);
      if (text.size() > 80) break;
    }
    text = "[" + text + "]";
  } else {
    text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  }
  constexpr std::size_t longest = 80;
  if (text.size() <= longest) return text;
  std::size_t cut = longest;  // not within a UTF-8 character
  while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xC0) == 0x80) --cut;
  return text.substr(0, cut) + "...";
}

namespace {
/// `value` of "drive.points", at `below` = "[2]" or "[0].landmark"; null where there is no such.
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
  for (const std::string& name : {whole, key})  // the more precise one last
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
