// SPDX-License-Identifier: GPL-3.0-or-later
// Texts about keys for messages and the reference page: which values are expected, and the value
// that was given.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "hyperex/scene/fields.hpp"

namespace hyperex::scene {
using nlohmann::json;

std::string in_words(const std::vector<std::string>& choices) {
  std::string text;
  for (std::size_t i = 0; i < choices.size(); ++i)
    text += (i == 0 ? "" : i + 1 == choices.size() ? " or " : ", ") + ('"' + choices[i] + '"');
  return text;
}

namespace {
std::string number_text(const KeyInfo& info, const char* one) {
  const std::string text = info.range.expected(one), unit = info.unit.name;
  return unit.empty() ? text : text + " (" + unit + ")";
}

std::string count_text(std::size_t least, std::size_t most) {
  if (least == 0) return "";
  if (least == most) return fmt::format("{} ", least);
  if (most >= 1000) return fmt::format("{} or more ", least);
  return fmt::format("{} to {} ", least, most);
}

}  // namespace

std::string KeyInfo::expected() const {
  switch (kind) {
    case Kind::flag:
      return "true or false";
    case Kind::integer:
      return number_text(*this, "an integer");
    case Kind::number:
      return number_text(*this, "a number");
    case Kind::numbers:
      if (most == 2) return number_text(*this, "a number, or a list of two rising ones, each");
      return "a list of " + count_text(least, most) +
             number_text(*this, least == most ? "numbers, each" : "rising numbers, each");
    case Kind::text:
      return least > 0 ? "a name in quotes" : "a text in quotes";
    case Kind::choice:
      return in_words(choices);
    case Kind::path:
      return "the path of a file" + (choices.empty() ? "" : ", or " + in_words(choices));
    case Kind::names:
      return (least > 0 ? fmt::format("a list of {} or more different names, or none", least)
                        : "a list of different names") +
             (choices.empty() ? "" : ", or " + in_words(choices));
    case Kind::places:
      return "a list of places [x, y, z]" + (*unit.name ? fmt::format(" ({})", unit.name) : "");
    case Kind::factors:
      return fmt::format("a table of names and numbers from {}, as in {{ {} = 0.5 }}", range.text(),
                         choices.empty() ? "name" : choices.front());
    case Kind::rows:
      break;
  }
  return "[[" + name + "]] tables";
}

KeyInfo info_of(const std::string& member, const std::string& sentence,
                const OptionDetails& details, const std::string& key_prefix,
                const std::string& member_prefix, const std::string& about) {
  const std::string key = key_of(member, details);
  return {.name = key.find('.') == std::string::npos ? key_prefix + key : key,
          .unit = details.unit,
          .range = details.bounds.limited() ? details.unit.from_si(details.bounds) : Bounds{0, 0},
          .least = details.least,
          .most = details.most,
          .required = details.required,
          .folder_too = details.folder_too,
          .description = about.empty() ? sentence : about + " " + sentence,
          .only_where = details.only_where,
          .scene_default = details.scene_default,
          .member = member_prefix + member};
}

std::string one_of_names(const std::string& name, const std::vector<std::string>& names) {
  const std::string near = nearest(name, names);
  return near.empty() ? fmt::format("one of {}", fmt::join(names, ", "))
                      : "another name; did you mean " + near + "?";
}

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
  std::size_t cut = longest;  // do not cut within a UTF-8 character
  while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xC0) == 0x80) --cut;
  return text.substr(0, cut) + "...";
}

}  // namespace hyperex::scene
