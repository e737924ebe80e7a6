// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/earlier_run.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "hyperex/core/files.hpp"
#include "hyperex/core/output_directory.hpp"

namespace hyperex::run {
namespace fs = std::filesystem;
namespace {
using nlohmann::json;

/// The files that a run writes for the scene and for each variant.
const std::set<std::string> kOfAFace = {"activations.csv", "asymmetry.png", "contact_sheet.png",
                                        "excursions.csv",  "motion.csv",    "muscles.png",
                                        "skin_peak.ply",   "symmetry.csv",  "tissue_map.png"};
const std::set<std::string> kOfARun = {
    "error_budget.csv",     "frames.pvd",   "performance.glb",
    "report.html",          "gaze.csv",     "summary.json",
    "variants.csv",         "variants.png", "variants_excursions.csv",
    "variants_symmetry.png"};

bool is_name_of_an_output(const std::string& name) {
  if (kOfAFace.contains(name) || kOfARun.contains(name)) return true;
  const fs::path path(name);
  const std::string frame = "frames/frame_", variants = "variants/";
  if (name.starts_with(frame))
    return path.extension() == ".vtu" && name.find('/', frame.size()) == std::string::npos;
  return name.starts_with(variants) && kOfAFace.contains(path.filename().string()) &&
         path.parent_path().parent_path() == "variants";
}

/// The summary of the run that wrote into `folder`; null where none did. The summaries of a run
/// name no command; those of other commands do.
json summary_of_run(const fs::path& folder) {
  std::error_code error;
  const fs::path file = folder / "summary.json";
  if (!fs::is_regular_file(fs::symlink_status(file, error))) return {};
  json summary = json::parse(read_file(file), nullptr, false);
  const bool of_a_run = summary.is_object() && summary.value("program", json()) == "hyperex" &&
                        !summary.contains("command");
  return of_a_run ? summary : json();
}

}  // namespace

bool is_folder_of_run(const fs::path& folder) {
  return !summary_of_run(folder).is_null();
}

std::set<std::string> files_of_earlier_run(const fs::path& folder) {
  const json summary = summary_of_run(folder);
  if (summary.is_null()) return {};
  std::set<std::string> names;
  if (const auto listed = summary.find("files"); listed != summary.end()) {
    for (const json& name : *listed)
      if (name.is_string()) names.insert(name.get<std::string>());
    return names;
  }
  for (const std::string& name : files_below(folder))
    if (is_name_of_an_output(name)) names.insert(name);
  return names;
}

std::vector<fs::path> files_named_by(const scene::Scene& scene) {
  std::vector<fs::path> files = {scene.file,
                                 scene.scan.source.file,
                                 scene.scan.landmarks,
                                 scene.motion.source.file,
                                 scene.motion.recording,
                                 scene.motion.openface,
                                 scene.motion.arkit,
                                 scene.motion.candide,
                                 scene.tissue.per_vertex,
                                 scene.mesh.depth_per_vertex};
  for (const tissue::TissueRegion& region : scene.tissue.regions) files.push_back(region.painted);
  for (const tissue::DepthRegion& region : scene.mesh.depth_regions)
    files.push_back(region.painted);
  for (const scene::Variant& variant : scene.variants)
    for (const fs::path& file : files_named_by(variant.scene)) files.push_back(file);
  std::erase_if(files, [](const fs::path& file) { return file.empty(); });
  return files;
}

}  // namespace hyperex::run
