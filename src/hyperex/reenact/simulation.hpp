// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "hyperex/fem/element/element_kind.hpp"
#include "hyperex/fem/material/linear_viscoelastic.hpp"
#include "hyperex/fem/solve/linear_solver.hpp"
#include "hyperex/reenact/alignment.hpp"
#include "hyperex/reenact/performance.hpp"
#include "hyperex/reenact/skin_measured.hpp"
#include "hyperex/reenact/support.hpp"
#include "hyperex/tissue/field/options.hpp"
#include "hyperex/tissue/tissue_mesh.hpp"

namespace hyperex::reenact {

enum class Hold { held, sliding, free };
enum class Mandible { follow, held, free };

struct SupportOptions {
  bool border_held = true;
  Hold skull = Hold::sliding;
  Mandible mandible = Mandible::follow;
  BoneLayer skull_layer{1e7, 1e7};     ///< used where skull is sliding
  BoneLayer mandible_layer{3e7, 1e7};  ///< used where the mandible is followed
  /// The muscles under the skin follow the interpolated motion of the driven points: springs per
  /// area at the inner surface, everywhere but over the mandible. 0: none.
  double muscle_pa_per_m = 5e6;
  std::vector<std::string> jaw_points;  ///< that carry the jaw; empty: chin points among the driven
};

struct DriveOptions {
  std::vector<std::string> points;        ///< driven, names of the motion
  std::vector<std::string> still_points;  ///< landmarks of the skin that are kept where they are
  double patch_radius_m = 0.006;
  double gain = 1;
};

/// The courses of all steps are kept: more would fill the memory.
constexpr double kMostSteps = 2e6;

struct TimeOptions {
  double step_s = 0.002, end_s = 0, frame_rate_hz = 30;
  std::vector<double> still_times_s;  ///< extra shapes wanted, for pictures
};

/// One value everywhere, or where `element` is not empty (tissue/field) one a tetrahedron.
struct TissueValues {
  double young_pa = 192.4e3, poisson = 0.495, viscosity_pa_s = 476.8, density_kg_m3 = 1100;
  fem::ViscousForm viscous_form = fem::ViscousForm::isotropic;
  std::array<std::vector<double>, tissue::parameter_count> element{};  ///< of all or of none

  /// Of `tets` tetrahedra. Values are allowed ones (tissue::is_allowed): asserted.
  fem::Material material(std::size_t tets) const;
};

enum class SolverMethod {
  reduced,  ///< projected onto the motions that the input makes, to a checked tolerance
  direct    ///< all unknowns at every step
};

struct SolverOptions {
  fem::ElementKind element = fem::ElementKind::tet4;
  SolverMethod method = SolverMethod::reduced;
  fem::LinearSolver linear = fem::LinearSolver::automatic;
  double tolerance = 1e-3;          ///< of the reduced model, over the greatest displacement
  double beta = 0.25, gamma = 0.5;  ///< of Newmark's method
  bool verify = false;              ///< run the full model too and measure the reduced one's error
};

struct SimulationOptions {
  SolverOptions solver;
  TissueValues tissue;
  SupportOptions support;
  DriveOptions drive;
  RegionOptions region;
  TimeOptions time;
  double peak_time_s = -1;  ///< below 0: where the driven points moved most in the mean
};

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
