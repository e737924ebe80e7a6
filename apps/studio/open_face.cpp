// SPDX-License-Identifier: GPL-3.0-or-later
#include "open_face.hpp"

#include <algorithm>

#include "hyperex/core/error.hpp"
#include "hyperex/metrics/symmetry_json.hpp"
#include "hyperex/run/report_page.hpp"
#include "hyperex/run/variants.hpp"
#include "hyperex/scene/scene_text.hpp"
#include "hyperex/session/drive_choice.hpp"
#include "hyperex/session/driven_points.hpp"
#include "hyperex/session/kept_order.hpp"
#include "hyperex/session/obstacles.hpp"
#include "hyperex/session/plausible.hpp"
#include "hyperex/session/run_notes.hpp"
#include "hyperex/session/simulation_options.hpp"
#include "hyperex/session/symmetry_measures.hpp"
#include "hyperex/session/teeth.hpp"
#include "hyperex/tissue/mesh/skin_depth.hpp"
#include "live.hpp"

namespace hyperex::studio {

using nlohmann::json;

namespace {

/// Not known while one edits: it takes a run of the mirrored face.
constexpr const char* kNoTwin = "no mirrored twin was run yet, as one edits";

/// What of a scene and its variants may touch something.
std::vector<bool> contact_of(const scene::Scene& scene) {
  std::vector<bool> out{scene.contact.teeth, scene.contact.eyes};
  for (const scene::Variant& variant : scene.variants) {
    out[0] = out[0] || variant.scene.contact.teeth;
    out[1] = out[1] || variant.scene.contact.eyes;
  }
  return out;
}

/// Whether one is read, meshed and aligned as the other; but for the value of a key.
bool same_face(const scene::Scene& a, const scene::Scene& b, const char* but = nullptr) {
  json one = values_of(a), other = values_of(b);
  if (but) {
    one.erase(but);
    other.erase(but);
  }
  for (json* values : {&one, &other})
    for (auto it = values->begin(); it != values->end();) {
      const std::string& key = it.key();
      const auto in = [&](const char* section) { return key.rfind(section, 0) == 0; };
      const bool of_face = in("scan.") || in("mesh.") || in("alignment.") || in("teeth.") ||
                           (in("motion.") && key != "motion.gain");
      it = of_face ? std::next(it) : values->erase(it);
    }
  return one == other;
}

}  // namespace

json values_of(const scene::Scene& scene) {
  json out = json::object();
  const json sections = scene::options_json(scene);
  for (const auto& [section, keys] : sections.items()) {
    if (!keys.is_object()) {
      out[section] = keys;
      continue;
    }
    for (const auto& [key, value] : keys.items()) out[section + "." + key] = value;
  }
  return out;
}

OpenFace::OpenFace(std::string text, std::filesystem::path file, KeptResults kept,
                   const Stage& stage)
    : text_(std::move(text)) {
  scene::Scene scene = scene::read_scene_text(text_, file);
  scene.kept = kept;
  stage("reading scan and recording");
  inputs_ = session::read_inputs(scene);
  own_notes_ = inputs_.notes.size();
  stage("meshing the soft tissue");
  face_ = session::prepare_face(scene, inputs_, [] {});
  warnings_ = inputs_.warnings;
  if (const std::string off =
          session::skin_warning(session::skin_off_scan(*face_.mesh, inputs_.landmarks));
      !off.empty())
    warnings_.push_back(off);
  fields_ = std::make_unique<session::TissueFields>(inputs_, *face_.mesh);
  teeth_ = session::teeth_of(scene, inputs_, *face_.mesh, teeth_notes_);
  stage("assembling and factoring");
  take(std::move(scene));
  session::prepare_with_kept_order(scene_, inputs_, *simulator_);
}

simulate::SimulationOptions OpenFace::options_of(
    const scene::Scene& scene, const session::Inputs& inputs,
    const std::optional<tissue::TissueField>& field) const {
  simulate::SimulationOptions options = session::simulation_options(scene, inputs);
  if (field) options.tissue.element = field->element;
  return options;
}

bool OpenFace::set_text(const std::string& text) {
  scene::Scene next = scene::read_scene_text(text, scene_.file);
  next.kept = scene_.kept;
  if (!same_face(scene_, next)) return false;
  take(std::move(next));
  text_ = text;
  return true;
}

/// Everything that may throw comes before anything is changed.
void OpenFace::take(scene::Scene next) {
  const session::DriveChoice choice = session::drive_choice(next, inputs_);
  next.drive.by = choice.by;
  const std::vector<std::string> driven = session::driven_points(next, inputs_.motion.motion);
  session::Inputs& inputs = inputs_;
  std::vector<std::string> before = std::exchange(inputs.driven, driven);
  std::optional<tissue::TissueField> field;
  std::vector<session::VariantRun> runs;
  simulate::SimulationOptions options;
  std::vector<simulate::SimulationOptions> of_runs;
  try {
    field = fields_->of(next);
    runs = session::prepare_variants(next, inputs, *fields_);
    options = options_of(next, inputs, field);
    check(options);
    for (const session::VariantRun& run : runs) {
      of_runs.push_back(options_of(run.scene, run.inputs, run.field));
      check(of_runs.back());
    }
  } catch (...) {
    inputs.driven = std::move(before);
    throw;
  }
  drive_why_ = choice.why;
  inputs.notes.resize(own_notes_);
  inputs.notes.push_back(choice.why);
  scene_ = std::move(next);
  field_ = std::move(field);
  const bool same_base = simulator_ && simulator_->options() == options;
  if (!simulator_) {
    simulator_.emplace(face_.mesh, inputs.landmarks, inputs.motion, options);
  } else if (next_base_ && next_base_->options() == options) {
    simulator_ = std::move(next_base_);
  } else if (!same_base) {
    simulator_->set_options(options);
    next_variant_.reset();
  }
  next_base_.reset();
  if (contact_of(scene_) != touched_) {
    // Built where a scene or a variant first asks for it: a grid of distances takes a moment.
    touched_ = contact_of(scene_);
    simulator_->set_obstacles(session::obstacles_of(scene_, inputs, *face_.mesh, teeth_.get()));
    next_variant_.reset();
  }
  stale_ = stale_ || !same_base;
  std::vector<session::VariantRun> old_runs = std::exchange(runs_, std::move(runs));
  std::vector<Standing> old = std::exchange(standing_, std::vector<Standing>(runs_.size()));
  for (std::size_t i = 0; i < runs_.size() && same_base; ++i) {
    std::size_t known = 0;
    while (known < old.size() &&
           !(old[known].simulator && old_runs[known].scene.title == runs_[i].scene.title))
      ++known;
    if (known == old.size()) continue;
    Standing& now = standing_[i];
    now.simulator = std::exchange(old[known].simulator, std::nullopt);
    now.stale = old[known].stale || now.simulator->options() != of_runs[i];
    now.bands = !now.stale && old[known].bands;
    if (!now.stale) {
      runs_[i].simulation = std::move(old_runs[known].simulation);
      runs_[i].symmetry = std::move(old_runs[known].symmetry);
      continue;
    }
    try {
      now.simulator->set_options(of_runs[i]);
    } catch (const InputError&) {
      now.simulator.reset();  // a run will make another, or say why it cannot
    }
  }
}

simulate::Simulator& OpenFace::simulator_of(std::size_t face) {
  if (face == 0) return *simulator_;
  std::optional<simulate::Simulator>& own = standing_.at(face - 1).simulator;
  if (!own) {
    const session::VariantRun& run = runs_[face - 1];
    if (!next_variant_) simulator_->still(0);  // finds the forces, where there are none yet
    simulate::Simulator made = next_variant_ ? std::move(*next_variant_) : *simulator_;
    next_variant_.reset();
    made.hold_load();
    made.set_options(options_of(run.scene, run.inputs, run.field));
    own = std::move(made);
  }
  return *own;
}

void OpenFace::expect_variant() {
  // At finite strain the run of base itself completes what a variant keeps.
  if (!runs_.empty() || next_variant_ || scene_.model.strain == simulate::Strain::finite) return;
  const scene::Scene next = scene::read_scene_text(
      scene::with_variants(text_, {{{"name", "next"}, {"motion", {{"gain", scene_.drive.gain}}}}}),
      scene_.file);
  scene::Scene base = next;
  base.drive.by = session::drive_choice(next, inputs_).by;
  session::Inputs inputs = inputs_;
  inputs.driven = session::driven_points(base, inputs.motion.motion);
  simulate::SimulationOptions options = options_of(base, inputs, field_);
  if (!(options == simulator_->options())) {
    next_base_ = *simulator_;
    next_base_->set_options(std::move(options));
    next_base_->still(0);
  }
  next_variant_ = next_base_ ? *next_base_ : *simulator_;
  next_variant_->hold_load();
  next_variant_->still(0);
}

bool OpenFace::ready(std::size_t face) const {
  return face == 0 || next_variant_ || standing_.at(face - 1).simulator;
}

PointsF OpenFace::still(std::size_t face, double time_s) {
  return simulator_of(face).still(time_s);
}

simulate::SimulationOptions OpenFace::options_live(std::size_t face,
                                                   const std::vector<std::string>& points) const {
  if (face > runs_.size()) throw InputError("face: there is none of this number");
  const scene::Scene& scene = face == 0 ? scene_ : runs_[face - 1].scene;
  motion::Motion named;
  named.names = points;
  simulate::SimulationOptions options =
      face == 0 ? options_of(scene_, inputs_, field_)
                : options_of(scene, runs_[face - 1].inputs, runs_[face - 1].field);
  options.drive.points = session::driven_points(scene, named);
  for (const std::string& point : options.drive.points)
    if (std::find(points.begin(), points.end(), point) == points.end())
      throw InputError("drive.points", point + ": not tracked live");
  if (options.region.measured != simulate::Measured::none)
    throw InputError("region.measured", "live the whole skin is simulated: expected none");
  return live_options(std::move(options));
}

Eigen::VectorXd OpenFace::region_shares(const std::string& text) {
  return fields_->region_shares(scene::read_scene_text(text, scene_.file), 0);
}

Eigen::VectorXf OpenFace::unpainted_mm() const {
  tissue::TissueMeshOptions options = scene_.mesh;
  options.depth_regions.clear();
  return (1e3 * tissue::skin_depth(*face_.mesh, inputs_.landmarks, options)).cast<float>();
}

bool OpenFace::same_skin(const OpenFace& other) const {
  const TriMesh &own = mesh().skin, &others = other.mesh().skin;
  return same_face(scene_, other.scene_, "mesh.thickness_region") &&
         own.points.rows() == others.points.rows() && own.points == others.points &&
         own.triangles.rows() == others.triangles.rows() && own.triangles == others.triangles;
}

bool OpenFace::up_to_date() const {
  return !stale_ && std::none_of(standing_.begin(), standing_.end(),
                                 [](const Standing& one) { return one.stale; });
}

void OpenFace::run(const simulate::RunCallbacks& callbacks) {
  const session::MirroredTwin twin{
      .why_not = kNoTwin, .landmarks = {}, .skin_displacement_m = {}, .simulator = {}};
  if (stale_) {
    simulation_ = simulator_->run(callbacks);
    symmetry_ =
        session::symmetry_measures(scene_, inputs_, face_.at_rest, simulation_.performance, twin);
    modes_ = report::displacement_modes(simulation_.performance.skin_displacement_m);
    stale_ = false;
    twin_.reset();
    // At finite strain the run completed the load (what holds the patches): copies made before it
    // lack that.
    if (scene_.model.strain == simulate::Strain::finite)
      for (Standing& one : standing_) one = {};
  }
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    if (!standing_[i].stale) continue;
    session::VariantRun& run = runs_[i];
    run.simulation = simulator_of(i + 1).run(callbacks);
    run.symmetry = session::symmetry_measures(run.scene, run.inputs, face_.at_rest,
                                              run.simulation.performance, twin);
    standing_[i].stale = standing_[i].bands = false;
  }
}

bool OpenFace::bands_known() const {
  return up_to_date() && twin_ &&
         std::all_of(standing_.begin(), standing_.end(),
                     [](const Standing& one) { return one.bands; });
}

void OpenFace::find_bands(const std::function<bool()>& cancelled) {
  const metrics::MidsagittalPlane& plane = face_.at_rest.plane;
  if (!twin_) {
    twin_ = session::simulate_twin(scene_, inputs_, field_ ? &*field_ : nullptr, plane, *simulator_,
                                   cancelled);
    symmetry_ =
        session::symmetry_measures(scene_, inputs_, face_.at_rest, simulation_.performance, *twin_);
    twin_->skin_displacement_m.clear();
  }
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    if (standing_[i].bands) continue;
    session::VariantRun& run = runs_[i];
    simulate::Simulator spent = simulator_of(i + 1);
    const session::MirroredTwin twin = session::simulate_variants_twin(
        run.scene, run.inputs, run.field ? &*run.field : nullptr, plane, spent, *twin_, cancelled);
    run.symmetry = session::symmetry_measures(run.scene, run.inputs, face_.at_rest,
                                              run.simulation.performance, twin);
    standing_[i].bands = true;
  }
}

run::Results OpenFace::results() const {
  run::Results out{scene_,    inputs_,       *face_.mesh, simulation_,
                   symmetry_, inputs_.notes, modes_,      field_ ? &*field_ : nullptr,
                   warnings_};
  out.teeth = teeth_.get();
  out.notes.insert(out.notes.end(), teeth_notes_.begin(), teeth_notes_.end());
  out.notes.insert(out.notes.end(), face_.mesh->notes.begin(), face_.mesh->notes.end());
  out.notes.insert(out.notes.end(), warnings_.begin(), warnings_.end());
  std::vector<Note> found = session::run_warnings(simulation_.report, simulation_.performance);
  if (up_to_date())
    for (Note& note : session::variant_warnings(simulation_, runs_))
      found.push_back(std::move(note));
  for (const Note& note : found) {
    out.notes.push_back(note.text);
    out.warnings.push_back(note.text);
  }
  return out;
}

json OpenFace::replay(report::BinaryBlock& block, bool with_face) const {
  const run::Results all = results();
  json summary;
  summary["symmetry"] = metrics::summary_of(symmetry_);
  summary["warnings"] = all.warnings;
  summary["peak_time_s"] =
      simulation_.performance.frame_time_s[std::size_t(simulation_.performance.peak_frame)];
  if (!runs_.empty()) summary["variants"] = {{"table", run::variant_table(all, runs_)}};
  const run::ReplayPage page(all, runs_, summary);
  return report::replay_manifest(page.input(), block, with_face);
}

json OpenFace::activations(report::BinaryBlock& block) const {
  const simulate::MuscleCourse& base = simulation_.performance.muscles;
  if (base.names.empty()) return nullptr;
  const auto rows = [&](const simulate::MuscleCourse& course) {
    if (course.names != base.names) return json();
    std::vector<float> values;
    for (const auto& row : course.activation.rowwise())
      values.insert(values.end(), row.begin(), row.end());
    return block.add(values);
  };
  json faces = json::array({rows(base)});
  for (const session::VariantRun& run : runs_)
    faces.push_back(rows(run.simulation.performance.muscles));
  return {{"names", base.names}, {"time_s", base.time_s}, {"faces", faces}};
}

}  // namespace hyperex::studio
