// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/variant_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "hyperex/scene/keys.hpp"

namespace hyperex::scene {
namespace {

constexpr std::string_view kPlain = " -_.", kAwkward = ",;:+=%&'()[]";

bool is_alphanumeric(unsigned char c) {
  return c < 128 && std::isalnum(c);
}

}  // namespace

const std::vector<std::string>& variant_sections() {
  static const std::vector<std::string> sections = {"tissue",  "support", "drive",
                                                    "muscles", "region",  "surgery"};
  return sections;
}

bool may_vary(const std::string& key) {
  const auto& sections = variant_sections();
  // Variants respond to the forces found for the scene's muscles, so that these must be the same.
  if (key == "muscles.file" || key == "muscles.without" || key == "muscles.shape_prior")
    return false;
  return key == "motion.gain" ||
         std::find(sections.begin(), sections.end(), section_of(key)) != sections.end();
}

std::string what_may_vary() {
  std::string list;
  for (const auto& section : variant_sections()) list += "[" + section + "], ";
  return list + "or motion.gain";
}

bool is_variant_name(const std::string& name) {
  return name.size() <= 100 && std::any_of(name.begin(), name.end(), is_alphanumeric) &&
         std::all_of(name.begin(), name.end(), [](char c) {
           return is_alphanumeric(static_cast<unsigned char>(c)) ||
                  kPlain.find(c) != std::string_view::npos ||
                  kAwkward.find(c) != std::string_view::npos;
         });
}

std::string expected_variant_name(const nlohmann::json& name) {
  if (name.is_null()) return "a name in quotes, required (a preset gives its own)";
  if (!name.is_string() || !is_variant_name(name.get<std::string>()))
    return "a name of letters, digits, spaces and any of -_.,;:+=%&'()[], at most 100, a letter or "
           "digit among them";
  return name == "base" ? "another name, as \"base\" is the scene without a variant" : "";
}

std::string name_of_block(const nlohmann::json& block) {
  for (const char* key : {"name", "preset"})
    if (block.is_object() && block.contains(key) && block[key].is_string()) return block[key];
  return "";
}

std::string variant_folder(const std::string& name, const std::vector<Variant>& others) {
  std::string folder;
  for (const char c : name) {
    if (c != ' ' && c != '_' && kAwkward.find(c) == std::string_view::npos)
      folder += c;
    else if (!folder.ends_with('_'))
      folder += '_';
  }
  // Removes dots at both ends: a leading dot hides a folder, and some systems remove a trailing
  // one. The name has at least one letter or digit.
  folder.erase(folder.find_last_not_of("_.") + 1);
  folder.erase(0, folder.find_first_not_of("_."));
  const auto taken = [&](const std::string& text) {
    return std::any_of(others.begin(), others.end(),
                       [&](const Variant& other) { return other.folder == text; });
  };
  std::string own = folder;
  for (int n = 2; taken(own); ++n) own = fmt::format("{}-{}", folder, n);
  return own;
}

}  // namespace hyperex::scene
