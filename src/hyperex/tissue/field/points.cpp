// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/field/points.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/tissue/field/presets.hpp"

namespace hyperex::tissue {
namespace {

constexpr double kSideSlack_m = 0.002;

const char* side_word(const std::string& side) {
  return side == "L" ? "left" : side == "R" ? "right" : "middle";
}

class Resolver {
 public:
  Resolver(const TissueFieldOptions& options, const io::Landmarks& landmarks,
           std::vector<FieldProblem>& problems)
      : options_(options), landmarks_(landmarks), problems_(problems) {}

  std::vector<ResolvedPoint> all() {
    for (std::size_t i = 0; i < options_.points.size(); ++i)
      add(options_.points[i], fmt::format("point[{}]", i));
    const std::size_t own = points_.size();
    if (const TissuePreset* preset = find_preset(options_.preset))
      for (const TissuePoint& point : preset->points)
        for (const std::string& name : names_of(point, "preset"))
          if (std::none_of(points_.begin(), points_.begin() + std::ptrdiff_t(own),
                           [&](const ResolvedPoint& p) { return p.landmark == name; }))
            points_.push_back({name, point.value, "preset"});
    for (const ResolvedPoint& point : points_) check_side(point);
    return std::move(points_);
  }

 private:
  void complain(const std::string& key, const std::string& expected) {
    problems_.push_back({key, expected});
  }

  std::vector<std::string> names_of(const TissuePoint& point, const std::string& key) {
    const std::string &name = point.landmark, own = side_of_landmark(name);
    const bool known = landmarks_.contains(name);
    const bool paired = landmarks_.contains(name + "_L") && landmarks_.contains(name + "_R");
    if (!point.side.empty() && point.side != "L" && point.side != "R") {
      complain(key + ".side", "\"L\", \"R\" or \"\"");
      return {};
    }
    if (known && !point.side.empty() && own != point.side) {
      complain(key + ".side", own.empty()
                                  ? fmt::format("no side, as {} lies in the middle", name)
                                  : fmt::format("\"{}\" or none, as {} lies on the subject's {}",
                                                own, name, side_word(own)));
      return {};
    }
    if (known) return {name};
    if (paired && point.side.empty()) return {name + "_L", name + "_R"};
    if (!point.side.empty() && landmarks_.contains(name + "_" + point.side))
      return {name + "_" + point.side};
    complain(key + ".landmark", "the name of a landmark of the scan (docs/landmarks.md)");
    return {};
  }

  void add(const TissuePoint& point, const std::string& key) {
    const auto none = [](const auto& value) { return !value; };
    if (std::all_of(point.value.begin(), point.value.end(), none)) {
      complain(key, "at least one of young_kpa, viscosity_pa_s, poisson and density_kg_m3");
      return;
    }
    for (const std::string& name : names_of(point, key)) {
      if (!add_named(name, point.value, key)) continue;
      const std::string twin = anatomy::mirrored_landmark(name);
      if (options_.mirror && twin != name && landmarks_.contains(twin))
        add_named(twin, point.value, key);
    }
  }

  /// False where the landmark has other values already.
  bool add_named(const std::string& name, const GivenParameters& value, const std::string& key) {
    for (const ResolvedPoint& other : points_) {
      if (other.landmark != name) continue;
      if (other.value == value) return true;
      complain(key + ".landmark",
               fmt::format("one set of values for {}, and {} gives another{}", name, other.key,
                           options_.mirror ? " (mirror is true)" : ""));
      return false;
    }
    points_.push_back({name, value, key});
    return true;
  }

  /// The scan's own landmark may lie where its name does not say.
  void check_side(const ResolvedPoint& point) {
    const std::string side = side_of_landmark(point.landmark);
    if (side.empty()) return;
    const double lateral = face::face_frame(landmarks_).local(landmarks_.at(point.landmark)).x();
    if (side == "L" ? lateral > -kSideSlack_m : lateral < kSideSlack_m) return;
    complain(
        point.key == "preset" ? "preset" : point.key + ".landmark",
        fmt::format("a landmark on the subject's {}: {} lies {:.0f} mm to the {} of the middle "
                    "on this scan",
                    side_word(side), point.landmark, 1e3 * std::abs(lateral),
                    lateral > 0 ? "left" : "right"));
  }

  const TissueFieldOptions& options_;
  const io::Landmarks& landmarks_;
  std::vector<FieldProblem>& problems_;
  std::vector<ResolvedPoint> points_;
};

}  // namespace

std::string side_of_landmark(const std::string& name) {
  const anatomy::CanonicalFace& face = anatomy::canonical_face();
  if (face.landmarks.contains(name)) {
    const double x = face.landmark(name, face.mesh.points).x();
    return std::abs(x) < 1e-4 ? "" : x > 0 ? "L" : "R";
  }
  return name.ends_with("_L") ? "L" : name.ends_with("_R") ? "R" : "";
}

std::vector<ResolvedPoint> resolve_points(const TissueFieldOptions& options,
                                          const io::Landmarks& landmarks,
                                          std::vector<FieldProblem>& problems) {
  return Resolver(options, landmarks, problems).all();
}

}  // namespace hyperex::tissue
