// SPDX-License-Identifier: GPL-3.0-or-later
// From the inputs to a face that is ready to run.
#include "hyperex/session/face_session.hpp"

#include <algorithm>
#include <utility>

#include "hyperex/core/error.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/core/run_together.hpp"
#include "hyperex/core/stopwatch.hpp"
#include "hyperex/session/driven_points.hpp"
#include "hyperex/session/face_options.hpp"
#include "hyperex/session/face_session_impl.hpp"
#include "hyperex/session/kept_order.hpp"
#include "hyperex/session/obstacles.hpp"
#include "hyperex/session/same_face.hpp"
#include "hyperex/session/teeth.hpp"
#include "hyperex/session/try_face.hpp"

namespace hyperex::session {
namespace {

scene::GivenFace given_face(Face face, motion::Motion motion) {
  if (motion.source.empty()) motion.source = "the motion";
  if (face.scan.file.empty()) face.scan.file = "the scan";
  return {std::make_shared<const io::Scan>(std::move(face.scan)), std::move(face.landmarks),
          std::make_shared<const motion::Motion>(std::move(motion))};
}

}  // namespace

FaceSession::Impl::Impl(SceneSource given, SessionOptions options)
    : session_options(std::move(options)), source(std::move(given)) {
  const scene::Scene first = source.scene();
  scene = first;
  read();
  mesh();
  fields = std::make_unique<TissueFields>(inputs, *face.mesh);
  Stopwatch watch;
  take_at_first(first);
  seconds.tissue = watch.lap();
  note_tissue();
  begin_stage("assembling and factoring");
  Progress progress("assembling and factoring", 0);
  run_together({[&] { prepare_with_kept_order(scene, inputs, *simulator); },
                [&] {
                  teeth = teeth_of(scene, inputs, *face.mesh, teeth_notes);
                  skin_off = skin_off_scan(*face.mesh, inputs.landmarks);
                }});
  report(teeth_notes);
  if (auto warning = skin_warning(skin_off)) {
    report({*warning});
    skin_notes.push_back(*std::move(warning));
  }
  set_obstacles();
}

void FaceSession::Impl::begin_stage(const std::string& name) const {
  if (session_options.stage) session_options.stage(name);
}

void FaceSession::Impl::report(const std::vector<Note>& notes) const {
  if (session_options.note)
    for (const Note& note : notes) session_options.note(note);
}

void FaceSession::Impl::read() {
  begin_stage("reading scan and recording");
  Progress progress("reading scan and recording", 0);
  Stopwatch watch;
  inputs = read_inputs(scene, Extent::full, !session_options.leave_out_variants);
  drive = drive_choice(scene);
  seconds.read = watch.lap();
  report(notes_on_inputs(Severity::note));
  report(notes_on_inputs(Severity::warning));
  if (session_options.inputs) session_options.inputs(inputs);
}

void FaceSession::Impl::mesh() {
  begin_stage("meshing the soft tissue");
  Progress progress("meshing the soft tissue", 0);
  Stopwatch watch;
  whole_scan = inputs.scan;
  face = prepare_face(scene, inputs, [&] {
    if (with_runs()) begin_search();
  });
  if (!face.mesh->full) whole_scan.reset();
  seconds.mesh = watch.lap();
  report(face.mesh->notes);
}

/// Everything that may throw comes before anything is changed.
void FaceSession::Impl::take(scene::Scene next) {
  DriveChoice choice = drive_choice(next);
  next.drive.by = choice.by;
  std::vector<std::string> driven_before =
      std::exchange(inputs.driven, driven_points(next, inputs.motion.motion));
  FaceOptions now;
  bool same_base = false;
  try {
    now = face_options(next, inputs, *fields);
    same_base = simulator && simulator->options() == now.base;
    if (!simulator)
      simulator.emplace(face.mesh, inputs.landmarks, inputs.motion, now.base);
    else if (!same_base)
      simulator->set_options(now.base);
  } catch (...) {
    inputs.driven = std::move(driven_before);
    throw;
  }
  drive = std::move(choice);
  scene = std::move(next);
  field = std::move(now.field);
  if (!same_base) next_variant.reset();
  stale = stale || !same_base;
  std::vector<VariantRun> before = std::exchange(runs, std::move(now.runs));
  keep_variants(std::move(before), same_base);
}

/// Throws what a run would before it begins. Where the options say so, variants that cannot be run
/// are left out: each is then tried alone.
void FaceSession::Impl::take_at_first(const scene::Scene& given) {
  const bool leave_out = session_options.leave_out_variants && !given.variants.empty();
  const auto take_and_check = [&](const scene::Scene& next) {
    if (leave_out) check_names_of_variants(next, inputs);  // else read() did
    take(next);
    check_faces_before_run(*simulator, runs);
  };
  try {
    return take_and_check(given);
  } catch (const InputError&) {
    if (!leave_out) throw;
  }
  std::vector<scene::Variant> sound;
  scene::Scene next = given;
  for (const scene::Variant& variant : given.variants) {
    try {
      next.variants = {variant};
      take_and_check(next);
      sound.push_back(variant);
    } catch (const InputError& error) {
      left_out.push_back({variant.number, variant.name, error.what()});
    }
  }
  next.variants = std::move(sound);
  take_and_check(next);  // also throws what is wrong with base
  source.replace(std::move(next));
}

/// Keeps the results of variants of the same name, as far as they are still valid.
void FaceSession::Impl::keep_variants(std::vector<VariantRun> before, bool same_base) {
  std::vector<VariantState> old = std::exchange(states, std::vector<VariantState>(runs.size()));
  for (std::size_t i = 0; i < runs.size() && same_base; ++i) {
    std::size_t known = 0;
    while (known < before.size() && before[known].scene.title != runs[i].scene.title) ++known;
    if (known == before.size()) continue;
    VariantState& now = states[i];
    const bool same = before[known].options == runs[i].options;
    now.simulator = std::exchange(old[known].simulator, std::nullopt);
    now.stale = old[known].stale || !same;
    now.has_bands = !now.stale && old[known].has_bands;
    if (!now.stale) {
      runs[i].simulation = std::move(before[known].simulation);
      runs[i].symmetry = std::move(before[known].symmetry);
    }
    if (same || !now.simulator) continue;
    try {
      now.simulator->set_options(runs[i].options);
    } catch (const InputError&) {
      now.simulator.reset();  // a run will make another, or say why it cannot
    }
  }
  std::erase_if(variant_notes, [&](const Note& note) {
    return std::none_of(runs.begin(), runs.end(),
                        [&](const VariantRun& run) { return run.scene.title == note.variant; });
  });
}

/// Made where a face first uses them, since a grid of distances takes some time.
void FaceSession::Impl::set_obstacles() {
  const ObstaclesUsed used = obstacles_used(scene);
  if (used == obstacles_of_scene) return;
  obstacles_of_scene = used;
  obstacles = obstacles_of(scene, inputs, *face.mesh, teeth.get());
  simulator->set_obstacles(obstacles);
  next_variant.reset();
}

// ----- the class

FaceSession::FaceSession(const std::filesystem::path& scene_file, const Changes& changes,
                         SessionOptions options)
    : FaceSession(scene::read_scene(scene_file, overrides_of(changes)), std::move(options)) {}

FaceSession::FaceSession(Face face, motion::Motion motion, const Changes& changes,
                         SessionOptions options)
    : impl_(std::make_unique<Impl>(
          SceneSource(given_face(std::move(face), std::move(motion)), changes),
          std::move(options))) {}

FaceSession::FaceSession(scene::Scene scene, SessionOptions options)
    : impl_(std::make_unique<Impl>(SceneSource(std::move(scene)), std::move(options))) {}

FaceSession::FaceSession(FaceSession&&) noexcept = default;
FaceSession& FaceSession::operator=(FaceSession&&) noexcept = default;
FaceSession::~FaceSession() = default;

bool FaceSession::set_scene(scene::Scene next) {
  if (!same_face(impl_->scene, next)) return false;
  next.kept = impl_->scene.kept;
  next.given = impl_->scene.given;
  SceneSource source = impl_->source;
  source.replace(next);
  impl_->take(std::move(next));
  impl_->source = std::move(source);
  impl_->set_obstacles();
  impl_->note_tissue();
  return true;
}

const scene::Scene& FaceSession::scene() const {
  return impl_->scene;
}
const std::vector<scene::LeftOutVariant>& FaceSession::left_out() const {
  return impl_->left_out;
}
const Inputs& FaceSession::inputs() const {
  return impl_->inputs;
}
const io::Scan& FaceSession::scan() const {
  return impl_->whole_scan ? *impl_->whole_scan : impl_->inputs.scan;
}
const tissue::TissueMesh& FaceSession::mesh() const {
  return *impl_->face.mesh;
}
std::shared_ptr<const tissue::TissueMesh> FaceSession::shared_mesh() const {
  return impl_->face.mesh;
}
const SkinOff& FaceSession::skin_off() const {
  return impl_->skin_off;
}
std::shared_ptr<const anatomy::Teeth> FaceSession::teeth() const {
  return impl_->teeth;
}
std::shared_ptr<const std::vector<simulate::Obstacle>> FaceSession::obstacles() const {
  return impl_->obstacles;
}
const std::string& FaceSession::drive_reason() const {
  return impl_->drive.why;
}
std::size_t FaceSession::faces() const {
  return 1 + impl_->runs.size();
}
simulate::SimulationOptions FaceSession::options(std::size_t face) const {
  return face == 0 ? options_with_field(impl_->scene, impl_->inputs, impl_->field)
                   : impl_->runs.at(face - 1).options;
}
simulate::Simulator FaceSession::simulator() const {
  return *impl_->simulator;
}
const tissue::TissueField* FaceSession::field() const {
  return impl_->field ? &*impl_->field : nullptr;
}
const simulate::SimulationResult& FaceSession::simulation() const {
  return impl_->simulation;
}
const metrics::SymmetryMeasures& FaceSession::symmetry() const {
  return impl_->symmetry;
}
const metrics::PeakTissue& FaceSession::tissue_at_peak() const {
  return impl_->peak();
}
const metrics::SkinUncertainty* FaceSession::skin_uncertainty() const {
  return impl_->skin_uncertainty();
}
const report::FaceBacking* FaceSession::backing() const {
  return impl_->backing ? &*impl_->backing : nullptr;
}
const std::vector<VariantRun>& FaceSession::variants() const {
  return impl_->runs;
}
StageSeconds FaceSession::seconds() const {
  return impl_->seconds;
}

simulate::TissueValues FaceSession::tissue_of(const scene::Scene& scene) {
  return options_with_field(scene, impl_->inputs, impl_->fields->of(scene)).tissue;
}

Eigen::VectorXd FaceSession::region_shares(const scene::Scene& scene, std::size_t region) {
  return impl_->fields->region_shares(scene, region);
}

simulate::AlignedMotion FaceSession::mirrored_motion() const {
  std::string why_not;
  auto motion = session::mirrored_motion(impl_->inputs.motion, impl_->face.at_rest.plane,
                                         impl_->inputs.driven, why_not);
  if (!motion) throw InputError(impl_->scene.file, "the motion has no mirror image: " + why_not);
  return *std::move(motion);
}

}  // namespace hyperex::session
