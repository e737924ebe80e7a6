// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hyperex/muscles/muscle_names.hpp"
#include "hyperex/scene/keys.hpp"

namespace hyperex::scene {

// Conversion of a value from and to JSON: one pair of functions for each type of member. Where
// `set_value` returns complaints, the member is unchanged. Relative paths are relative to `folder`.
struct Given {
  const KeyInfo& key;
  const nlohmann::json& value;
  const std::filesystem::path& folder;
};
using Complaints = std::vector<Complaint>;
using Place = std::array<double, 3>;
Complaints set_value(const Given& given, bool& member);
Complaints set_value(const Given& given, int& member);
Complaints set_value(const Given& given, double& member);
Complaints set_value(const Given& given, std::optional<double>& member);
Complaints set_value(const Given& given, std::string& member);
Complaints set_value(const Given& given, std::filesystem::path& member);
Complaints set_value(const Given& given, Source& member);
Complaints set_value(const Given& given, std::vector<double>& member);
Complaints set_value(const Given& given, std::vector<std::string>& member);
Complaints set_value(const Given& given, std::vector<Place>& member);
nlohmann::json get_value(const KeyInfo& key, bool member);
nlohmann::json get_value(const KeyInfo& key, int member);
nlohmann::json get_value(const KeyInfo& key, double member);
nlohmann::json get_value(const KeyInfo& key, const std::optional<double>& member);
nlohmann::json get_value(const KeyInfo& key, const std::string& member);
nlohmann::json get_value(const KeyInfo& key, const std::filesystem::path& member);
nlohmann::json get_value(const KeyInfo& key, const Source& member);
nlohmann::json get_value(const KeyInfo& key, const std::vector<double>& member);
nlohmann::json get_value(const KeyInfo& key, const std::vector<std::string>& member);
nlohmann::json get_value(const KeyInfo& key, const std::vector<Place>& member);

/// check_rows(): a list of tables, without their cells. check_factors(): a table { name = number }.
/// check_choice(): a choice; sets `place` to the index of the word.
Complaints check_rows(const Given& given);
/// The expected text for a wrong name in muscles.gain: "another name; did you mean side_R?".
/// `names`: all valid names, among which a misspelt one is searched.
std::string expected_gain(const std::string& name, const std::vector<std::string>& names,
                          const muscles::MuscleTable& table = muscles::muscle_template());
/// Factors of muscles; scenes have no other factors.
Complaints check_factors(const Given& given);
Complaints check_choice(const Given& given, std::size_t& place);

template <Worded Enum>
Complaints set_value(const Given& given, Enum& member) {
  std::size_t place = 0;
  Complaints complaints = check_choice(given, place);
  if (complaints.empty()) member = words_of(Enum{})[place].value;
  return complaints;
}
template <Worded Enum>
nlohmann::json get_value(const KeyInfo&, Enum member) {
  return std::string(word_of(member));
}

/// The last word means "no value".
template <Worded Enum>
Complaints set_value(const Given& given, std::optional<Enum>& member) {
  std::size_t place = 0;
  Complaints complaints = check_choice(given, place);
  const auto words = words_of(Enum{});
  if (complaints.empty())
    member = place < words.size() ? std::optional(words[place].value) : std::nullopt;
  return complaints;
}
template <Worded Enum>
nlohmann::json get_value(const KeyInfo& key, const std::optional<Enum>& member) {
  return member ? std::string(word_of(*member)) : key.choices.back();
}

template <class Row>
const std::vector<Field<Row>>& columns_of();

template <Described Row>
Complaints set_value(const Given& given, std::vector<Row>& member) {
  Complaints complaints = check_rows(given);
  if (!given.value.is_array()) return complaints;
  std::vector<Row> filled(given.value.size());
  for (std::size_t i = 0; i < filled.size(); ++i) {
    if (!given.value[i].is_object()) continue;
    for (const Field<Row>& column : columns_of<Row>()) {
      if (!given.value[i].contains(column.name)) continue;
      for (Complaint& complaint :
           column.set(filled[i], given.value[i][column.name], given.folder)) {
        complaint.below = "[" + std::to_string(i) + "]." + column.name + complaint.below;
        complaints.push_back(std::move(complaint));
      }
    }
  }
  if (complaints.empty()) member = std::move(filled);
  return complaints;
}
/// Leaves out optional cells that have their default values.
template <Described Row>
nlohmann::json get_value(const KeyInfo&, const std::vector<Row>& member) {
  auto list = nlohmann::json::array();
  for (const Row& row : member) {
    auto& entry = list.emplace_back(nlohmann::json::object());
    for (const Field<Row>& column : columns_of<Row>())
      if (auto cell = column.get(row); column.required || cell != column.get(Row{}))
        entry[column.name] = std::move(cell);
  }
  return list;
}

}  // namespace hyperex::scene
