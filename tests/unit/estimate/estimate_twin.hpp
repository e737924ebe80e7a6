// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Patients whose tissue and muscles are known: muscles move a face on one mesh, the points are
// recorded with noise, and the estimate on another mesh has to find what was changed.
#include <array>
#include <string>
#include <vector>

#include "hyperex/estimate/face_model.hpp"
#include "hyperex/estimate/observation.hpp"
#include "support/muscle_twin.hpp"

namespace hyperex::estimate::test {

/// A face on a mesh of one element size, with its cheeks as parts of the tissue.
struct TwinMesh {
  hyperex::test::TwinFace face;
  std::vector<double> cheek_L, cheek_R;  ///< per tetrahedron: 0 to 1

  explicit TwinMesh(double element_size_m);
  StiffnessRatio cheeks() const { return {"cheek_L / cheek_R", cheek_L, cheek_R}; }
};

/// Made once: the program's and the truth's.
const TwinMesh& programs_mesh();
const TwinMesh& truths_mesh();

/// How a truth differs from what the program assumes.
struct Patient {
  double cheek_ratio = 1;  ///< of Young's moduli, left to right
  double gain = 1;         ///< of `weak`
  std::string weak = "zygomatic_R";
  double young_factor = 1;  ///< of the whole tissue
  double lines_off_m = 0;
  double uneven = 0;  ///< relative difference of the sides' efforts, 1 sigma
  double noise_m = 3e-4;
  bool finite = false;  ///< tissue at finite strain, where the program assumes small strain
  unsigned seed = 1;
};

/// Recordings of standard expressions, by name, as the program observes them.
std::vector<Observation> observations_of(const Patient& patient,
                                         const std::vector<std::string>& expressions,
                                         const std::vector<std::string>& points);

/// What the points do, as the program observes it, while the patient lies face up. `young_factor`:
/// of Young's modulus and of the support alike, relative to the scene's; beside
/// patient.young_factor, which is relative to the support. `turned`: errors of the direction of
/// gravity upright and lying, rad about each axis. The head turns by 90 degrees, and its pose is
/// taken out by the program.
Observation lying_observation_of(const Patient& patient, double young_factor,
                                 const std::array<Vec3, 2>& turned,
                                 const std::vector<std::string>& points);

/// The face model that the program uses.
FaceModel model_of(const Question& question, const std::vector<std::string>& points);
/// All 68 but those of the outline that are not of the chin.
std::vector<std::string> inner_points();

}  // namespace hyperex::estimate::test
