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
  report::DisplacementModes modes;              ///< of the skin; empty where no page is wanted
  const tissue::TissueField* tissue = nullptr;  ///< where the tissue differs from place to place
  const anatomy::Teeth* teeth = nullptr;        ///< null: none
  const metrics::SkinUncertainty* uncertainty = nullptr;  ///< null: not known, as of a variant
};

/// Of base. What it refers to belongs to the session, which must outlive it and stay as it is.
Results results_of(const session::FaceSession& session);

/// Writes all files but summary.json and report.html into `directory`, and tells of
/// performance.glb; nothing where that is not wanted. Of a variant of `base`, muscles.png is
/// written only where its muscles pull differently: the picture would be that of the base.
std::optional<report::GlbReport> write_outputs(const Results& results,
                                               const std::filesystem::path& directory,
                                               const Results* base = nullptr);

/// "glb" of summary.json: keys, largest_error_mm, size_mb.
nlohmann::ordered_json glb_json(const report::GlbReport& glb);

/// A warning where output.glb_max_mb left less than output.glb_tolerance_mm asks for
/// (`output.glb_coarse`); else none.
std::vector<Note> glb_notes(const scene::OutputOptions& output, const report::GlbReport& glb);

/// Where the simulation ends, from the start of the motion.
double run_end_s(const scene::Scene& scene, const session::Inputs& inputs);

/// Of the rising times of the wanted pictures those that a run of `end_s` shows: what is wanted
/// later shows the end, which stands there once.
std::vector<double> shown_times_s(const std::vector<double>& wanted_s, double end_s);

/// At most five of `count` frames, rising: spread over all, first and last among them, the one that
/// comes nearest to the peak moved onto it.
std::vector<std::size_t> spread_frames(std::size_t count, std::size_t peak);

/// Rest and the still shapes from the front and three-quarter, coloured by displacement.
void write_contact_sheet(const Results& results, const std::filesystem::path& file);

/// Each parameter of the tissue that differs from place to place, over the skin at rest, seen from
/// the right, from in front and from the left. Nothing where none does.
void write_tissue_map(const Results& results, const std::filesystem::path& file);

}  // namespace hyperex::run
