// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/toml_values.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

#include "hyperex/io/nesting.hpp"
#include "hyperex/io/toml.hpp"

namespace hyperex::scene {
namespace {
using nlohmann::json;

template <class Value>
json dated(const Value& value) {
  std::ostringstream text;
  text << value;
  return {{"date or time", text.str()}};
}

json convert(const toml::node& node, const std::string& name, std::map<std::string, int>& lines) {
  if (!name.empty()) lines[name] = static_cast<int>(node.source().begin.line);
  if (const auto* table = node.as_table()) {
    json object = json::object();
    for (const auto& [key, item] : *table) {
      const std::string key_text(key.str());
      object[key_text] = convert(item, name.empty() ? key_text : name + "." + key_text, lines);
    }
    return object;
  }
  if (const auto* array = node.as_array()) {
    json list = json::array();
    for (const auto& item : *array)
      list.push_back(convert(item, name + "[" + std::to_string(list.size()) + "]", lines));
    return list;
  }
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* integer = node.as_integer()) return integer->get();
  if (const auto* number = node.as_floating_point()) return number->get();
  if (const auto* flag = node.as_boolean()) return flag->get();
  if (const auto* date = node.as_date()) return dated(*date);
  if (const auto* time = node.as_time()) return dated(*time);
  if (const auto* date_time = node.as_date_time()) return dated(*date_time);
  return nullptr;
}

std::string line_of(const std::string& text, int line) {
  std::istringstream lines(text);
  std::string found;
  for (int n = 0; n < line; ++n) std::getline(lines, found);
  return found;
}

/// Whether a key without quotes has a letter beyond ASCII: "größe = 2".
bool has_bare_letter(const std::string& line) {
  const std::string key = line.substr(0, line.find('='));
  return key.find_first_of("\"'#") == std::string::npos &&
         std::any_of(key.begin(), key.end(), [](char c) { return (unsigned char)c >= 0x80; });
}

/// Whether a number has a decimal comma, as usual in many languages: "gain = 0,3".
bool has_decimal_comma(const std::string& line) {
  for (auto comma = line.find(','); comma != std::string::npos; comma = line.find(',', comma + 1)) {
    const auto is_digit = [&](std::size_t at) {
      return at < line.size() && std::isdigit((unsigned char)line[at]);
    };
    auto first = comma;
    while (first > 0 && is_digit(first - 1)) --first;
    const auto before = first == 0 ? std::string::npos : line.find_last_not_of(" +-", first - 1);
    if (first < comma && is_digit(comma + 1) && before != std::string::npos && line[before] == '=')
      return true;
  }
  return false;
}
}  // namespace

TomlValues parse_toml(const std::string& text) {
  if (const int line = io::line_nested_too_deep_toml(text); line > 0)
    throw TornToml{line, io::too_deep()};
  try {
    const toml::table table = toml::parse(text);
    TomlValues values;
    values.root = convert(table, "", values.lines);
    return values;
  } catch (const toml::parse_error& error) {
    std::string why(error.description());
    for (char& c : why)
      if (static_cast<unsigned char>(c) < ' ') c = ' ';
    const int line = static_cast<int>(error.source().begin.line);
    // The parser's errors for a string without a closing quote.
    if (why.find("string") != std::string::npos &&
        (why.find("unescaped control characters") != std::string::npos ||
         why.find("end-of-file") != std::string::npos ||
         why.find("line-break") != std::string::npos))
      why = "a string that does not end: its closing quote is missing";
    const std::string torn = line_of(text, line);
    if (has_bare_letter(torn))
      why = "a key with other characters than A-Z, a-z, 0-9, _ and - needs quotes";
    throw TornToml{line, why, torn.find('\\') != std::string::npos, has_decimal_comma(torn)};
  }
}

std::optional<json> parse_toml_value(const std::string& value) {
  if (io::line_nested_too_deep_toml(value) > 0) return std::nullopt;
  try {
    const toml::table table = toml::parse("value = " + value);
    std::map<std::string, int> ignored;
    // A line break in the value could add a second key.
    if (table.size() != 1) return std::nullopt;
    return convert(table.begin()->second, "", ignored);
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
}

std::optional<json> parse_json_value(const std::string& value) {
  if (io::line_nested_too_deep_json(value) > 0) return std::nullopt;
  json read = json::parse(value, nullptr, false);
  if (!read.is_structured()) return std::nullopt;
  return read;
}

std::string toml_text(const json& value) {
  if (value.is_number_float() && !std::isfinite(value.get<double>())) {
    const double number = value.get<double>();
    return std::isnan(number) ? "nan" : number > 0 ? "inf" : "-inf";
  }
  std::string parts;
  const auto add = [&](const std::string& part) { parts += (parts.empty() ? "" : ", ") + part; };
  if (value.is_array()) {
    for (const json& item : value) add(toml_text(item));
    return "[" + parts + "]";
  }
  if (value.is_object()) {
    for (const auto& [key, item] : value.items()) add(json(key).dump() + " = " + toml_text(item));
    return "{" + parts + "}";
  }
  // Numbers, words and JSON's escapes in strings are valid TOML too, except for DEL.
  std::string text = value.dump();
  for (auto at = text.find('\x7f'); at != std::string::npos; at = text.find('\x7f', at))
    text.replace(at, 1, "\\u007f");
  return text;
}

}  // namespace hyperex::scene
