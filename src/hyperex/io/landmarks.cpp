// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/io/landmarks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/io/nesting.hpp"
#include "hyperex/io/number.hpp"

namespace hyperex::io {
namespace {
using nlohmann::json;

/// Parses JSON. A key that occurs twice in one object is an error; by default, the last one would
/// be used without a message.
json parse_strictly(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  check_nesting_json(file, text);
  std::vector<std::set<std::string>> keys;
  const auto on_event = [&](int, json::parse_event_t event, json& parsed) {
    if (event == json::parse_event_t::object_start) keys.emplace_back();
    if (event == json::parse_event_t::object_end) keys.pop_back();
    if (event == json::parse_event_t::key && !keys.back().insert(parsed.get<std::string>()).second)
      throw InputError(
          {file, 0, quotable(parsed.get<std::string>()), "", "each name once; it occurs twice"});
    return true;
  };
  try {
    return json::parse(text, on_event);
  } catch (const json::exception& exception) {
    // "[json.exception.parse_error.101] parse error at line 3, column 7: ...": the part after the
    // bracket.
    std::string_view what = exception.what();
    if (const auto end = what.find("] "); end != std::string_view::npos)
      what.remove_prefix(end + 2);
    std::string line(what.substr(0, 160));
    for (char& c : line)
      if (static_cast<unsigned char>(c) < 0x20) c = ' ';
    throw InputError(file, "is no sound JSON: " + line);
  }
}

Vec3 point_of(const std::filesystem::path& file, const std::string& name, const json& value) {
  Vec3 point;
  bool sound = value.is_array() && value.size() == 3;
  for (int k = 0; sound && k < 3; ++k) {
    sound = value[k].is_number();
    if (sound) point[k] = value[k].get<double>();
  }
  if (!sound || !point.allFinite())
    throw InputError(
        {file, 0, quotable(name), quotable(value.dump()), "three finite numbers [x, y, z]"});
  return point;
}

void add(const std::filesystem::path& file, Landmarks& landmarks, const std::string& name,
         const Vec3& point) {
  if (name.empty()) throw InputError(file, "a point has no name; expected a name for each");
  if (!is_printable_name(name))
    throw InputError({file, 0, "name of a point", quotable(name), printable_name});
  if (!landmarks.emplace(name, point).second)
    throw InputError({file, 0, quotable(name), "", "each name once; it occurs twice"});
}

LengthUnit parsed_unit(const std::filesystem::path& file, const char* key, const json& value) {
  const auto unit = value.is_string() ? length_unit(value.get<std::string>()) : std::nullopt;
  if (!unit) throw InputError({file, 0, key, quotable(value.dump()), "\"mm\", \"cm\" or \"m\""});
  return *unit;
}

/// {"units": "mm", "points": {"NAME": [x, y, z], ...}}
Landmarks read_plain(const std::filesystem::path& file, const json& root,
                     std::optional<LengthUnit> stated) {
  if (!stated && !root.contains("units"))
    throw InputError({file, 0, "units", "", "\"mm\", \"cm\" or \"m\"; the key is missing"});
  const LengthUnit unit = stated ? *stated : parsed_unit(file, "units", root["units"]);
  if (!root["points"].is_object())
    throw InputError({file, 0, "points", "", "an object {\"NAME\": [x, y, z], ...}"});
  Landmarks landmarks;
  for (const auto& [name, value] : root["points"].items())
    add(file, landmarks, name, metres_per(unit) * point_of(file, name, value));
  return landmarks;
}

/// One markups node of 3D Slicer. By its schema, the defaults are LPS and mm.
void read_markup(const std::filesystem::path& file, const json& markup,
                 std::optional<LengthUnit> stated, Landmarks& landmarks) {
  if (!markup.is_object()) throw InputError({file, 0, "markups", "", "objects in this list"});
  const json system = markup.value("coordinateSystem", json("LPS"));
  if (system != "LPS" && system != "RAS")
    throw InputError({file, 0, "coordinateSystem", quotable(system.dump()), "\"LPS\" or \"RAS\""});
  json units = markup.value("coordinateUnits", json("mm"));
  if (units.is_array() && !units.empty()) units = units[0];
  const LengthUnit unit = stated ? *stated : parsed_unit(file, "coordinateUnits", units);
  const double x_and_y = system == "RAS" ? -1 : 1;
  const json points = markup.value("controlPoints", json::array());
  if (!points.is_array()) throw InputError({file, 0, "controlPoints", "", "a list of points"});
  for (const json& point : points) {
    if (!point.is_object() || !point.contains("label") || !point["label"].is_string())
      throw InputError({file, 0, "controlPoints", "", "objects with a label each"});
    const std::string name = point["label"];
    // Slicer's list also contains points that have not been placed yet.
    if (point.value("positionStatus", json("defined")) != "defined") continue;
    const Vec3 position = point_of(file, name, point.value("position", json()));
    add(file, landmarks, name, metres_per(unit) * position.cwiseProduct(Vec3(x_and_y, x_and_y, 1)));
  }
}

}  // namespace

Landmarks read_landmarks(const std::filesystem::path& file, std::optional<LengthUnit> stated) {
  const json root = parse_strictly(file);
  Landmarks landmarks;
  if (root.is_object() && root.contains("markups")) {
    if (!root["markups"].is_array()) throw InputError({file, 0, "markups", "", "a list"});
    for (const json& markup : root["markups"]) read_markup(file, markup, stated, landmarks);
  } else if (root.is_object() && root.contains("points")) {
    landmarks = read_plain(file, root, stated);
  } else {
    throw InputError(file,
                     "has neither \"points\" nor, as 3D Slicer's .mrk.json, \"markups\"; "
                     "expected {\"units\": \"mm\", \"points\": {\"NAME\": [x, y, z], ...}}");
  }
  if (landmarks.empty()) throw InputError(file, "has no points; expected at least one");
  return landmarks;
}

}  // namespace hyperex::io
