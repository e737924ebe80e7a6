// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "hyperex/anatomy/teeth/teeth.hpp"
#include "hyperex/core/note.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/metrics/symmetry_tables.hpp"
#include "hyperex/simulate/run/simulator.hpp"

namespace hyperex::session {

/// The results of one run of a face. A copy is cheap and does not change with the session.
struct FaceResult {
  std::string name;  ///< "base", or that of the variant
  std::shared_ptr<const simulate::SimulationResult> simulation;
  std::shared_ptr<const metrics::SymmetryMeasures> symmetry;
  std::shared_ptr<const io::Scan> scan;         ///< its vertices are the first of the skin's
  std::shared_ptr<const anatomy::Teeth> teeth;  ///< null: none
  std::vector<Note> notes;                      ///< of the whole session, as FaceSession::notes()

  /// The moving skin and tissue, metres, the scan's frame.
  const simulate::Performance& performance() const { return simulation->performance; }
  const simulate::SimulationReport& report() const { return simulation->report; }
  /// S(t), excursions and the asymmetry map.
  const metrics::SymmetryMeasures& measures() const { return *symmetry; }
};

/// The moving skin as animated glTF for Blender and other programs; no vertex is farther off than
/// `tolerance_m` in any frame. Throws InputError where the file cannot be written.
void write_glb(const std::filesystem::path& file, const FaceResult& result,
               double tolerance_m = 1e-4);

/// The skin at the peak as PLY in the scan's unit, its own vertices first, with the property
/// displacement_mm. Throws as above.
void write_skin_ply(const std::filesystem::path& file, const FaceResult& result);

/// The landmarks over time as CSV (motion.csv of a run). Throws as above.
void write_motion_csv(const std::filesystem::path& file, const FaceResult& result);

}  // namespace hyperex::session
