// SPDX-License-Identifier: GPL-3.0-or-later
// Writes docs/scene.md from the table of keys.
#include <fmt/format.h>

#include "hyperex/scene/keys.hpp"
#include "hyperex/scene/variant_presets.hpp"

namespace hyperex::scene {
namespace {

const char* const introduction = R"(# The scene file

<!-- Made by `hyperex scene-reference > docs/scene.md`; the text stands beside the options,
     in src/hyperex/scene/scene.hpp, simulate/options.hpp and where these refer to. -->

A scene says what one run needs, in [TOML](https://toml.io). Only the keys marked *required* must be
there; the smallest scene is

```toml
[scan]
file = "embedded"

[motion]
file = "embedded"
```

* **Units** are in the names of the keys: `_mm`, `_s`, `_kpa`.
* **Paths** are relative to the scene file.
* **On the command line** any key can be overridden: `hyperex run scene.toml --out DIR
  --set time.step_s=0.001 --set scan.file=my.ply`. The last one wins. Values are written as in the
  file, lists as `'drive.points=["a", "b"]'`; text needs no quotes. Paths are then relative to the
  current folder.
* **Mistakes** (unknown keys, wrong types, numbers out of range or not finite, missing files) are
  reported all at once, with file, line, key, value and what was expected; nothing is run.
* **The options used**, defaults included, are in `options` of a run's `summary.json`.
)";

std::string type_of(const KeyInfo& key) {
  switch (key.kind) {
    case Kind::flag:
      return "true or false";
    case Kind::integer:
      return "integer";
    case Kind::number:
      return "number";
    case Kind::numbers:
      return "list of numbers";
    case Kind::text:
    case Kind::choice:
      return "text";
    case Kind::path:
      return "path";
    case Kind::names:
      return "list of names";
    case Kind::places:
      return "list of places";
    case Kind::factors:
      return "table of numbers";
    case Kind::rows:
      break;
  }
  return "tables";
}

std::string code(const std::string& text) {
  return "`" + text + "`";
}

std::string allowed(const KeyInfo& key) {
  std::string text;
  const auto add = [&](const std::string& more) { text += (text.empty() ? "" : "; ") + more; };
  if (key.kind == Kind::factors) {
    std::string names;
    for (const auto& word : key.choices) names += (names.empty() ? "" : ", ") + code(word);
    return names + "; each " + key.range.text();
  }
  for (const auto& word : key.choices) add(code('"' + word + '"'));
  if (key.kind == Kind::integer || key.kind == Kind::number) add(key.range.text());
  if (key.kind == Kind::numbers)
    add(fmt::format("{} to {}, rising, each {}", key.least, key.most, key.range.text()));
  if (key.kind == Kind::names && key.least > 0) add(fmt::format("none, or {} or more", key.least));
  if (key.kind == Kind::path) add("an existing file");
  if (key.kind == Kind::text && key.least > 0) add("not empty");
  return text;
}

std::string row(const std::string& name, const KeyInfo& key, const std::string& standard) {
  return fmt::format("| {} | {} | {} | {} | {} | {} |\n", code(name), type_of(key), key.unit.name,
                     standard, allowed(key), key.description);
}

std::string default_text(const Key& key) {
  if (key.required) return "*required*";
  const nlohmann::json value = default_of(key);
  if (!key.scene_default.empty()) return code(value.dump()) + ", see its meaning";
  if (key.kind == Kind::rows || (key.kind == Kind::path && value == "")) return "";
  std::string text;
  if (!value.is_array()) return code(value.dump());
  for (const auto& item : value) text += (text.empty() ? "" : ", ") + item.dump();
  return code("[" + text + "]");
}

std::string variants_text() {
  std::string may;
  for (const std::string& section : variant_sections()) may += "`[" + section + "]`, ";
  std::string presets;
  for (const VariantPreset& preset : variant_presets())
    presets += (presets.empty() ? "" : ", ") + code(preset.name);
  return fmt::format(
      "\n## [[variant]]\n"
      "The same face and motion once more with something changed, as often as wanted:\n"
      "```toml\n[[variant]]\nname = \"stiffer\"               # also its folder under variants/\n"
      "tissue = {{ young_kpa = 400 }}    # any key of {}or motion.gain\n"
      "preset = \"palsy_partial_R\"     # in the place of keys, or beside them\n```\n"
      "A `preset` stands for keys of its own, which those of the variant replace, and names "
      "a variant without a `name` (`hyperex presets` has them with their sources): {}.\n\n"
      "A run simulates the scene without a variant, called base, and all variants on one mesh, at "
      "once, and compares each with base: `report.html` shows them side by side, "
      "`variants_symmetry.png` S(t) "
      "of all and what each adds to "
      "xi_L - xi_R, `variants.png` where and how far the skin differs (greatest distance over "
      "time, "
      "mm). `variants.csv` has a row each: greatest displacement; greatest distance, the landmark "
      "nearest to it, and how far that place has moved at the peak of base, here and in base; "
      "there too, by area, the root mean square distance, the mean change of the "
      "displacement's length (below 0: moves less), the mean displacement of the face's left and "
      "right and its asymmetry; how far the corners of the mouth travel, how much that is changed "
      "and "
      "the band of the change (docs/muscles.md); what is added to xi_L - xi_R; share of the "
      "summed squared distance "
      "within 25 mm of the outline of the lips; lag (ms) and hysteresis of a response point behind "
      "a "
      "driven one (docs/symmetry.md), left out where the motion does not come back; and the "
      "integral of |xi_L - xi_R| over time.\n",
      may, presets);
}

}  // namespace

std::string reference_markdown() {
  std::string page = introduction;
  for (const Section& section : sections()) {
    page += section.name.empty() ? "\n## Top level\n" : "\n## [" + section.name + "]\n";
    page += section.description +
            "\n\n| key | type | unit | default | allowed | meaning |\n"
            "|---|---|---|---|---|---|\n";
    for (const Key& key : keys()) {
      if (section_of(key.name) != section.name) continue;
      const std::string name =
          section.name.empty() ? key.name : key.name.substr(section.name.size() + 1);
      page += row(key.kind == Kind::rows ? "[[" + key.name + "]]" : name, key, default_text(key));
      for (const KeyInfo& column : key.columns)
        page += row("... " + column.name, column, column.required ? "*required*" : "");
    }
  }
  return page + variants_text();
}

}  // namespace hyperex::scene
