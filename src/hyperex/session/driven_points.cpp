// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/driven_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <utility>

#include "hyperex/core/add_rest.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/face/point_words.hpp"
#include "hyperex/face/same_place.hpp"

namespace hyperex::session {
namespace {

/// Parts of the face beside the mouth, by their iBUG-68 points.
struct FacePart {
  const char* name;
  int first, last;
  double moves_m;  ///< farther than noise of a depth camera and errors of the head's pose
  bool joins;      ///< the default points where it moves
};
// The outline of the face is not driven by itself: trackers of pictures let it slide along the
// skin. The bridge of the nose does not move. A smile carries the nostrils along by some 2 mm, a
// sneer moves them farther.
constexpr FacePart kParts[] = {{"brows", 17, 26, 2e-3, true},
                               {"nostrils", 31, 35, 3e-3, true},
                               {"lids", 36, 47, 2e-3, true},
                               {"outline of the face", 0, 16, 2e-3, false}};

/// How far a point goes from its first place; 0 where the motion lacks it.
double reach_m(const motion::Motion& motion, const std::string& name) {
  const int row = motion.index_of(name);
  double most_m = 0;
  if (row < 0 || motion.positions.empty()) return 0;
  for (const Points& at : motion.positions)
    most_m = std::max(most_m, (at.row(row) - motion.positions.front().row(row)).norm());
  return most_m;
}

double reach_m(const motion::Motion& motion, const FacePart& part,
               const std::vector<std::string>& without = {}) {
  double most_m = 0;
  for (int i = part.first; i <= part.last; ++i)
    if (const std::string name = face::ibug(i); std::ranges::find(without, name) == without.end())
      most_m = std::max(most_m, reach_m(motion, name));
  return most_m;
}

/// Whether a point drives: itself, under its other name, or as another point recorded at its place,
/// as pogonion and ibug68_8 of the program's own recordings are.
bool is_driven(const motion::Motion& motion, const std::vector<std::string>& driven,
               const std::string& name) {
  constexpr double kOnePlace_m = 1e-3;
  const int own = motion.index_of(name);
  return std::ranges::any_of(driven, [&](const std::string& one) {
    if (one == name || face::same_place(one, name)) return true;
    const int row = motion.index_of(one);
    if (own < 0 || row < 0 || motion.positions.empty()) return false;
    const Points& first = motion.positions.front();
    return (first.row(own) - first.row(row)).norm() < kOnePlace_m;
  });
}

/// The note counts other points that move farther than this, and names at most kMostNamed of them.
constexpr double kMoves_m = 2e-3;
constexpr std::size_t kMostNamed = 4;

bool is_of_a_part(int number) {
  return std::ranges::any_of(kParts, [number](const FacePart& part) {
    return part.first <= number && number <= part.last;
  });
}

/// Whether a point, one of those on the skin, belongs to no part that the note names as a whole and
/// is not driven.
bool is_further(const motion::Motion& motion, const std::vector<std::string>& driven,
                const std::string& name) {
  if (is_driven(motion, driven, name)) return false;
  const auto number = face::ibug_number_of_place(name);
  if (!number) return true;
  const std::string listed = face::ibug(*number);
  if (name != listed && motion.index_of(listed) >= 0) return false;
  const bool is_short = face::full_name(name) != name;  // the parts look for full names alone
  return is_short || !is_of_a_part(*number);
}

/// "cheek_L (cheek, left; 5.1 mm)", "my_mark (3.0 mm)" and "and 9 more": first those away from the
/// lips, where nothing else is driven, then those that go farthest.
std::vector<std::string> further_points(const motion::Motion& motion,
                                        const std::vector<std::string>& driven) {
  struct Point {
    bool of_lips;
    double far_m;
    std::string name;
  };
  std::vector<Point> points;
  simulate::DriveOptions all;
  all.all_points = true;
  for (const std::string& name : all.names_in(motion)) {
    const bool of_tracked_mesh = (motion.triangles.array() == motion.index_of(name)).any();
    if (of_tracked_mesh || !is_further(motion, driven, name)) continue;
    if (const double far_m = reach_m(motion, name); far_m >= kMoves_m)
      points.push_back({face::ibug_number_of_place(name).value_or(0) >= 48, far_m, name});
  }
  std::ranges::stable_sort(points, [](const Point& a, const Point& b) {
    return std::pair(a.of_lips, -a.far_m) < std::pair(b.of_lips, -b.far_m);
  });
  std::vector<std::string> named;
  for (const Point& point : points)
    if (named.size() < kMostNamed)
      named.push_back(face::name_in_words(point.name, fmt::format("{:.1f} mm", 1e3 * point.far_m)));
  add_rest(named, points.size());
  return named;
}

/// Without what comes after time.end_s, which is counted from the motion's first sample.
motion::Motion part_that_is_run(const scene::Scene& scene, const motion::Motion& motion) {
  if (scene.time.end_s <= 0 || motion.time_s.empty()) return motion;
  const double last_s = motion.time_s.front() + scene.time.end_s;
  const auto end = std::ranges::upper_bound(motion.time_s, last_s);
  if (end == motion.time_s.end()) return motion;
  motion::Motion run = motion;
  run.positions.resize(std::size_t(end - motion.time_s.begin()));
  run.time_s.resize(run.positions.size());
  run.time_s.push_back(last_s);
  run.positions.push_back(motion.at(last_s));
  return run;
}

bool keeps_to_its_model(const scene::Scene& scene) {
  return !scene.motion.candide.empty() && drives_by_default(scene);
}

void add_moving_parts(const motion::Motion& motion, std::vector<std::string>& points) {
  for (const FacePart& part : kParts) {
    if (!part.joins || reach_m(motion, part) < part.moves_m) continue;
    for (int i = part.first; i <= part.last; ++i)
      if (const std::string name = face::ibug(i);
          motion.index_of(name) >= 0 && std::ranges::find(points, name) == points.end())
        points.push_back(name);
  }
}

}  // namespace

bool drives_by_default(const scene::Scene& scene) {
  return !scene.drive.all_points && !scene.origins.contains("drive.points");
}

std::vector<std::string> driven_points(const scene::Scene& scene, const motion::Motion& motion) {
  std::vector<std::string> points = scene.drive.names_in(motion);
  if (keeps_to_its_model(scene))
    std::erase_if(points, [&](const std::string& name) { return motion.index_of(name) < 0; });
  if (drives_by_default(scene)) add_moving_parts(motion, points);
  return points;
}

void note_left_out_points(const scene::Scene& scene, const motion::Motion& motion,
                          std::vector<Note>& notes) {
  const auto driven = driven_points(scene, motion);
  if (keeps_to_its_model(scene)) {
    std::string missing;
    for (const auto& name : scene.drive.points)
      if (motion.index_of(name) < 0) missing += (missing.empty() ? "" : ", ") + name;
    if (!missing.empty())
      notes.push_back(make_note(
          "drive.points_left_out",
          fmt::format("drive.points: {} has no {}; the other {} of the default points are driven",
                      scene.motion.candide.string(), missing, driven.size())));
  }
  if (!drives_by_default(scene)) return;
  const motion::Motion run = part_that_is_run(scene, motion);
  std::vector<std::string> joined, left_out;
  for (const FacePart& part : kParts) {
    // Of the outline the chin drives by default.
    const double far_m = part.joins ? reach_m(motion, part) : reach_m(run, part, driven);
    if (far_m < part.moves_m) continue;
    (part.joins ? joined : left_out)
        .push_back(fmt::format("{} ({:.1f} mm)", part.name, 1e3 * far_m));
  }
  if (!joined.empty())
    notes.push_back(make_note("drive.parts_joined",
                              fmt::format("driven in addition to the mouth, since they move: {}",
                                          fmt::join(joined, ", "))));
  std::ranges::copy(further_points(run, driven), std::back_inserter(left_out));
  if (!left_out.empty())
    notes.push_back(make_note(
        "drive.measured_not_driven",
        fmt::format("recorded, but not driven: {}; drive.points selects the driven points",
                    fmt::join(left_out, ", "))));
}

}  // namespace hyperex::session
