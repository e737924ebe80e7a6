// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What a FaceSession holds, stage by stage.
#include "hyperex/metrics/peak_tissue.hpp"
#include "hyperex/metrics/skin_uncertainty.hpp"
#include "hyperex/report/face_backing.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/session/drive_choice.hpp"
#include "hyperex/session/face_session.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/session/landmark_search.hpp"
#include "hyperex/session/mirrored_twin.hpp"
#include "hyperex/session/obstacles.hpp"
#include "hyperex/session/plausible.hpp"
#include "hyperex/session/prepared_face.hpp"
#include "hyperex/session/scene_source.hpp"
#include "hyperex/session/tissue_fields.hpp"
#include "hyperex/session/variants.hpp"

namespace hyperex::session {

struct FaceSession::Impl {
  Impl(SceneSource source, SessionOptions options);

  // Given.
  SessionOptions session_options;
  SceneSource source;  // what set() and variant() change
  scene::Scene scene;
  std::vector<scene::LeftOutVariant> left_out;

  // The inputs, the mesh and what is computed from them.
  Inputs inputs;
  std::optional<io::Scan> whole_scan;  // none: inputs.scan was not thinned
  PreparedFace face;
  SkinOff skin_off;
  std::shared_ptr<const anatomy::Teeth> teeth;
  std::unique_ptr<TissueFields> fields;
  std::optional<LandmarkSearch> search;  // none: not begun, or over
  bool searched = false;

  // Base: its simulator and its results.
  DriveChoice drive;
  std::optional<tissue::TissueField> field;
  std::optional<simulate::Simulator> simulator;
  std::shared_ptr<const std::vector<simulate::Obstacle>> obstacles;
  ObstaclesUsed obstacles_of_scene{false, false};  // which of them are set
  bool stale = true;
  simulate::SimulationResult simulation;
  metrics::SymmetryMeasures symmetry;
  mutable std::optional<metrics::PeakTissue> tissue_at_peak;    // none: not computed yet
  mutable std::optional<metrics::SkinUncertainty> uncertainty;  // the same
  std::optional<report::FaceBacking> backing;                   // none: there is no gaze
  std::optional<MirroredTwin> twin;                             // of base as it is; none: not run
  std::optional<simulate::Simulator> next_variant;              // of prepare_variant()

  // The variants: their results and their simulators.
  std::vector<VariantRun> runs;
  struct VariantState {
    std::optional<simulate::Simulator> simulator;  // holds base's forces; none: not made
    bool stale = true, has_bands = false;
  };
  std::vector<VariantState> states;

  // Notes by the stage that found them.
  std::vector<Note> tissue_notes, teeth_notes, skin_notes, doubts, base_notes, variant_notes;
  StageSeconds seconds;

  void begin_stage(const std::string& name) const;
  void report(const std::vector<Note>& notes) const;
  void report_new(const std::vector<Note>& now, const std::vector<Note>& before) const;
  std::vector<Note> notes_on_inputs(Severity severity) const;
  bool with_runs() const { return session_options.certainty == Certainty::with_runs; }

  void read();
  void mesh();
  void take(scene::Scene next);
  void take_at_first(const scene::Scene& given);
  void take_source(SceneSource next);
  void set_obstacles();
  std::size_t changed_face() const;
  void keep_variants(std::vector<VariantRun> before, bool same_base);
  void begin_search();
  void finish_search();

  simulate::Simulator& simulator_of(std::size_t number);
  void add_gaze(simulate::Performance& performance) const;

  void run_base(const simulate::RunCallbacks& callbacks);
  void run_variants(const simulate::RunCallbacks& callbacks);
  void run_variants_together(const std::vector<std::size_t>& which,
                             const std::function<bool()>& cancelled);
  void run_variant(std::size_t i, const simulate::RunCallbacks& callbacks);
  void find_bands(const std::function<bool()>& cancelled);
  void prepare_variant();
  const metrics::PeakTissue& peak() const;
  const metrics::SkinUncertainty* skin_uncertainty() const;
  void note_tissue();
  void note_base();
  bool up_to_date() const;
  std::vector<Note> notes() const;
  FaceResult result(std::size_t number) const;
};

}  // namespace hyperex::session
