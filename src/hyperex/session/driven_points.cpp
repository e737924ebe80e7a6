// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/driven_points.hpp"

#include <fmt/format.h>

namespace hyperex::session {
namespace {
bool keeps_to_its_model(const scene::Scene& scene) {
  return !scene.motion.candide.empty() && !scene.drive.all_points &&
         !scene.origins.contains("drive.points");
}
}  // namespace

std::vector<std::string> driven_points(const scene::Scene& scene, const motion::Motion& motion) {
  if (scene.drive.all_points) return motion.names;
  std::vector<std::string> points = scene.drive.points;
  if (keeps_to_its_model(scene))
    std::erase_if(points, [&](const std::string& name) { return motion.index_of(name) < 0; });
  return points;
}

void note_left_out_points(const scene::Scene& scene, const motion::Motion& motion,
                          std::vector<Note>& notes) {
  const auto driven = driven_points(scene, motion);
  if (!keeps_to_its_model(scene) || driven.size() == scene.drive.points.size()) return;
  std::string missing;
  for (const auto& name : scene.drive.points)
    if (motion.index_of(name) < 0) missing += (missing.empty() ? "" : ", ") + name;
  notes.push_back(make_note(
      "drive.points_left_out",
      fmt::format("drive.points: {} has no {}; the other {} of the default points are driven",
                  scene.motion.candide.string(), missing, driven.size())));
}

}  // namespace hyperex::session
