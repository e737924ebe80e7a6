// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>

#include "hyperex/metrics/symmetry_tables.hpp"
#include "hyperex/reenact/simulation.hpp"
#include "hyperex/report/displacement_modes.hpp"
#include "hyperex/scene/inputs.hpp"
#include "hyperex/tissue/field/tissue_field.hpp"

namespace hyperex::scene {

/// Everything a run computed.
struct Results {
  const Scene& scene;
  const Inputs& inputs;
  const tissue::TissueMesh& mesh;
  const reenact::SimulationResult& simulation;
  metrics::SymmetryMeasures symmetry;
  std::vector<std::string> notes;
  report::DisplacementModes modes;  ///< of the skin; empty where neither glTF nor page is wanted
  const tissue::TissueField* tissue = nullptr;  ///< where the tissue differs from place to place
};

/// Writes all files but summary.json and report.html into `directory`.
void write_outputs(const Results& results, const std::filesystem::path& directory);

/// Where the simulation ends, from the start of the motion.
double run_end_s(const Scene& scene, const Inputs& inputs);

/// Of the rising times of the wanted pictures those that a run of `end_s` shows: what is wanted
/// later shows the end, which stands there once.
std::vector<double> shown_times_s(const std::vector<double>& wanted_s, double end_s);

/// S(t), excursions and the asymmetry map of a simulated face, to the jitter of its input.
metrics::SymmetryMeasures symmetry_measures(const Scene& scene, const Inputs& inputs,
                                            const tissue::TissueMesh& mesh,
                                            const reenact::Performance& performance);

/// Rest and the still shapes from the front and three-quarter, coloured by displacement.
void write_contact_sheet(const Results& results, const std::filesystem::path& file);

/// Each parameter of the tissue that differs from place to place, over the skin at rest, seen from
/// the right, from in front and from the left. Nothing where none does.
void write_tissue_map(const Results& results, const std::filesystem::path& file);

}  // namespace hyperex::scene
