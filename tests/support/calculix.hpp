// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Runs CalculiX (Debian: calculix-ccx) on a mesh of linear tetrahedra, as an independent reference.
#include <Eigen/Sparse>
#include <filesystem>
#include <optional>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::test {

/// W = C10 x + C20 x^2 + C30 x^3 + kappa/2 (J - 1)^2, x = I1bar - 3: CalculiX's NEO HOOKE where C20
/// and C30 are zero, else its YEOH.
struct CalculixHyperelastic {
  double c10_pa = 0, c20_pa = 0, c30_pa = 0, bulk_pa = 0;
};

/// A mesh of one isotropic material, at rest until its driven unknowns move as prescribed.
struct CalculixModel {
  Points nodes;     ///< m
  Tetrahedra tets;  ///< C3D4
  double young_pa = 0, poisson = 0, density_kg_m3 = 0;
  double alpha_per_s = 0, beta_s = 0;  ///< damping C = alpha M + beta K
  std::vector<int> held_nodes;         ///< all three axes
  std::vector<int> driven;             ///< unknowns 3 n + axis
  Eigen::MatrixXd motion_m;            ///< steps x |driven|: displacement at the end of each step
  double dt_s = 0;
  /// Instead of the elastic constants, for a sequence of equilibria at finite strain. Density and
  /// damping are then ignored, and time has no meaning.
  std::optional<CalculixHyperelastic> hyperelastic;
};

/// The displacements of all unknowns, one vector per step.
using History = std::vector<Eigen::VectorXd>;

struct CalculixRun {
  History displacement_m;
  double seconds = 0;  ///< of the program, including reading and writing
};

/// The program `ccx` on the PATH.
std::optional<std::filesystem::path> find_calculix();

/// Runs CalculiX's *DYNAMIC, DIRECT, ALPHA=0: Newmark with average acceleration (beta 1/4, gamma
/// 1/2). It prints seven digits of each number. As the model is linear, `gain` multiplies the
/// motion on input and divides the results (calculix_gain). A hyperelastic model is run with
/// *STATIC, DIRECT with NLGEOM, gain 1, iterated until corrections are below 1e-8. Throws
/// NumericalError with the last lines of its log where it fails or writes too little. `threads`: of
/// ccx; they wait for each other actively.
CalculixRun run_calculix(const CalculixModel& model, double gain = 1, int threads = 1);

/// The factor that brings displacements of up to `greatest` to 9.9 times a power of ten: rounding
/// to seven digits is then at most 5.1e-8 of the greatest.
double calculix_gain(double greatest);

/// Which coupling terms between driven and free unknowns K d + C d' + M d'' = 0 contains, besides
/// stiffness.
struct DrivenTerms {
  Eigen::SparseMatrix<double> stiffness, damping, mass;
  bool damping_of_driven = true;  ///< - C_oc d'_c
  bool inertia_of_driven = true;  ///< - M_oc d''_c
};

/// Newmark's method with average acceleration for the model's motion from rest with these terms,
/// all unknowns. Velocities and accelerations of driven unknowns follow from Newmark's own
/// formulas. It deliberately uses neither the time loop nor the factorisation of the library.
History integrate(const DrivenTerms& terms, const CalculixModel& model);

/// The mass matrix integrated at one point, where N_a = 1/4: rho V / 16 in each entry of a
/// tetrahedron. Diagonal and other entries are given as shares of rho V, to try others.
Eigen::SparseMatrix<double> one_point_mass(const CalculixModel& model, double diagonal = 1.0 / 16,
                                           double other = 1.0 / 16);

/// The greatest difference between two histories in any unknown at any step, divided by the
/// greatest displacement of the first.
double difference(const History& a, const History& b);
double greatest(const History& a);

}  // namespace hyperex::test
