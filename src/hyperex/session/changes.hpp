// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Values of a scene's keys as a C++ program gives them.
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

namespace hyperex::session {

/// The value of one key, in the unit of the key's name ("tissue.young_kpa": kPa).
class Value {
 public:
  Value(bool flag);
  Value(int number);
  Value(double number);
  Value(const char* text);
  Value(const std::string& text);
  Value(const std::vector<std::string>& texts);
  Value(const std::vector<double>& numbers);
  Value(std::initializer_list<const char*> texts);
  /// A value written as JSON: lists, and rows such as [{"name": "cheek_R", "young_factor": 5}].
  static Value from_json(std::string json);

  /// The value as JSON.
  const std::string& json() const { return json_; }

 private:
  Value() = default;
  std::string json_;
};

/// Keys of a scene (docs/scene.md) and their values: {{"tissue.young_kpa", 300}}.
using Changes = std::map<std::string, Value>;

/// As read_scene() takes them (scene/scene.hpp): "tissue.young_kpa=300". It reads JSON, too.
std::vector<std::string> overrides_of(const Changes& changes);

}  // namespace hyperex::session
