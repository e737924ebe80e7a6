// SPDX-License-Identifier: GPL-3.0-or-later
// Values of a scene that do not go together.
#include <fmt/format.h>

#include <algorithm>

#include "hyperex/core/files.hpp"
#include "hyperex/muscles/muscle_names.hpp"
#include "hyperex/muscles/muscle_template.hpp"
#include "hyperex/scene/keys.hpp"
#include "hyperex/scene/region_names.hpp"
#include "hyperex/scene/scene_reader.hpp"
#include "hyperex/scene/values.hpp"
#include "hyperex/tissue/field/facial_regions.hpp"

namespace hyperex::scene {

/// Empty where the program's own table is used.
muscles::MuscleTable SceneReader::muscles_of_scene() {
  if (scene.muscles_file.empty() && scene.muscles_without.empty()) return {};
  muscles::MuscleTable all;
  try {
    muscles::MuscleTable own;
    if (const fs::path& file = scene.muscles_file; !file.empty())
      own = muscles::read_muscles(read_file(file), file.string());
    all = muscles::changed_table(muscles::muscle_template(), own, {});
  } catch (const InputError& error) {
    complain_given("muscles.file", fmt::format("sound tables of muscles ({})", error.what()));
    return {};
  }
  std::vector<std::string> names;
  for (const muscles::TemplateMuscle& muscle : all) names.push_back(muscle.name);
  for (const std::string& name : scene.muscles_without)
    if (!muscles::find_muscle(name, all))
      complain_given("muscles.without", fmt::format("names of muscles without side; {} is none: {}",
                                                    name, one_of_names(name, names)));
  muscles::MuscleTable left = muscles::changed_table(all, {}, scene.muscles_without);
  if (left.empty()) complain_given("muscles.without", "one muscle or more left");
  return left;
}

void SceneReader::check_gains() {
  const std::vector<std::string> names = muscles::gain_names(scene.muscles.table());
  for (const simulate::MuscleGain& gain : scene.muscles.gains) {
    if (std::find(names.begin(), names.end(), gain.muscle) != names.end()) continue;
    complain_part("muscles.gain", "." + gain.muscle, gain.gain,
                  expected_gain(gain.muscle, names, scene.muscles.table()));
  }
}

void SceneReader::check_region_names() {
  const auto& regions = scene.tissue.regions;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (regions[i].name.empty() || tissue::is_region(regions[i].name)) continue;
    const std::string below = fmt::format("[{}].name", i);
    complain_part("tissue.region", below, regions[i].name,
                  "the name of a region (hyperex presets lists them)" +
                      did_you_mean_region("tissue.region" + below, regions[i].name));
  }
}

void SceneReader::check_strain() {
  const simulate::ModelOptions& model = scene.model;
  if (model.strain != simulate::Strain::finite) return;
  if (model.viscous_form != fem::ViscousForm::isotropic)
    complain_given("tissue.viscous_form", "\"isotropic\", as tissue.strain is \"finite\"");
  if (scene.drive.by == simulate::DriveBy::reactions)
    complain_given("drive.by", "\"displacement\" or \"muscles\", as tissue.strain is \"finite\"");
  if (const double least = fem::least_c20(model.law); model.law.c20 < least)
    complain_given("tissue.yeoh_c20",
                   fmt::format("at least {:g}, -sqrt(3 tissue.yeoh_c30): below, stress falls "
                               "where stretch grows",
                               least));
}

void SceneReader::check_drive() {
  const bool by_muscles = scene.drive.by == simulate::DriveBy::muscles || drive_is_open();
  for (const auto& [key, given] : {std::pair{"muscles.gain", !scene.muscles.gains.empty()},
                                   {"muscles.mirrored", scene.muscles.mirrored},
                                   {"muscles.shape_prior", !scene.muscles.shape_prior},
                                   {"muscles.file", !scene.muscles_file.empty()},
                                   {"muscles.without", !scene.muscles_without.empty()}})
    if (!by_muscles && given)
      complain_given(key, "drive.by = \"muscles\" in the scene: muscles move nothing otherwise");
  const bool adds_volume =
      std::any_of(scene.tissue.regions.begin(), scene.tissue.regions.end(),
                  [](const tissue::TissueRegion& region) { return region.volume_m3 != 0; });
  for (const auto& [key, given] :
       {std::pair{"surgery.bone", !scene.surgery.bones.empty()}, {"tissue.region", adds_volume}})
    if (given && scene.drive.by == simulate::DriveBy::displacement && !drive_is_open())
      complain_given(key,
                     "drive.by = \"muscles\" or \"reactions\" in the scene, as driven points stay "
                     "where they were recorded");
  if (scene.drive.by != simulate::DriveBy::displacement &&
      scene.region.measured != simulate::Measured::none)
    complain_given("region.measured", "\"none\", as drive.by is not \"displacement\"");
}

void SceneReader::check_bones() {
  for (std::size_t i = 0; i < scene.surgery.bones.size(); ++i) {
    const simulate::BoneMove& move = scene.surgery.bones[i];
    if (const std::string expected = simulate::expected_cut(move); !expected.empty())
      complain_part("surgery.bone", fmt::format("[{}].cut", i), std::string(word_of(move.cut)),
                    expected);
  }
}

void SceneReader::check_together() {
  check_gains();
  check_region_names();
  check_strain();
  check_drive();
  check_bones();
  if (scene.region.measured == simulate::Measured::points && scene.region.measured_points.empty())
    complain_given("region.measured_points", "one or more names, as region.measured is \"points\"");
  if (scene.mesh.thickness_m != 0 && !scene.mesh.depths.empty())
    complain_given("mesh.thickness_mm", "0, as [[mesh.thickness_point]] is given");
  if (scene.region.measured == simulate::Measured::none && !scene.drive.all_points &&
      scene.drive.points.empty())
    complain_given("drive.points", "one or more names, or \"all\", as region.measured is \"none\"");
  if (scene.solver.newmark_gamma > 2 * scene.solver.newmark_beta)
    complain_given("solver.newmark_gamma",
                   "at most twice solver.newmark_beta: beyond, steps are not always stable");
  if (scene.time.end_s > simulate::kMostSteps * scene.time.step_s)
    complain_given("time.step_s", fmt::format("at least {:g}, for at most {:.0f} steps to "
                                              "time.end_s = {:g}",
                                              scene.time.end_s / simulate::kMostSteps,
                                              simulate::kMostSteps, scene.time.end_s));
  if (scene.time.end_s != 0 && scene.time.end_s < scene.time.step_s)
    complain_given("time.end_s", "0, or at least one time.step_s");
}

}  // namespace hyperex::scene
