// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/pipeline.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "hyperex/core/files.hpp"
#include "hyperex/core/output_directory.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/core/run_together.hpp"
#include "hyperex/core/stopwatch.hpp"
#include "hyperex/core/version.hpp"
#include "hyperex/metrics/mouth_outline.hpp"
#include "hyperex/metrics/roughness.hpp"
#include "hyperex/metrics/symmetry_json.hpp"
#include "hyperex/metrics/variant_difference.hpp"
#include "hyperex/run/activations.hpp"
#include "hyperex/run/earlier_run.hpp"
#include "hyperex/run/frames.hpp"
#include "hyperex/run/outputs.hpp"
#include "hyperex/run/report_page.hpp"
#include "hyperex/run/variants.hpp"
#include "hyperex/scene/file_names.hpp"
#include "hyperex/session/drive_choice.hpp"
#include "hyperex/session/kept_order.hpp"
#include "hyperex/session/landmark_search.hpp"
#include "hyperex/session/obstacles.hpp"
#include "hyperex/session/plausible.hpp"
#include "hyperex/session/prepared_face.hpp"
#include "hyperex/session/run_notes.hpp"
#include "hyperex/session/simulation_options.hpp"
#include "hyperex/session/symmetry_measures.hpp"
#include "hyperex/session/teeth.hpp"
#include "hyperex/session/tissue_fields.hpp"
#include "hyperex/tissue/field/tissue_field.hpp"

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

Json summary_of(const Results& r, const session::SkinOff& off) {
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
  s["linear_solver"] = fem::to_string(report.linear_solver);
  s["input_shapes"] = report.input_shapes;
  if (report.basis_size > 0) {
    s["basis_size"] = report.basis_size;
    s["estimated_error"] = report.estimated_error;
    if (report.verified_error >= 0) s["verified_error"] = report.verified_error;
  }
  s["steps"] = report.steps;
  s["dt_s"] = r.scene.time.step_s;
  s["frames"] = p.frame_time_s.size();
  s["driven_nodes"] = report.driven_nodes;
  s["driven_points_off_mm"] = report.driven_off_mm;
  s["skull_nodes"] = report.skull_nodes;
  s["mandible_nodes"] = report.mandible_nodes;
  s["peak_time_s"] = p.frame_time_s[p.peak_frame];
  s["max_displacement_mm"] = 1e3 * metrics::greatest_displacement_m(p.skin_displacement_m);
  s["lip_opening_mm"] = report.lip_gap_mm;
  s["lip_overlap_mm"] = report.lip_overlap_mm;
  if (const auto& c = r.scene.contact; c.any()) {
    const simulate::SimulationReport::Contact& told = report.contact;
    Json& contact = s["contact"] = {{"frames", told.frames}, {"residual_mm", told.residual_mm}};
    const auto add = [&](bool on, const char* what, double without_mm, double mm) {
      if (!on) return;
      contact[fmt::format("{}_without_mm", what)] = without_mm;
      contact[fmt::format("{}_mm", what)] = mm;
    };
    add(c.lips, "lip_overlap", told.overlap_mm, told.left_mm);
    add(c.teeth, "in_teeth", told.teeth_mm, told.teeth_left_mm);
    add(c.eyes, "in_eyes", told.eyes_mm, told.eyes_left_mm);
  }
  if (const auto outline =
          metrics::mouth_outline(p.skin_rest, metrics::mouth_rim(p.skin_rest, r.inputs.landmarks),
                                 p.skin_displacement_m[std::size_t(p.peak_frame)]))
    s["mouth_outline_at_peak"] = {{"turning_deg", outline->turning_deg},
                                  {"largest_jump_mm", outline->largest_jump_mm}};
  const metrics::Roughness rough =
      metrics::roughness(p.skin_rest, p.skin_displacement_m[std::size_t(p.peak_frame)]);
  if (rough.judged > 0)
    s["roughness_at_peak"] = {{"rms_mm", rough.rms_mm}, {"p99_mm", rough.p99_mm}};
  s["jaw_opening_deg"] = report.greatest_opening_deg;
  s["inverted_tets"] = report.inverted_tets;
  s["at_peak"] = stress_summary(p);
  s["head_shift_uncertainty_mm"] = r.inputs.head_shift_uncertainty_mm;
  s["head_turn_uncertainty_deg"] = r.inputs.head_turn_uncertainty_deg;
  s["mesh_quality"] = quality_json(r.mesh, off);
  s["symmetry"] = metrics::summary_of(r.symmetry);
  if (!p.muscles.names.empty()) s["muscles"] = activations_json(p.muscles, p.driven_names.size());
  return s;
}

/// At finite strain: single elements whose volume changes much. Patches of them keep theirs, so
/// that the skin's motion is hardly affected.
std::vector<std::string> volume_warning(const Json& at_peak) {
  constexpr double kMuch = 3;
  if (!at_peak.is_object() || !at_peak.contains("volume_ratio")) return {};
  const Json& volume = at_peak["volume_ratio"];
  if (!volume.is_object()) return {};
  const double least = volume["min"], most = volume["max"];
  if (least * kMuch >= 1 && most <= kMuch) return {};
  return {fmt::format(
      "at the peak the volume of single elements is {:.2f} to {:.2f} times that at "
      "rest (99 % below {:.2f}): their stress says little; use percentiles, or a finer mesh there",
      least, most, volume["p99"].get<double>())};
}

/// After what was noted so far.
class NotesPlace {
 public:
  explicit NotesPlace(const Results& results)
      : notes_(std::ptrdiff_t(results.notes.size())),
        warnings_(std::ptrdiff_t(results.warnings.size())) {}

  /// Told now, noted there: what is known late may come before what was known sooner.
  void warn(const std::vector<std::string>& notes, Results& results) const {
    for (const std::string& note : notes) spdlog::warn("{}", note);
    results.notes.insert(results.notes.begin() + notes_, notes.begin(), notes.end());
    results.warnings.insert(results.warnings.begin() + warnings_, notes.begin(), notes.end());
  }

 private:
  std::ptrdiff_t notes_, warnings_;
};

void warn(const std::vector<std::string>& notes, Results& results) {
  NotesPlace(results).warn(notes, results);
}
void warn(const std::vector<Note>& notes, Results& results) {
  std::vector<std::string> texts;
  for (const Note& note : notes) texts.push_back(note.text);
  warn(texts, results);
}

}  // namespace

Checked check_scene(const scene::Scene& scene) {
  const session::Inputs inputs = [&] {
    Progress progress("reading scan and recording", 0);
    return session::read_inputs(scene, session::Look::quick);
  }();
  std::vector<std::string> notes = inputs.notes;
  const auto has_regions = [](const scene::Scene& s) { return !s.tissue.regions.empty(); };
  if (has_regions(scene) ||
      std::any_of(scene.variants.begin(), scene.variants.end(),
                  [&](const scene::Variant& variant) { return has_regions(variant.scene); }))
    notes.push_back(
        "not checked: whether the regions of the tissue lie on this scan and which values their "
        "factors lead to");
  return {notes, inputs.warnings};
}

namespace {
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

simulate::SimulationResult run_with_bar(simulate::Simulator& simulator) {
  constexpr long parts = 1000;
  Progress progress("simulating", parts);
  simulate::RunCallbacks callbacks;
  callbacks.progress = [&](double share) { progress.update(static_cast<long>(share * parts)); };
  return simulator.run(callbacks);
}

Json run_into(scene::Scene scene, const std::filesystem::path& directory) {
  Stopwatch total, stage;
  Json seconds;
  session::Inputs inputs;
  {
    Progress progress("reading scan and recording", 0);
    inputs = session::read_inputs(scene);
    session::choose_drive(scene, inputs);
  }
  seconds["read"] = stage.lap();
  for (const auto& note : inputs.notes) spdlog::info("{}", note);
  for (const auto& warning : inputs.warnings) spdlog::warn("{}", warning);

  std::optional<session::LandmarkSearch> search;  // beside all else
  const session::PreparedFace face = [&] {
    Progress progress("meshing the soft tissue", 0);
    return session::prepare_face(scene, inputs, [&] {
      if (!scene.scan.landmarks.empty()) search.emplace(inputs, scene.kept);
    });
  }();
  const tissue::TissueMesh& mesh = *face.mesh;
  const metrics::RestAsymmetry& at_rest = face.at_rest;
  seconds["mesh"] = stage.lap();
  for (const auto& note : mesh.notes) spdlog::info("{}", note);
  spdlog::info("{} nodes, {} tetrahedra under {} vertices of skin", mesh.volume.nodes.rows(),
               mesh.volume.tets.rows(), mesh.skin.points.rows());

  simulate::SimulationOptions options = session::simulation_options(scene, inputs);
  session::TissueFields fields(inputs, mesh);
  const std::optional<tissue::TissueField> field = fields.of(scene);
  if (field) options.tissue.element = field->element;
  std::vector<VariantRun> variants = session::prepare_variants(scene, inputs, fields);
  seconds["tissue"] = stage.lap();

  simulate::Simulator simulator(face.mesh, inputs.landmarks, inputs.motion, std::move(options));
  std::vector<std::string> teeth_notes;
  std::shared_ptr<const anatomy::Teeth> teeth;
  {
    Progress progress("assembling and factoring", 0);
    run_together({[&] { session::prepare_with_kept_order(scene, inputs, simulator); },
                  [&] { teeth = session::teeth_of(scene, inputs, mesh, teeth_notes); }});
  }
  for (const auto& note : teeth_notes) spdlog::info("{}", note);
  simulator.set_obstacles(session::obstacles_of(scene, inputs, mesh, teeth.get()));
  const simulate::Simulator before_run = simulator;
  simulate::SimulationResult simulation;
  session::MirroredTwin twin;
  run_together({[&] { simulation = run_with_bar(simulator); },
                [&] {
                  twin = session::simulate_twin(scene, inputs, field ? &*field : nullptr,
                                                at_rest.plane, before_run);
                }});
  stage.lap();
  seconds["assemble"] = simulation.report.assemble_s;
  seconds["analyse"] = simulation.report.analyse_s;
  seconds["factor"] = simulation.report.factor_s;
  seconds["basis"] = simulation.report.basis_s;
  seconds["simulate"] = simulation.report.simulate_s;

  metrics::SymmetryMeasures symmetry;
  session::SkinOff off;
  {
    Progress measuring("measuring", 0);
    run_together({[&] {
                    symmetry = session::symmetry_measures(scene, inputs, at_rest,
                                                          simulation.performance, twin);
                  },
                  [&] { off = session::skin_off_scan(mesh, inputs.landmarks); }});
  }
  Results results{scene,
                  inputs,
                  mesh,
                  simulation,
                  std::move(symmetry),
                  inputs.notes,
                  {},
                  field ? &*field : nullptr,
                  {},
                  teeth.get()};
  results.notes.insert(results.notes.end(), mesh.notes.begin(), mesh.notes.end());
  results.notes.insert(results.notes.end(), teeth_notes.begin(), teeth_notes.end());
  results.notes.insert(results.notes.end(), inputs.warnings.begin(), inputs.warnings.end());
  results.warnings = inputs.warnings;
  if (const auto warning = session::skin_warning(off); !warning.empty())
    warn(std::vector{warning}, results);
  for (const Note& note : session::notes_on_contact_and_elements(
           simulation.report, simulation.performance, scene.contact)) {
    results.notes.push_back(note.text);
    if (note.id == "contact.none") spdlog::info("{}", note.text);
  }
  warn(session::run_warnings(simulation.report, simulation.performance), results);
  const NotesPlace before_doubts(results);
  if (const auto& note = results.symmetry.map->plane.note; !note.empty())
    warn(std::vector{note}, results);
  if (!twin.why_not.empty())
    results.notes.push_back("the mesh's own floor of symmetry is not known: " + twin.why_not);
  Json summary = summary_of(results, off);
  warn(volume_warning(summary["at_peak"]), results);
  if (field) summary["tissue"] = tissue_json(*field);
  // The scene's own files are written on one core while its variants are simulated.
  std::optional<report::GlbReport> glb;
  run_together({[&] { glb = write_outputs(results, directory); },
                [&] {
                  if (scene.output.report)
                    results.modes =
                        report::displacement_modes(simulation.performance.skin_displacement_m);
                },
                [&] {
                  if (variants.empty()) return;
                  Stopwatch own;
                  session::simulate_variants(variants, simulator, twin, *results.symmetry.map);
                  seconds["variants"] = own.lap();
                  summary["variants"] = write_variants(results, variants, mesh, directory);
                }});
  if (search) before_doubts.warn(search->doubts(results.warnings), results);
  if (glb) {
    summary["glb"] = glb_json(*glb);
    if (const auto note = glb_note(scene.output, *glb); !note.empty())
      warn(std::vector{note}, results);
  }
  if (!variants.empty()) {
    warn(session::variant_warnings(simulation, variants), results);
  }
  seconds["export"] = stage.lap() - seconds.value("variants", 0.0);
  seconds["total"] = total.lap();
  summary["seconds"] = seconds;
  for (std::string& note : results.notes) note = scene::with_file_names(scene, note);
  summary["notes"] = results.notes;
  for (std::string& warning : results.warnings) warning = scene::with_file_names(scene, warning);
  summary["warnings"] = results.warnings;
  summary["options"] = scene::echoed_options(scene);
  if (scene.output.report) {
    write_report(results, variants, summary, directory);
    seconds["export"] = seconds["export"].get<double>() + stage.lap();
    seconds["total"] = seconds["total"].get<double>() + total.lap();
    summary["seconds"] = seconds;
  }
  // A later run into the same folder removes these and nothing else.
  std::vector<std::string> files = files_below(directory);
  files.push_back("summary.json");
  summary["files"] = files;
  write_file_atomically(directory / "summary.json", [&](std::ostream& stream) {
    // A path need not be UTF-8.
    stream << summary.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
  });
  return summary;
}
}  // namespace

nlohmann::ordered_json run_scene(const scene::Scene& scene,
                                 const std::filesystem::path& directory) {
  OutputDirectory out(directory, files_of_earlier_run, files_named_by(scene));
  try {
    Json summary = run_into(scene, out.path());
    out.commit();
    return summary;
  } catch (const InputError& error) {
    throw InputError(out.with_own_name(error.what()));
  }
}

}  // namespace hyperex::run
