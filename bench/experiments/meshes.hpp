// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <vector>

#include "experiments/study.hpp"

namespace hyperex::bench {

/// Experiment 3 on one mesh, at its end: xi_L - xi_R of model 1, and the changes by models 2 and 3.
struct MeshRow {
  double element_mm = 0;
  int tets = 0;
  double own = 0, added_2 = 0, added_3 = 0;
};

/// The three models on meshes with other elements, to separate the effects of mesh and tissue.
std::vector<MeshRow> models_on_meshes(const std::filesystem::path& scene);

/// Whether xi_L - xi_R of model 1 varies between meshes by more than its own size.
bool by_mesh(const std::vector<MeshRow>& rows);

/// Whether the changes by models 2 and 3 have the same sign on all meshes, and agree in size within
/// a factor of two.
bool tissue_stays(const std::vector<MeshRow>& rows);

}  // namespace hyperex::bench
