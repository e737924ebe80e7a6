// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/summary.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hyperex/core/version.hpp"
#include "hyperex/metrics/mouth_outline.hpp"
#include "hyperex/metrics/peak_tissue.hpp"
#include "hyperex/metrics/roughness.hpp"
#include "hyperex/metrics/skin_uncertainty.hpp"
#include "hyperex/metrics/symmetry_json.hpp"
#include "hyperex/metrics/variant_difference.hpp"
#include "hyperex/run/activations.hpp"
#include "hyperex/scene/file_names.hpp"
#include "hyperex/session/driven_points.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/session/plausible.hpp"

namespace hyperex::run {
using Json = nlohmann::ordered_json;

namespace {
Json quality_json(const tissue::TissueMesh& mesh, const session::SkinOff& off) {
  const tissue::MeshQuality& q = mesh.quality;
  Json shares = Json::object();
  for (std::size_t b = 0; b < q.least_dihedral_shares.size(); ++b)
    shares[fmt::format("{:g} to {:g} deg", tissue::dihedral_bounds_deg[b],
                       tissue::dihedral_bounds_deg[b + 1])] = q.least_dihedral_shares[b];
  return {{"least_volume_mm3", q.least_volume_mm3},
          {"mean_volume_mm3", q.mean_volume_mm3},
          {"least_dihedral_deg", q.least_dihedral_deg},
          {"greatest_dihedral_deg", q.greatest_dihedral_deg},
          {"least_dihedral_share", shares},
          {"worst_radius_ratio", q.worst_radius_ratio},
          {"skin_to_scan_mean_mm", mesh.mean_distance_mm},
          {"skin_to_scan_face_max_mm", off.distance_mm},
          {"skin_to_scan_max_mm", mesh.max_distance_mm}};
}

/// The solver's report.
void add_solver(const Results& r, Json& s) {
  const auto& report = r.simulation.report;
  s["element"] = fem::to_string(r.scene.model.element);
  const bool finite = r.scene.model.strain == simulate::Strain::finite;
  if (finite) {
    s["strain"] = "finite";
    s["law"] = fem::to_string(r.scene.model.law.law);
    s["iterations"] = report.iterations;
    s["factorisations"] = report.factorisations;
    s["estimated_error"] = report.estimated_error;
  }
  s["solver"] = finite ? "finite" : report.basis_size > 0 ? "reduced" : "direct";
  s["linear_solver"] = "cholesky";  // the only one
  s["input_shapes"] = report.input_shapes;
  if (report.basis_size > 0) {
    s["basis_size"] = report.basis_size;
    s["estimated_error"] = report.estimated_error;
    if (report.verified_error >= 0) s["verified_error"] = report.verified_error;
  }
  s["steps"] = report.steps;
  s["dt_s"] = r.scene.time.step_s;
}

/// How the skin moves.
void add_motion(const Results& r, Json& s) {
  const auto& report = r.simulation.report;
  const auto& p = r.simulation.performance;
  s["frames"] = p.frame_time_s.size();
  s["driven_nodes"] = report.driven_nodes;
  s["driven_points_off_mm"] = report.driven_off_mm;
  s["skull_nodes"] = report.skull_nodes;
  s["mandible_nodes"] = report.mandible_nodes;
  s["peak_time_s"] = p.frame_time_s[p.peak_frame];
  s["max_displacement_mm"] = 1e3 * metrics::greatest_displacement_m(p.skin_displacement_m);
  s["lip_opening_mm"] = report.lip_gap_mm;
  s["lip_overlap_mm"] = report.lip_overlap_mm;
}

/// Depths of penetration with and without the correction by contact.
void add_contact(const Results& r, Json& s) {
  const auto& c = r.scene.contact;
  if (!c.any()) return;
  const simulate::SimulationReport::Contact& found = r.simulation.report.contact;
  Json& contact = s["contact"] = {{"frames", found.frames}, {"residual_mm", found.residual_mm}};
  const auto add = [&](bool on, const char* what, double without_mm, double mm) {
    if (!on) return;
    contact[fmt::format("{}_without_mm", what)] = without_mm;
    contact[fmt::format("{}_mm", what)] = mm;
  };
  add(c.lips, "lip_overlap", found.overlap_mm, found.left_mm);
  add(c.teeth, "in_teeth", found.teeth_mm, found.teeth_left_mm);
  add(c.eyes, "in_eyes", found.eyes_mm, found.eyes_left_mm);
}

/// The shape of mouth and skin at the peak.
void add_peak_shape(const Results& r, Json& s) {
  const auto& p = r.simulation.performance;
  const PointsF& displacement = p.skin_displacement_m[std::size_t(p.peak_frame)];
  if (const auto outline = metrics::mouth_outline(
          p.skin_rest, metrics::mouth_rim(p.skin_rest, r.inputs.landmarks), displacement))
    s["mouth_outline_at_peak"] = {{"turning_deg", outline->turning_deg},
                                  {"largest_jump_mm", outline->largest_jump_mm}};
  const metrics::Roughness rough = metrics::roughness(p.skin_rest, displacement);
  if (rough.judged > 0)
    s["roughness_at_peak"] = {{"rms_mm", rough.rms_mm}, {"p99_mm", rough.p99_mm}};
  for (const metrics::PartRoughness& part :
       metrics::roughness_by_part(rough, p.skin_rest.points, r.inputs.landmarks))
    s["roughness_at_peak"][part.part + "_rms_mm"] = part.rms_mm;
}

/// Least and greatest value of each parameter over the elements.
Json tissue_json(const tissue::TissueField& field) {
  Json out = Json::object();
  for (int p = 0; p < tissue::parameter_count; ++p) {
    const auto [low, high] = std::minmax_element(field.element[p].begin(), field.element[p].end());
    const tissue::ParameterInfo& info = tissue::parameter_info(p);
    out[info.key] = {*low / info.si, *high / info.si};
  }
  return out;
}

}  // namespace

Json summary_of(const session::FaceSession& session, const Results& r) {
  const auto& report = r.simulation.report;
  const auto& p = r.simulation.performance;
  Json s;
  s["program"] = "hyperex";
  s["version"] = version();
  if (!commit().empty()) s["commit"] = commit();
  s["title"] = r.scene.title;
  s["nodes"] = p.nodes.rows();
  s["tets"] = p.tets.rows();
  s["free_dofs"] = report.free_dofs;
  s["skin_vertices"] = (r.mesh.full ? r.mesh.full->skin : p.skin_rest).points.rows();
  if (r.mesh.full) s["thinned_skin_vertices"] = p.skin_rest.points.rows();
  add_solver(r, s);
  add_motion(r, s);
  add_contact(r, s);
  add_peak_shape(r, s);
  s["jaw_opening_deg"] = report.greatest_opening_deg;
  s["inverted_tets"] = report.inverted_tets;
  s["at_peak"] = metrics::json_of(session.tissue_at_peak());
  const bool head_known = r.inputs.head_uncertainty_known;
  s["head_shift_uncertainty_mm"] =
      head_known ? Json(r.inputs.head_shift_uncertainty_mm) : Json(nullptr);
  s["head_turn_uncertainty_deg"] =
      head_known ? Json(r.inputs.head_turn_uncertainty_deg) : Json(nullptr);
  s["mesh_quality"] = quality_json(r.mesh, session.skin_off());
  s["symmetry"] = metrics::summary_of(r.symmetry);
  if (r.uncertainty)
    s["uncertainty"] = metrics::json_of(*r.uncertainty, p.skin_rest, r.inputs.landmarks);
  if (!p.muscles.names.empty()) s["muscles"] = activations_json(p.muscles);
  if (r.tissue) s["tissue"] = tissue_json(*r.tissue);
  return s;
}

Json options_in_use(const scene::Scene& scene, const session::Inputs& inputs) {
  Json options = scene::echoed_options(scene);
  if (session::drives_by_default(scene) && options.contains("drive") &&
      options["drive"].contains("points"))
    options["drive"]["points"] = inputs.driven;
  return options;
}

}  // namespace hyperex::run
