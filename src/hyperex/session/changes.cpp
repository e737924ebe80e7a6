// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/changes.hpp"

#include <nlohmann/json.hpp>

#include "hyperex/core/error.hpp"

namespace hyperex::session {

Value::Value(bool flag) : json_(flag ? "true" : "false") {}
Value::Value(int number) : json_(nlohmann::json(number).dump()) {}
// Not by dump(), which writes null in the place of a number that is not finite.
Value::Value(double number)
    : json_(number - number == 0 ? nlohmann::json(number).dump() : "\"not a finite number\"") {}
Value::Value(const char* text) : Value(std::string(text)) {}
Value::Value(const std::string& text) {
  try {
    json_ = nlohmann::json(text).dump();
  } catch (const nlohmann::json::exception&) {
    throw InputError("a value: expected text in UTF-8");
  }
}
Value::Value(const std::vector<std::string>& texts) : json_(nlohmann::json(texts).dump()) {}
Value::Value(const std::vector<double>& numbers) : json_(nlohmann::json(numbers).dump()) {}
Value::Value(std::initializer_list<const char*> texts)
    : json_(nlohmann::json(std::vector<std::string>(texts.begin(), texts.end())).dump()) {}

Value Value::from_json(std::string json) {
  if (!nlohmann::json::accept(json)) throw InputError("a value: expected JSON, not " + json);
  Value value;
  value.json_ = std::move(json);
  return value;
}

std::vector<std::string> overrides_of(const Changes& changes) {
  std::vector<std::string> overrides;
  for (const auto& [key, value] : changes) overrides.push_back(key + "=" + value.json());
  return overrides;
}

}  // namespace hyperex::session
