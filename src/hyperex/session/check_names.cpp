// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/check_names.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hyperex/anatomy/landmarks.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/scene/keys.hpp"
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

/// Problems for those `names` that are not points of the recording or not landmarks of the scan.
std::vector<InputProblem> unknown_names(const scene::Scene& scene, const Inputs& in,
                                        const std::vector<std::string>& names, const char* key,
                                        bool in_motion) {
  std::vector<InputProblem> problems;
  for (const auto& name : names)
    if (in_motion ? in.motion.motion.index_of(name) < 0 : !in.landmarks.count(name))
      problems.push_back(scene::problem_at(
          scene, key,
          fmt::format("names of {} ({} is none){}",
                      in_motion ? "points in the recording " + in.motion.motion.source
                                : "landmarks of the scan",
                      name,
                      did_you_mean(name, in_motion ? in.motion.motion.names : landmarks_of(in)))));
  return problems;
}

}  // namespace

void check_names(const scene::Scene& scene, const Inputs& in, const std::string& owner) {
  std::vector<std::string> thick;
  for (const auto& p : scene.mesh.depths) thick.push_back(p.landmark);
  std::vector<InputProblem> all;
  const auto add = [&](const std::vector<std::string>& names, const char* key, bool in_motion) {
    const auto more = unknown_names(scene, in, names, key, in_motion);
    all.insert(all.end(), more.begin(), more.end());
  };
  add(in.driven, "drive.points", true);
  add(scene.support.jaw_points, "support.jaw_points", true);
  add(scene.region.measured_points, "region.measured_points", true);
  add(scene.drive.still_points, "drive.still_points", false);
  add(thick, "mesh.thickness_point", false);
  for (const auto& problem : tissue::problems_of(scene.tissue, in.landmarks))
    all.push_back(scene::problem_at(scene, "tissue." + problem.key, problem.expected));
  for (InputProblem& problem : all) {
    problem.expected += did_you_mean_region(problem.key, problem.value);
    if (problem.key.starts_with("tissue."))
      problem.expected += did_you_mean(unknown_landmark(problem), landmarks_of(in));
    problem.key = owner + problem.key;
  }
  if (!all.empty()) throw InputError(all);
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
