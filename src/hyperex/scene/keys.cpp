// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/keys.hpp"

#include <algorithm>

#include "hyperex/scene/fields.hpp"
#include "hyperex/tissue/field/presets.hpp"

namespace hyperex::scene {
namespace {

/// Makes a section for each struct in the scene.
class SectionMaker {
 public:
  template <class At>
  void option(const char* name, At at, const char*, const OptionDetails& details = {}) {
    using Value = std::remove_cvref_t<decltype(at(std::declval<Scene&>()))>;
    if constexpr (Described<Value>) {
      std::string section = details.key ? details.key : name + std::string(".");
      section.pop_back();
      const auto same = [&](const Section& other) { return other.name == section; };
      if (std::none_of(sections.begin(), sections.end(), same))
        sections.push_back({section, Value::about});
    }
  }

  std::vector<Section> sections{{"", Scene::about}};
};

std::size_t place_of(const Key& key) {
  const std::string name = section_of(key.name);
  const auto section = std::find_if(sections().begin(), sections().end(),
                                    [&](const Section& one) { return one.name == name; });
  return std::size_t(section - sections().begin());
}

/// A tissue parameter that is not given has the preset's value, or the default. The echo shows the
/// value that is used.
void show_used_tissue(Key& key) {
  for (int p = 0; p < tissue::parameter_count; ++p)
    if (key.name == "tissue." + tissue::parameter_info(p).key)
      key.get = [p, unit = key.unit](const Scene& scene) -> nlohmann::json {
        const std::optional<double>& given = scene.tissue.uniform[std::size_t(p)];
        return unit.from_si(given ? *given
                                  : tissue::uniform_parameters(scene.tissue)[std::size_t(p)]);
      };
}

}  // namespace

const std::vector<Section>& sections() {
  static const std::vector<Section> all = [] {
    SectionMaker maker;
    Scene::describe(maker);
    return maker.sections;
  }();
  return all;
}

const std::vector<Key>& keys() {
  static const std::vector<Key> all = [] {
    std::vector<Key> table = keys_of<Scene>();
    for (Key& key : table) show_used_tissue(key);
    std::stable_sort(table.begin(), table.end(),
                     [](const Key& a, const Key& b) { return place_of(a) < place_of(b); });
    return table;
  }();
  return all;
}

bool needs_displacement(const std::string& key, const nlohmann::json& value) {
  if (key == "region.measured") return value != "none";
  return key.starts_with("support.") && key.ends_with("_kpa_per_mm");
}

bool decides_the_drive(const std::string& key, const nlohmann::json& value) {
  return key == "drive.by" || needs_displacement(key, value);
}

nlohmann::json default_of(const Key& key) {
  if (key.scene_default.empty()) return key.get(Scene{});
  if (key.kind == Kind::flag) return key.scene_default == "true";
  return key.scene_default;
}

const Key* find_key(const std::string& name) {
  for (const Key& key : keys())
    if (key.name == name) return &key;
  return nullptr;
}

}  // namespace hyperex::scene
