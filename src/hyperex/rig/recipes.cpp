// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/rig/recipes.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/expression/arkit_names.hpp"
#include "hyperex/expression/correctives.hpp"
#include "hyperex/scene/keys.hpp"
#include "hyperex/scene/toml_values.hpp"

namespace hyperex::rig {
namespace {

namespace fs = std::filesystem;

constexpr double kMostWeight = 1.5;

scene::TomlValues values_of(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error))
    throw InputError({file, 0, "", "", "an existing file of recipes (TOML)"});
  try {
    return scene::parse_toml(read_file(file));
  } catch (const scene::TornToml& torn) {
    throw InputError({file, torn.line, "", "", "sound TOML (" + torn.why + ")"});
  }
}

bool is_name(const std::string& name) {
  return !name.empty() && std::ranges::all_of(name, [](unsigned char c) {
    return c == '_' || (c < 128 && std::isalnum(c));
  });
}

std::vector<std::string> weighted_shapes() {
  std::vector<std::string> shapes = expression::arkit_shapes();
  std::erase(shapes, "tongueOut");
  return shapes;
}

/// What is wrong with the recipes of a file, with their lines.
class Complaints {
 public:
  Complaints(fs::path file, const std::map<std::string, int>& lines)
      : file_(std::move(file)), lines_(lines) {}
  void add(const std::string& key, const std::string& value, const std::string& expected) {
    const auto line = lines_.find(key);
    problems_.push_back({file_, line == lines_.end() ? 0 : line->second, key, value, expected});
  }
  void refuse() const {
    if (!problems_.empty()) throw InputError(problems_);
  }

 private:
  fs::path file_;
  const std::map<std::string, int>& lines_;
  std::vector<InputProblem> problems_;
};

void read_weight(const std::string& name, const std::string& shape, const nlohmann::json& weight,
                 Recipe& recipe, Complaints& complaints) {
  const std::string key = name + "." + shape;
  const std::vector<std::string> known = weighted_shapes();
  if (std::ranges::find(known, shape) == known.end()) {
    const std::string near = scene::nearest(shape, known);
    complaints.add(key, "",
                   "one of ARKit's shapes, as jawOpen, but not tongueOut" +
                       (near.empty() ? "" : "; did you mean " + near + "?"));
  } else if (!weight.is_number() || !(weight.get<double>() >= 0) ||
             weight.get<double>() > kMostWeight) {
    complaints.add(key, weight.dump(), "a weight, 0 to 1.5");
  } else {
    recipe.weights.emplace_back(shape, weight.get<double>());
  }
}

std::vector<Recipe> read_file_of_recipes(const fs::path& file) {
  const scene::TomlValues values = values_of(file);
  Complaints complaints(file, values.lines);
  std::vector<Recipe> recipes;
  for (const auto& [name, shapes] : values.root.items()) {
    Recipe recipe{name, {}};
    if (!is_name(name) || expression::corrected_pair(name))
      complaints.add(name, "", "a name of letters, digits and underscores, and not of two shapes");
    else if (shapes.is_object() && shapes.empty())
      complaints.add(name, "", "at least one weight below [" + name + "], as jawOpen = 0.5");
    else if (!shapes.is_object())
      complaints.add(name, "", "a table of weights: [" + name + "], then jawOpen = 0.5 or others");
    else
      for (const auto& [shape, weight] : shapes.items())
        read_weight(name, shape, weight, recipe, complaints);
    recipes.push_back(std::move(recipe));
  }
  complaints.refuse();
  if (recipes.empty())
    throw InputError(
        {file, 0, "", "", "a table for each shape: [happy], then mouthSmileLeft = 0.8"});
  std::ranges::sort(recipes, {}, [&](const Recipe& one) {
    const auto line = values.lines.find(one.name);
    return line == values.lines.end() ? 0 : line->second;
  });
  return recipes;
}

}  // namespace

std::vector<Recipe> read_recipes(const std::vector<fs::path>& files) {
  std::vector<Recipe> all;
  for (const fs::path& file : files)
    for (Recipe& recipe : read_file_of_recipes(file)) {
      if (std::ranges::find(all, recipe.name, &Recipe::name) != all.end())
        throw InputError({file, 0, recipe.name, "", "a name that no file before has"});
      all.push_back(std::move(recipe));
    }
  return all;
}

std::vector<Recipe> without_eyes(std::vector<Recipe> recipes,
                                 const std::vector<std::string>& sides) {
  for (Recipe& recipe : recipes)
    std::erase_if(recipe.weights, [&](const auto& weight) {
      return weight.first.starts_with("eye") &&
             std::ranges::any_of(
                 sides, [&](const std::string& side) { return weight.first.ends_with(side); });
    });
  return recipes;
}

std::string probably_meant(const Recipe& recipe) {
  const std::vector<std::string>& known = expression::arkit_shapes();
  if (std::ranges::find(known, recipe.name) != known.end()) return "";
  const std::string near = scene::nearest(recipe.name, known);
  // A typing error hardly changes a name's length; blinkLeft is meant as it is.
  const auto longer = std::ptrdiff_t(near.size()) - std::ptrdiff_t(recipe.name.size());
  return std::abs(longer) <= 1 ? near : "";
}

}  // namespace hyperex::rig
