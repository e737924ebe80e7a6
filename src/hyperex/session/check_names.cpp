// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/check_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "hyperex/anatomy/landmarks.hpp"
#include "hyperex/core/add_rest.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/face/point_words.hpp"
#include "hyperex/face/same_place.hpp"
#include "hyperex/scene/keys.hpp"
#include "hyperex/session/driven_points.hpp"
#include "hyperex/session/unknown_names.hpp"
#include "hyperex/tissue/field/tissue_field.hpp"

namespace hyperex::session {
namespace {

std::vector<std::string> landmarks_of(const Inputs& in) {
  std::vector<std::string> names;
  for (const auto& entry : in.landmarks) names.push_back(entry.first);
  return names;
}

/// The name that a problem of the tissue's fields is about: in "names of landmarks of the scan (x
/// is none)", or its value. Empty where it is about another thing.
std::string unknown_landmark(const InputProblem& problem) {
  const std::string before = "names of landmarks of the scan (", after = " is none)";
  if (problem.expected.starts_with(before) && problem.expected.ends_with(after))
    return problem.expected.substr(before.size(),
                                   problem.expected.size() - before.size() - after.size());
  if (!problem.expected.starts_with("the name of a landmark of the scan")) return "";
  std::string name = problem.value;
  std::erase(name, '"');
  return name;
}

/// "names of landmarks of the scan (x is none); did you mean y?", where `of_what` is "landmarks of
/// the scan".
std::string expected_names(const std::string& of_what, const std::string& wrong,
                           const std::vector<std::string>& there_are) {
  return fmt::format("names of {} ({} is none){}", of_what, wrong, did_you_mean(wrong, there_are));
}

/// Problems for those `names` that are not points of the recording.
std::vector<InputProblem> names_of_no_point(const scene::Scene& scene, const motion::Motion& m,
                                            const std::vector<std::string>& names,
                                            const char* key) {
  std::vector<InputProblem> problems;
  for (const auto& name : names)
    if (m.index_of(name) < 0)
      problems.push_back(scene::problem_at(
          scene, key, expected_names("points in the recording " + m.source, name, m.names)));
  return problems;
}

/// One problem for all default points that the recording lacks. It names the recording and no key,
/// as the user wrote no list of points. The points that are there are listed where none of the
/// default ones is.
std::vector<InputProblem> missing_default_points(const motion::Motion& m,
                                                 const std::vector<std::string>& driven) {
  constexpr std::size_t most_named = 5;
  std::vector<std::string> missing, there;
  std::size_t count = 0;
  for (const std::string& name : driven) {
    if (m.index_of(name) >= 0) continue;
    if (++count <= most_named) missing.push_back(face::name_in_words(name));
  }
  if (count == 0) return {};
  add_rest(missing, count);
  for (const std::string& name : m.names)
    if (there.size() < most_named) there.push_back(name);
  add_rest(there, m.names.size());
  return {{motion::named(m), 0, "", "",
           fmt::format("{} {}, which {} missing{}: record {}, or choose other points with "
                       "drive.points",
                       count == 1 ? "the point" : "the points", fmt::join(missing, ", "),
                       count == 1 ? "is" : "are",
                       count == driven.size() ? fmt::format(" (it has {})", fmt::join(there, ", "))
                                              : std::string(),
                       count == 1 ? "it" : "them")}};
}

/// Problems for names that are not points of the recording, of which `driven` drive.
std::vector<InputProblem> problems_of_points(const scene::Scene& scene, const motion::Motion& m,
                                             const std::vector<std::string>& driven) {
  std::vector<InputProblem> all = drives_by_default(scene)
                                      ? missing_default_points(m, driven)
                                      : names_of_no_point(scene, m, driven, "drive.points");
  for (const auto& [key, names] : {std::pair{"support.jaw_points", &scene.support.jaw_points},
                                   {"region.measured_points", &scene.region.measured_points}})
    for (InputProblem& problem : names_of_no_point(scene, m, *names, key))
      all.push_back(std::move(problem));
  return all;
}

/// Problems for those `names` that are not landmarks of the scan.
std::vector<InputProblem> names_of_no_landmark(const scene::Scene& scene, const Inputs& in,
                                               const std::vector<std::string>& names,
                                               const char* key) {
  std::vector<InputProblem> problems;
  for (const auto& name : names)
    if (!in.landmarks.contains(name))
      problems.push_back(scene::problem_at(
          scene, key, expected_names("landmarks of the scan", name, landmarks_of(in))));
  return problems;
}

/// Problems for still points that are driven, by either of their names: they would move.
std::vector<InputProblem> driven_still_points(const scene::Scene& scene, const Inputs& in) {
  const auto drives = [&](const std::string& name) {
    return !name.empty() && std::ranges::find(in.driven, name) != in.driven.end();
  };
  std::vector<InputProblem> problems;
  for (const std::string& name : scene.drive.still_points) {
    const std::string other = face::other_name(name);
    if (!drives(name) && !drives(other)) continue;
    problems.push_back(scene::problem_at(
        scene, "drive.still_points",
        fmt::format("points that are not driven ({} is{}); drive.points chooses the driven ones",
                    name, drives(name) ? "" : ", as " + other)));
  }
  return problems;
}

}  // namespace

void check_names(const scene::Scene& scene, const Inputs& in, const std::string& owner) {
  std::vector<std::string> thick;
  for (const auto& p : scene.mesh.depths) thick.push_back(p.landmark);
  std::vector<InputProblem> all;
  const auto add = [&](const std::vector<InputProblem>& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  add(problems_of_points(scene, in.motion.motion, in.driven));
  add(names_of_no_landmark(scene, in, scene.drive.still_points, "drive.still_points"));
  add(driven_still_points(scene, in));
  add(names_of_no_landmark(scene, in, thick, "mesh.thickness_point"));
  for (const auto& problem : tissue::problems_of(scene.tissue, in.landmarks))
    all.push_back(scene::problem_at(scene, "tissue." + problem.key, problem.expected));
  for (InputProblem& problem : all) {
    problem.expected += did_you_mean_region(problem.key, problem.value);
    if (problem.key.starts_with("tissue."))
      problem.expected += did_you_mean(unknown_landmark(problem), landmarks_of(in));
    if (!problem.key.empty()) problem.key = owner + problem.key;
  }
  if (!all.empty()) throw InputError(all);
}

void check_point_names(const scene::Scene& scene, const motion::Motion& m,
                       const std::string& owner) {
  std::vector<InputProblem> all = problems_of_points(scene, m, driven_points(scene, m));
  for (InputProblem& problem : all)
    if (!problem.key.empty()) problem.key = owner + problem.key;
  if (!all.empty()) throw InputError(all);
}

void check_rigid_points(const scene::Scene& scene, const motion::Motion& m) {
  const auto problems =
      names_of_no_point(scene, m, scene.motion.rigid_points, "motion.rigid_points");
  if (!problems.empty()) throw InputError(problems);
}

void check_regions(const scene::Scene& scene, const std::string& owner) {
  std::vector<InputProblem> all;
  for (const auto& field : tissue::problems_of(scene.tissue, {})) {
    InputProblem problem = scene::problem_at(scene, "tissue." + field.key, field.expected);
    if (!field.key.starts_with("region[") || !unknown_landmark(problem).empty()) continue;
    problem.expected += did_you_mean_region(problem.key, problem.value);
    problem.key = owner + problem.key;
    all.push_back(std::move(problem));
  }
  if (!all.empty()) throw InputError(all);
}

void check_element_size(const scene::Scene& scene, const Inputs& in) {
  constexpr double share_of_mouth = 1.0 / 3;
  const auto right = in.landmarks.find("cheilion_R"), left = in.landmarks.find("cheilion_L");
  if (right == in.landmarks.end() || left == in.landmarks.end()) return;
  const double mouth_m = (left->second - right->second).norm();
  if (scene.mesh.element_size_m > share_of_mouth * mouth_m)
    throw InputError(scene::problem_at(
        scene, "mesh.element_size_mm",
        fmt::format("at most {:.1f} mm, a third of this mouth's width, for the lips to move apart",
                    1e3 * share_of_mouth * mouth_m)));
}

void note_unknown_landmarks(const scene::Scene& scene, const io::Landmarks& given, Inputs& in) {
  std::vector<std::string> unknown = anatomy::unknown_landmarks(given);
  std::erase_if(unknown, [&](const std::string& name) {
    return in.motion.motion.index_of(name) >= 0 ||
           std::count(scene.drive.still_points.begin(), scene.drive.still_points.end(), name) > 0 ||
           std::any_of(scene.mesh.depths.begin(), scene.mesh.depths.end(),
                       [&](const tissue::DepthAt& p) { return p.landmark == name; }) ||
           std::any_of(scene.tissue.points.begin(), scene.tissue.points.end(),
                       [&](const tissue::TissuePoint& p) { return name.starts_with(p.landmark); });
  });
  append(in.notes, misspelt_landmarks(unknown));
  if (!unknown.empty()) in.notes.push_back(anatomy::unknown_landmarks_note(unknown));
}

void note_missing_support(const scene::Scene& scene, Inputs& in) {
  const simulate::SupportOptions& s = scene.support;
  if (!s.border_held && s.skull == simulate::Hold::free && s.mandible == simulate::Mandible::free &&
      s.field_pa_per_m == 0)
    in.notes.push_back(make_note(
        "support.none",
        "nothing holds the tissue: support.border, support.skull and support.mandible are free and "
        "support.field_kpa_per_mm is 0; only the driven points hold it, and it may swing about "
        "them"));
}

}  // namespace hyperex::session
