// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Makes keys of scene files from a struct that describes its options (core/describe.hpp).
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "hyperex/scene/values.hpp"

namespace hyperex::scene {

/// The name, unit, bounds and description of a key; its kind and allowed words are set later. The
/// prefixes come from the struct that holds the member. `about` is that struct's own description.
KeyInfo info_of(const std::string& member, const std::string& sentence,
                const OptionDetails& details, const std::string& key_prefix,
                const std::string& member_prefix, const std::string& about);

template <class Value>
constexpr Kind kind_of(const OptionDetails& details) {
  if (details.words[0]) return Kind::choice;
  if constexpr (std::is_same_v<Value, bool>)
    return Kind::flag;
  else if constexpr (std::is_same_v<Value, int>)
    return Kind::integer;
  else if constexpr (std::is_same_v<Value, double>)
    return Kind::number;
  else if constexpr (std::is_same_v<Value, std::optional<double>>)
    return Kind::number;
  else if constexpr (std::is_same_v<Value, std::string>)
    return Kind::text;
  else if constexpr (std::is_same_v<Value, std::filesystem::path>)
    return Kind::path;
  else if constexpr (std::is_same_v<Value, Source>)
    return Kind::path;
  else if constexpr (std::is_same_v<Value, std::vector<double>>)
    return Kind::numbers;
  else if constexpr (std::is_same_v<Value, std::vector<std::string>>)
    return Kind::names;
  else if constexpr (std::is_same_v<Value, std::vector<Place>>)
    return Kind::places;
  else if constexpr (requires(Value list) { list.size(); })
    return Kind::rows;
  else
    return Kind::choice;
}

/// The words of a choice, in the order of the enumeration. For an optional, the word for "no value"
/// comes last.
template <class Value>
std::vector<std::string> choices_of(const OptionDetails& details) {
  std::vector<std::string> choices;
  for (const char* word : details.words)
    if (word) choices.emplace_back(word);
  const auto add = [&](const auto& words) {
    for (const auto& word : words) choices.emplace_back(word.text);
  };
  if constexpr (Worded<Value>) add(words_of(Value{}));
  if constexpr (requires { typename Value::value_type; })
    if constexpr (Worded<typename Value::value_type>) add(words_of(typename Value::value_type{}));
  if (details.none) choices.emplace_back(details.none);
  if (std::is_same_v<Value, Source>) choices.emplace_back("embedded");
  return choices;
}

/// A member of options within a member of `Owner`.
template <class Outer, class At>
struct Within {
  auto& operator()(auto& owner) const { return At{}(Outer{}(owner)); }
};
struct Itself {
  auto& operator()(auto& owner) const { return owner; }
};

/// Functions that return a member. They are plain function pointers, so that the code which uses
/// them is compiled once per type.
template <class Owner, class Value>
struct Reach {
  Value& (*change)(Owner&);
  const Value& (*read)(const Owner&);
};

template <class Owner, class Value>
Field<Owner> field_of(KeyInfo info, Reach<Owner, Value> reach) {
  if constexpr (requires { typename Value::value_type; })
    if constexpr (Described<typename Value::value_type>)
      for (const auto& column : columns_of<typename Value::value_type>())
        info.columns.push_back(column);
  Field<Owner> field{std::move(info)};
  field.set = [info = KeyInfo(field), reach](Owner& owner, const nlohmann::json& value,
                                             const std::filesystem::path& folder) {
    return set_value({info, value, folder}, reach.change(owner));
  };
  field.get = [info = KeyInfo(field), reach](const Owner& owner) {
    return get_value(info, reach.read(owner));
  };
  return field;
}

/// A list of names, or the single word "all", which sets a separate flag.
template <class Owner>
Field<Owner> one_or_all_field(KeyInfo info, Reach<Owner, std::vector<std::string>> reach,
                              Reach<Owner, bool> reach_all) {
  info.choices = {"all"};
  Field<Owner> field = field_of(std::move(info), reach);
  field.set = [set = field.set, reach_all](Owner& owner, const nlohmann::json& value,
                                           const std::filesystem::path& folder) {
    const bool all = value == "all";
    Complaints complaints = set(owner, all ? nlohmann::json::array() : value, folder);
    if (complaints.empty()) reach_all.change(owner) = all;
    return complaints;
  };
  field.get = [get = field.get, reach_all](const Owner& owner) {
    return reach_all.read(owner) ? nlohmann::json("all") : get(owner);
  };
  return field;
}

/// A table { name = number }, stored as rows of a name and a number.
template <class Owner, class Row>
Field<Owner> factors_field(KeyInfo info, Reach<Owner, std::vector<Row>> reach) {
  const Field<Row>&word = columns_of<Row>()[0], &factor = columns_of<Row>()[1];
  info.kind = Kind::factors;
  info.range = factor.range;
  Field<Owner> field{std::move(info)};
  field.set = [info = KeyInfo(field), reach, &word, &factor](
                  Owner& owner, const nlohmann::json& value, const std::filesystem::path& folder) {
    Complaints complaints = check_factors({info, value, folder});
    if (!complaints.empty()) return complaints;
    std::vector<Row>& rows = reach.change(owner);
    rows.clear();
    for (const auto& [name, number] : value.items()) {
      rows.emplace_back();
      word.set(rows.back(), name, folder);
      factor.set(rows.back(), number, folder);
    }
    return complaints;
  };
  field.get = [reach, &word, &factor](const Owner& owner) {
    auto table = nlohmann::json::object();
    for (const Row& row : reach.read(owner))
      table[word.get(row).template get<std::string>()] = factor.get(row);
    return table;
  };
  return field;
}

/// A visitor that turns each described member of a struct into a key. The struct is a part of
/// `Owner`; `Outer` is the function that returns it from an `Owner`.
template <class Owner, class Outer>
class KeyMaker {
 public:
  KeyMaker(std::vector<Field<Owner>>& fields, std::string key_prefix, std::string member_prefix,
           std::string sentence)
      : fields_(fields),
        key_prefix_(std::move(key_prefix)),
        member_prefix_(std::move(member_prefix)),
        sentence_(std::move(sentence)) {}

  template <class At>
  void option(const char* name, At, const char* sentence, const OptionDetails& details = {}) {
    if (!details.in_scene) return;
    using Value = ValueAt<At>;
    if constexpr (Described<Value>) {
      const std::string inner = details.key ? details.key : name + std::string(".");
      KeyMaker<Owner, Within<Outer, At>> maker(fields_, key_prefix_ + inner,
                                               member_prefix_ + name + ".", sentence);
      Value::describe(maker);
    } else {
      fields_.push_back(field_of(info<Value>(name, sentence, details), reach<At>()));
    }
  }
  template <class At, class AllAt>
  void one_or_all(const char* name, At, const char*, AllAt, const char* sentence) {
    fields_.push_back(
        one_or_all_field(info<ValueAt<At>>(name, sentence, {}), reach<At>(), reach<AllAt>()));
  }
  template <class At, class Words>
  void factors(const char* name, At, const Words& words, const char* sentence,
               const OptionDetails& details) {
    KeyInfo key = info<ValueAt<At>>(name, sentence, details);
    key.choices = words();
    fields_.push_back(factors_field(std::move(key), reach<At>()));
  }

 private:
  template <class At>
  using ValueAt = std::remove_cvref_t<decltype(Within<Outer, At>{}(std::declval<Owner&>()))>;

  template <class At>
  static Reach<Owner, ValueAt<At>> reach() {
    using Value = ValueAt<At>;
    return {[](Owner& owner) -> Value& { return Within<Outer, At>{}(owner); },
            [](const Owner& owner) -> const Value& { return Within<Outer, At>{}(owner); }};
  }

  template <class Value>
  KeyInfo info(const char* name, const char* sentence, const OptionDetails& details) const {
    KeyInfo key = info_of(name, sentence, details, key_prefix_, member_prefix_, sentence_);
    key.kind = kind_of<Value>(details);
    key.choices = choices_of<Value>(details);
    return key;
  }

  std::vector<Field<Owner>>& fields_;
  std::string key_prefix_, member_prefix_, sentence_;
};

/// All keys that a struct describes, in its order.
template <Described Owner>
std::vector<Field<Owner>> keys_of() {
  std::vector<Field<Owner>> fields;
  KeyMaker<Owner, Itself> maker(fields, "", "", "");
  Owner::describe(maker);
  return fields;
}

template <class Row>
const std::vector<Field<Row>>& columns_of() {
  static const std::vector<Field<Row>> columns = keys_of<Row>();
  return columns;
}

}  // namespace hyperex::scene
