// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Makers of table rows, one a kind of value. `at` gives the field of an options struct:
// [](auto& o) -> auto& { return o.time.step_s; }
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hyperex/scene/keys.hpp"

namespace hyperex::scene {

/// SI = value * times / over: two exact integers, so that 9 mm is 0.009 to the last bit.
struct Unit {
  std::string name;
  double times = 1, over = 1;
  double to_si(double value) const { return value * times / over; }
  double from_si(double si) const;  ///< rounded to 15 digits: 9 again
};

// Checks of a JSON value that do not depend on the struct it goes to.
std::vector<Complaint> check_number(const KeyInfo& info, const nlohmann::json& value);
std::vector<Complaint> check_numbers(const KeyInfo& info, const nlohmann::json& value);
std::vector<Complaint> check_names(const KeyInfo& info, const nlohmann::json& value);
std::vector<Complaint> check_text(const KeyInfo& info, const nlohmann::json& value);
std::vector<Complaint> check_file(const KeyInfo& info, const nlohmann::json& value,
                                  const std::filesystem::path& folder, bool folder_too = false);
std::vector<Complaint> check_places(const KeyInfo& info, const nlohmann::json& value);
/// What is expected in the place of an unknown name.
std::string one_of_names(const std::string& name, const std::vector<std::string>& names);
std::vector<Complaint> check_factors(const KeyInfo& info, const nlohmann::json& value);
std::vector<Complaint> check_rows(const KeyInfo& info, const nlohmann::json& value);
std::filesystem::path resolve(const std::filesystem::path& folder, const std::string& path);

inline nlohmann::json json_from_si(const Unit& unit, double si) {
  return unit.from_si(si);
}
inline nlohmann::json json_from_si(const Unit& unit, const std::optional<double>& si) {
  return si ? nlohmann::json(unit.from_si(*si)) : nlohmann::json();
}

template <class Owner, class At>
Field<Owner> number(std::string name, Unit unit, At at, Range range, std::string description) {
  Field<Owner> field{{.name = std::move(name),
                      .kind = Kind::number,
                      .unit = unit.name,
                      .range = range,
                      .description = std::move(description)}};
  field.set = [info = KeyInfo(field), unit, at](Owner& owner, const nlohmann::json& value,
                                                const std::filesystem::path&) {
    auto complaints = check_number(info, value);
    if (complaints.empty()) at(owner) = unit.to_si(value.template get<double>());
    return complaints;
  };
  field.get = [unit, at](const Owner& owner) { return json_from_si(unit, at(owner)); };
  return field;
}

/// A number that may be left out, into a std::optional<double>: for columns of rows.
template <class Owner, class At>
Field<Owner> maybe_number(std::string name, Unit unit, At at, Range range,
                          std::string description) {
  Field<Owner> field =
      number<Owner>(std::move(name), std::move(unit), std::move(at), range, std::move(description));
  field.optional = true;
  return field;
}

/// Places [x, y, z], into a vector of arrays of three.
template <class Owner, class At>
Field<Owner> places(std::string name, Unit unit, At at, std::string description) {
  Field<Owner> field{{.name = std::move(name),
                      .kind = Kind::places,
                      .unit = unit.name,
                      .description = std::move(description)}};
  field.set = [info = KeyInfo(field), unit, at](Owner& owner, const nlohmann::json& value,
                                                const std::filesystem::path&) {
    auto complaints = check_places(info, value);
    if (!complaints.empty()) return complaints;
    at(owner).clear();
    for (const auto& place : value)
      at(owner).push_back({unit.to_si(place[0].template get<double>()),
                           unit.to_si(place[1].template get<double>()),
                           unit.to_si(place[2].template get<double>())});
    return complaints;
  };
  field.get = [unit, at](const Owner& owner) {
    auto list = nlohmann::json::array();
    for (const auto& p : at(owner))
      list.push_back({unit.from_si(p[0]), unit.from_si(p[1]), unit.from_si(p[2])});
    return list;
  };
  return field;
}

/// A table { name = factor } of the names `choices`, into a vector of `Row` by its two members.
template <class Owner, class Row, class At>
Field<Owner> factors(std::string name, At at, std::string Row::*word, double Row::*factor,
                     std::vector<std::string> choices, Range range, std::string description) {
  Field<Owner> field{{.name = std::move(name),
                      .kind = Kind::factors,
                      .range = range,
                      .choices = std::move(choices),
                      .description = std::move(description)}};
  field.set = [info = KeyInfo(field), at, word, factor](Owner& owner, const nlohmann::json& value,
                                                        const std::filesystem::path&) {
    auto complaints = check_factors(info, value);
    if (!complaints.empty()) return complaints;
    at(owner).clear();
    for (const auto& [key, number] : value.items()) {
      Row row;
      row.*word = key;
      row.*factor = number.template get<double>();
      at(owner).push_back(std::move(row));
    }
    return complaints;
  };
  field.get = [at, word, factor](const Owner& owner) {
    auto table = nlohmann::json::object();
    for (const Row& row : at(owner)) table[row.*word] = row.*factor;
    return table;
  };
  return field;
}

/// A column that may be left out: its default then holds, and is not echoed.
template <class Row>
Field<Row> optional(Field<Row> column) {
  column.optional = true;
  return column;
}

template <class Owner, class At>
Field<Owner> integer(std::string name, At at, Range range, std::string description) {
  Field<Owner> field{{.name = std::move(name),
                      .kind = Kind::integer,
                      .range = range,
                      .description = std::move(description)}};
  field.set = [info = KeyInfo(field), at](Owner& owner, const nlohmann::json& value,
                                          const std::filesystem::path&) {
    auto complaints = check_number(info, value);
    if (complaints.empty()) at(owner) = value.template get<int>();
    return complaints;
  };
  field.get = [at](const Owner& owner) -> nlohmann::json { return at(owner); };
  return field;
}

/// Strictly rising numbers.
template <class Owner, class At>
Field<Owner> numbers(std::string name, Unit unit, At at, Range range, std::size_t least,
                     std::size_t most, std::string description) {
  Field<Owner> field{{.name = std::move(name),
                      .kind = Kind::numbers,
                      .unit = unit.name,
                      .range = range,
                      .least = least,
                      .most = most,
                      .description = std::move(description)}};
  field.set = [info = KeyInfo(field), unit, at](Owner& owner, const nlohmann::json& value,
                                                const std::filesystem::path&) {
    auto complaints = check_numbers(info, value);
    if (!complaints.empty()) return complaints;
    at(owner).clear();
    for (const auto& item : value) at(owner).push_back(unit.to_si(item.template get<double>()));
    return complaints;
  };
  field.get = [unit, at](const Owner& owner) {
    auto list = nlohmann::json::array();
    for (const double si : at(owner)) list.push_back(unit.from_si(si));
    return list;
  };
  return field;
}

/// A time, or two rising ones [from, to].
template <class Owner, class At>
Field<Owner> time_or_stretch(std::string name, Unit unit, At at, Range range,
                             std::string description) {
  auto field =
      numbers<Owner>(std::move(name), std::move(unit), at, range, 0, 2, std::move(description));
  field.set = [set = field.set](Owner& owner, const nlohmann::json& value,
                                const std::filesystem::path& folder) {
    return set(owner, value.is_number() ? nlohmann::json::array({value}) : value, folder);
  };
  return field;
}

template <class Owner, class At>
Field<Owner> flag(std::string name, At at, std::string description) {
  Field<Owner> field{
      {.name = std::move(name), .kind = Kind::flag, .description = std::move(description)}};
  field.set = [info = KeyInfo(field), at](Owner& owner, const nlohmann::json& value,
                                          const std::filesystem::path&) {
    std::vector<Complaint> complaints;
    if (value.is_boolean())
      at(owner) = value.template get<bool>();
    else
      complaints.push_back({"", value, info.expected()});
    return complaints;
  };
  field.get = [at](const Owner& owner) -> nlohmann::json { return at(owner); };
  return field;
}

template <class Owner, class At>
Field<Owner> text(std::string name, At at, std::size_t least, std::string description) {
  Field<Owner> field{{.name = std::move(name),
                      .kind = Kind::text,
                      .least = least,
                      .description = std::move(description)}};
  field.set = [info = KeyInfo(field), at](Owner& owner, const nlohmann::json& value,
                                          const std::filesystem::path&) {
    auto complaints = check_text(info, value);
    if (complaints.empty()) at(owner) = value.template get<std::string>();
    return complaints;
  };
  field.get = [at](const Owner& owner) -> nlohmann::json { return at(owner); };
  return field;
}

/// One of some words, each standing for a value of the field.
template <class Owner, class Value, class At>
Field<Owner> choice(std::string name, At at, std::vector<std::pair<std::string, Value>> words,
                    std::string description) {
  Field<Owner> field{
      {.name = std::move(name), .kind = Kind::choice, .description = std::move(description)}};
  for (const auto& word : words) field.choices.push_back(word.first);
  field.set = [info = KeyInfo(field), words, at](Owner& owner, const nlohmann::json& value,
                                                 const std::filesystem::path&) {
    const auto word = std::find_if(words.begin(), words.end(),
                                   [&](const auto& candidate) { return value == candidate.first; });
    std::vector<Complaint> complaints;
    if (word != words.end())
      at(owner) = word->second;
    else
      complaints.push_back({"", value, info.expected()});
    return complaints;
  };
  field.get = [words, at](const Owner& owner) -> nlohmann::json {
    for (const auto& word : words)
      if (word.second == at(owner)) return word.first;
    return nullptr;
  };
  return field;
}

/// A file that exists, or on demand a folder, into a std::filesystem::path.
template <class Owner, class At>
Field<Owner> path(std::string name, At at, std::string description, bool folder_too = false) {
  Field<Owner> field{
      {.name = std::move(name), .kind = Kind::path, .description = std::move(description)}};
  field.set = [info = KeyInfo(field), at, folder_too](Owner& owner, const nlohmann::json& value,
                                                      const std::filesystem::path& folder) {
    auto complaints = check_file(info, value, folder, folder_too);
    if (complaints.empty()) at(owner) = resolve(folder, value.template get<std::string>());
    return complaints;
  };
  field.get = [at](const Owner& owner) -> nlohmann::json { return at(owner).generic_string(); };
  return field;
}

/// A file that exists or the word "embedded", into a Source.
template <class Owner, class At>
Field<Owner> source(std::string name, At at, bool required, std::string description) {
  Field<Owner> field{{.name = std::move(name),
                      .kind = Kind::path,
                      .choices = {"embedded"},
                      .required = required,
                      .description = std::move(description)}};
  field.set = [info = KeyInfo(field), at](Owner& owner, const nlohmann::json& value,
                                          const std::filesystem::path& folder) {
    std::vector<Complaint> complaints;
    if (value == "embedded") {
      at(owner) = {true, {}};
      return complaints;
    }
    complaints = check_file(info, value, folder);
    if (complaints.empty()) at(owner) = {false, resolve(folder, value.template get<std::string>())};
    return complaints;
  };
  field.get = [at](const Owner& owner) -> nlohmann::json {
    return at(owner).embedded ? std::string("embedded") : at(owner).file.generic_string();
  };
  return field;
}

template <class Owner, class At>
Field<Owner> names(std::string name, At at, std::size_t least, std::string description) {
  Field<Owner> field{{.name = std::move(name),
                      .kind = Kind::names,
                      .least = least,
                      .description = std::move(description)}};
  field.set = [info = KeyInfo(field), at](Owner& owner, const nlohmann::json& value,
                                          const std::filesystem::path&) {
    auto complaints = check_names(info, value);
    if (complaints.empty()) at(owner) = value.template get<std::vector<std::string>>();
    return complaints;
  };
  field.get = [at](const Owner& owner) -> nlohmann::json { return at(owner); };
  return field;
}

/// Names, or the single word "all" into a flag beside them.
template <class Owner, class At, class AllAt>
Field<Owner> names_or_all(std::string name, At at, AllAt all_at, std::string description) {
  auto field = names<Owner>(std::move(name), at, 0, std::move(description));
  field.choices = {"all"};
  field.set = [info = KeyInfo(field), at, all_at](Owner& owner, const nlohmann::json& value,
                                                  const std::filesystem::path&) {
    std::vector<Complaint> complaints;
    const bool all = value == "all";
    if (!all) complaints = check_names(info, value);
    if (!complaints.empty()) return complaints;
    all_at(owner) = all;
    at(owner) = all ? std::vector<std::string>{} : value.template get<std::vector<std::string>>();
    return complaints;
  };
  field.get = [at, all_at](const Owner& owner) -> nlohmann::json {
    if (all_at(owner)) return "all";
    return at(owner);
  };
  return field;
}

/// An array of tables, [[name]], each filling one Row; columns are required unless optional.
template <class Owner, class Row, class At>
Field<Owner> rows(std::string name, At at, std::vector<Field<Row>> columns,
                  std::string description) {
  Field<Owner> field{
      {.name = std::move(name), .kind = Kind::rows, .description = std::move(description)}};
  for (auto& column : columns) {
    column.required = !column.optional;
    field.columns.push_back(column);
  }
  field.set = [info = KeyInfo(field), columns, at](Owner& owner, const nlohmann::json& value,
                                                   const std::filesystem::path& folder) {
    auto complaints = check_rows(info, value);
    if (!value.is_array()) return complaints;
    std::vector<Row> filled(value.size());
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (!value[i].is_object()) continue;
      for (const auto& column : columns) {
        if (!value[i].contains(column.name)) continue;
        for (auto& complaint : column.set(filled[i], value[i][column.name], folder)) {
          complaint.below = "[" + std::to_string(i) + "]." + column.name + complaint.below;
          complaints.push_back(std::move(complaint));
        }
      }
    }
    if (complaints.empty()) at(owner) = std::move(filled);
    return complaints;
  };
  field.get = [columns, at](const Owner& owner) {
    auto list = nlohmann::json::array();
    for (const Row& row : at(owner)) {
      auto& entry = list.emplace_back(nlohmann::json::object());
      for (const auto& column : columns)
        if (auto cell = column.get(row); !column.optional || cell != column.get(Row{}))
          entry[column.name] = std::move(cell);
    }
    return list;
  };
  return field;
}

}  // namespace hyperex::scene
