// SPDX-License-Identifier: GPL-3.0-or-later
// Which keys have no effect beside which others. Where another warning names the same keys
// (law.idle, region.idle, support.idle), a rule lets them act.
#include "hyperex/scene/recording_file.hpp"
#include "hyperex/session/idle_keys.hpp"

namespace hyperex::session {
namespace {
using fem::HyperelasticLaw;
using scene::Scene;
using simulate::DriveBy;

bool is_finite(const Scene& s) {
  return s.model.strain == simulate::Strain::finite;
}

std::vector<IdleRule> rules_of_physics() {
  return {{{"support.skull_across_kpa_per_mm", "support.skull_along_kpa_per_mm"},
           "support.skull",
           "support.skull is not \"sliding\"",
           [](const Scene& s, DriveBy drive) {
             return drive == DriveBy::muscles || s.support.skull == simulate::Hold::sliding;
           }},
          {{"support.mandible_across_kpa_per_mm", "support.mandible_along_kpa_per_mm"},
           "support.mandible",
           "support.mandible is not \"follow\"",
           [](const Scene& s, DriveBy drive) {
             return drive == DriveBy::muscles || s.support.mandible == simulate::Mandible::follow;
           }},
          {{"region.measured_points", "region.measured_radius_mm", "region.blend_mm"},
           "region.measured",
           "region.measured is \"all\"",
           [](const Scene& s, DriveBy) { return s.region.measured != simulate::Measured::all; }},
          {{"tissue.yeoh_c20", "tissue.yeoh_c30"},
           "tissue.law",
           "tissue.law is not \"yeoh\"",
           [](const Scene& s, DriveBy) {
             return !is_finite(s) || s.model.law.law == HyperelasticLaw::yeoh;
           }},
          {{"tissue.mooney_c01"},
           "tissue.law",
           "tissue.law is not \"mooney-rivlin\"",
           [](const Scene& s, DriveBy) {
             return !is_finite(s) || s.model.law.law == HyperelasticLaw::mooney_rivlin;
           }},
          {{"solver.method", "solver.verify"},
           "tissue.strain",
           "tissue.strain is \"finite\"",
           [](const Scene& s, DriveBy) { return !is_finite(s); }},
          {{"solver.newmark_beta", "solver.newmark_gamma"},
           "tissue.strain",
           "tissue.strain is \"finite\" and displacement drives the face",
           // Forces are found at small strain, by Newmark's method.
           [](const Scene& s, DriveBy drive) {
             return !is_finite(s) || drive != DriveBy::displacement;
           }},
          {{"solver.verify"},
           "solver.method",
           "solver.method is \"direct\"",
           [](const Scene& s, DriveBy) {
             return is_finite(s) || s.solver.method != simulate::SolverMethod::direct;
           }},
          {{"contact.teeth"},
           "teeth.shape",
           "teeth.shape is \"none\" and no teeth are given",
           [](const Scene& s, DriveBy) {
             return !s.contact.teeth || s.teeth.shape != scene::TeethShape::none ||
                    !s.teeth.upper.empty() || !s.teeth.lower.empty();
           }}};
}

std::vector<IdleRule> rules_of_inputs() {
  return {
      {{"teeth.unit"},
       "teeth.upper",
       "neither teeth.upper nor teeth.lower is given",
       [](const Scene& s, DriveBy) { return !s.teeth.upper.empty() || !s.teeth.lower.empty(); }},
      {{"anatomy.unit"},
       "anatomy.skull",
       "neither anatomy.skull nor anatomy.mandible is given",
       [](const Scene& s, DriveBy) {
         return !s.anatomy.skull.empty() || !s.anatomy.mandible.empty();
       }},
      {{"scan.landmarks_unit"},
       "scan.landmarks",
       "scan.landmarks is not given",
       [](const Scene& s, DriveBy) { return !s.scan.landmarks.empty(); }},
      {{"motion.candide"},
       "motion.candide",
       "none of motion.recording, motion.openface and motion.arkit is given",
       [](const Scene& s, DriveBy) {
         return !s.motion.recording.empty() || !s.motion.openface.empty() ||
                !s.motion.arkit.empty();
       }},
      {{"tissue.interpolation"},
       "tissue.point",
       "neither [[tissue.point]] nor tissue.preset is given",
       [](const Scene& s, DriveBy) {
         return !s.tissue.points.empty() || !s.tissue.preset.empty();
       }},
      {{"tissue.mirror"},
       "tissue.mirror",
       "none of [[tissue.point]], [[tissue.region]] and tissue.preset is given",
       [](const Scene& s, DriveBy) {
         return !s.tissue.mirror || !s.tissue.points.empty() || !s.tissue.regions.empty() ||
                !s.tissue.preset.empty();
       }},
      {{"motion.rigid_points"},
       "motion.rigid_points",
       "expressions move a face whose head stays where it is",
       // drive.points = "all" leaves them out.
       [](const Scene& s, DriveBy) { return !scene::of_weights(s) || s.drive.all_points; }}};
}

}  // namespace

const std::vector<IdleRule>& idle_rules() {
  static const std::vector<IdleRule> all = [] {
    std::vector<IdleRule> rules = rules_of_physics();
    for (IdleRule& rule : rules_of_inputs()) rules.push_back(std::move(rule));
    return rules;
  }();
  return all;
}

}  // namespace hyperex::session
