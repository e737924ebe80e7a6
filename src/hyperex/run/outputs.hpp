// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "hyperex/anatomy/teeth/teeth.hpp"
#include "hyperex/metrics/skin_uncertainty.hpp"
#include "hyperex/metrics/symmetry_tables.hpp"
#include "hyperex/report/displacement_modes.hpp"
#include "hyperex/report/glb.hpp"
#include "hyperex/session/face_session.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/simulate/run/simulator.hpp"
#include "hyperex/tissue/field/tissue_field.hpp"

namespace hyperex::run {

/// Everything a run computed.
struct Results {
  const scene::Scene& scene;
  const session::Inputs& inputs;
  const tissue::TissueMesh& mesh;
  const simulate::SimulationResult& simulation;
  metrics::SymmetryMeasures symmetry;
  std::vector<Note> notes;
  report::DisplacementModes modes;               ///< of the skin; empty if no page is written
  const tissue::TissueField* tissue = nullptr;   ///< null: the tissue is uniform
  const anatomy::Teeth* teeth = nullptr;         ///< null: none
  const report::FaceBacking* backing = nullptr;  ///< of simulation and teeth; null: not made yet
  const metrics::SkinUncertainty* uncertainty = nullptr;  ///< null: not known, as for variants
};

/// The results of base. They refer to the session, which must outlive them and not change.
Results results_of(const session::FaceSession& session);

/// Writes all files except summary.json and report.html into `directory`. Returns the report on
/// performance.glb, or nothing if that file is not written. For a variant of `base`, muscles.png is
/// written only if its muscles pull differently, because it would otherwise be the picture of base,
/// and gaze.csv is not written.
std::optional<report::GlbReport> write_outputs(const Results& results,
                                               const std::filesystem::path& directory,
                                               const Results* base = nullptr);

/// "glb" of summary.json: keys, largest_error_mm, size_mb.
nlohmann::ordered_json glb_json(const report::GlbReport& glb);

/// The warning `output.glb_coarse`, if output.glb_max_mb prevented the accuracy
/// output.glb_tolerance_mm; otherwise nothing.
std::vector<Note> glb_notes(const scene::OutputOptions& output, const report::GlbReport& glb);

/// The end of the simulation, measured from the start of the motion.
double run_end_s(const scene::Scene& scene, const session::Inputs& inputs);

/// The requested picture times (rising), clamped to `end_s` and without duplicates.
std::vector<double> shown_times_s(const std::vector<double>& wanted_s, double end_s);

/// At most five of `count` frames, rising: evenly spaced including the first and the last, with the
/// one nearest to the peak replaced by the peak.
std::vector<std::size_t> spread_frames(std::size_t count, std::size_t peak);

/// The face at rest and at the picture times, from the front and in three-quarter view, coloured by
/// displacement.
void write_contact_sheet(const Results& results, const std::filesystem::path& file);

/// Each parameter of the tissue that varies in space, on the skin at rest, seen from the right, the
/// front and the left. Writes nothing if the tissue is uniform.
void write_tissue_map(const Results& results, const std::filesystem::path& file);

}  // namespace hyperex::run
