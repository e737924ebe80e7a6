// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "hyperex/core/files.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::io {
namespace {
using Json = nlohmann::ordered_json;

constexpr const char* kSchema =
    "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/"
    "Schema/markups-schema-v1.0.3.json#";

Json numbers(const Vec3& point, LengthUnit unit) {
  const Vec3 p = point / metres_per(unit);
  return {p.x(), p.y(), p.z()};
}

/// {"units": "mm", "points": {"NAME": [x, y, z], ...}}
Json plain(const Landmarks& landmarks, LengthUnit unit) {
  Json points = Json::object();
  for (const auto& [name, point] : landmarks) points[name] = numbers(point, unit);
  return {{"units", name_of(unit)}, {"points", std::move(points)}};
}

/// The schema allows the word "mm"; any other unit is a coded entry of UCUM.
Json slicer_unit(LengthUnit unit) {
  if (unit == LengthUnit::millimetre) return "mm";
  return Json::array(
      {name_of(unit), "UCUM", unit == LengthUnit::centimetre ? "centimeter" : "meter"});
}

/// The markups schema 1.0.3 of 3D Slicer. From version 4.11, Slicer assumes that a PLY, OBJ or STL
/// file is in LPS, unless the file says otherwise, and in millimetres. With the scan's own
/// coordinates declared as LPS, the points lie on the scan.
Json slicer_markups(const Landmarks& landmarks, LengthUnit unit) {
  Json points = Json::array();
  for (const auto& [name, point] : landmarks)
    points.push_back({{"id", std::to_string(points.size() + 1)},
                      {"label", name},
                      {"description", ""},
                      {"associatedNodeID", ""},
                      {"position", numbers(point, unit)},
                      {"orientation", {-1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0}},
                      {"selected", true},
                      {"locked", false},
                      {"visibility", true},
                      {"positionStatus", "defined"}});
  const Json markup = {{"type", "Fiducial"},
                       {"coordinateSystem", "LPS"},
                       {"coordinateUnits", slicer_unit(unit)},
                       {"locked", false},
                       {"fixedNumberOfControlPoints", false},
                       {"labelFormat", "%N-%d"},
                       {"lastUsedControlPointNumber", landmarks.size()},
                       {"controlPoints", std::move(points)}};
  return {{"@schema", kSchema}, {"markups", Json::array({markup})}};
}

}  // namespace

void write_landmarks(const std::filesystem::path& file, const Landmarks& landmarks,
                     LengthUnit unit) {
  const bool for_slicer = file.filename().string().ends_with(".mrk.json");
  const Json root = for_slicer ? slicer_markups(landmarks, unit) : plain(landmarks, unit);
  write_file_atomically(file, [&](std::ostream& stream) { stream << root.dump(1) << '\n'; });
}

}  // namespace hyperex::io
