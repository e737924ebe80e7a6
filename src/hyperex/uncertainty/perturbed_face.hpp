// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <string>
#include <vector>

#include "hyperex/metrics/error_budget.hpp"
#include "hyperex/scene/scene.hpp"

namespace hyperex::uncertainty {

// How wrong a face may be, 1 sigma: the line of each muscle along the skin, the prior sigma of each
// activation (a factor), and the tissue's stiffness relative to its support (a factor).
inline constexpr double kMuscle_m = 2e-3, kReadiness = 1.5, kStiffness = 1.65;
/// Element sizes of other meshes, relative to that of the face's own.
inline constexpr std::array kElementSizes = {0.92, 1.1, 1.2};
inline constexpr int kLandmarkDraws = 3, kMuscleDraws = 4;

/// A face that differs from a scene's in one respect, by as much as may be wrong.
struct PerturbedFace {
  metrics::ErrorPart part;
  std::string how;     ///< "elements of 3.8 mm instead of 3.3"
  scene::Scene scene;  ///< with its variants, changed alike
  bool same_mesh;      ///< scan, landmarks and mesh are those of the face
};

/// `landmarks`: of the face, completed. Where displacements drive, muscles
/// are not perturbed. The same for the same scene.
std::vector<PerturbedFace> perturbed_faces(const scene::Scene& scene,
                                           const io::Landmarks& landmarks);

}  // namespace hyperex::uncertainty
