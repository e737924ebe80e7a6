// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <vector>

#include "experiments/study.hpp"

namespace hyperex::bench {

/// Experiment 3 on one mesh, at its end: xi_L - xi_R of model 1, and what models 2 and 3 add to it.
struct MeshRow {
  double element_mm = 0;
  int tets = 0;
  double own = 0, added_2 = 0, added_3 = 0;
};

/// The three models on meshes of other elements: what is the mesh's and what is the tissue's.
std::vector<MeshRow> models_on_meshes(const std::filesystem::path& scene);

/// Model 1's xi_L - xi_R changes from mesh to mesh by more than its own size.
bool by_mesh(const std::vector<MeshRow>& rows);

/// What models 2 and 3 add keeps its sign on all meshes, and its size to a factor of two.
bool tissue_stays(const std::vector<MeshRow>& rows);

}  // namespace hyperex::bench
