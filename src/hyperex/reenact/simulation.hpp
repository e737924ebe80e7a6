// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/reenact/alignment.hpp"
#include "hyperex/reenact/options.hpp"
#include "hyperex/reenact/performance.hpp"
#include "hyperex/tissue/tissue_mesh.hpp"

namespace hyperex::reenact {

/// Driven points that end farther than this from where they are driven are named in a note.
inline constexpr double kDrivenWithin_m = 1e-4;

/// What happened, for the summary.
struct SimulationReport {
  int free_dofs = 0, steps = 0, driven_nodes = 0, skull_nodes = 0, mandible_nodes = 0;
  int input_shapes = 0, basis_size = 0;                            ///< basis_size 0: full model
  fem::LinearSolver linear_solver = fem::LinearSolver::automatic;  ///< the one picked
  double estimated_error = -1;  ///< of the reduced model, over the greatest displacement
  double verified_error = -1;   ///< measured against the full model; below 0: not measured
  double assemble_s = 0, analyse_s = 0, factor_s = 0, basis_s = 0, simulate_s = 0;
  int inverted_tets = 0;            ///< greatest number in any frame (det(I + grad u) <= 0)
  double greatest_opening_deg = 0;  ///< of the jaw
  /// Greatest distance of any driven point from where it is driven, over the frames.
  double driven_off_mm = 0;
  double lip_overlap_mm =
      0;  ///< greatest depth by which the lips pass through each other beyond rest
  double lip_gap_mm =
      0;  ///< greatest mean distance between upper and lower lip (ibug68_62, 66) over rest
  std::vector<std::string> notes;
};

struct SimulationResult {
  Performance performance;
  std::vector<PointsF> still_displacement_m;  ///< of the skin at the still times
  SimulationReport report;
};

/// Section 5 of the method: a measured region follows the tracked triangles, the rest of the face
/// is a layer of viscoelastic tissue driven by patches of skin, supported by border and bones.
/// Throws InputError for points that do not exist, NumericalError where the model cannot be solved.
SimulationResult simulate(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                          const AlignedMotion& motion, const SimulationOptions& options);

}  // namespace hyperex::reenact
