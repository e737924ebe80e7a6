// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/simulation_options.hpp"

#include "hyperex/tissue/field/presets.hpp"
#include "hyperex/tissue/field/tissue_field.hpp"

namespace hyperex::session {

simulate::SimulationOptions simulation_options(const scene::Scene& scene, const Inputs& inputs) {
  simulate::SimulationOptions o;
  o.model = scene.model;
  o.tissue.uniform = uniform_parameters(scene.tissue);
  o.support = scene.support;
  o.drive = scene.drive;
  o.drive.all_points = false;
  o.drive.points = inputs.driven;
  o.muscles = scene.muscles;
  o.region = scene.region;
  o.contact = scene.contact;
  o.surgery = scene.surgery;
  // Bones and added volume push the lips against each other.
  if (!o.surgery.bones.empty() || adds_volume(scene.tissue)) o.contact.lips = true;
  o.solver = scene.solver;
  o.time = scene.time;
  return o;
}

}  // namespace hyperex::session
