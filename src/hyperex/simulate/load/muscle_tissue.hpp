// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A face as muscles act on it: its support, its stiffness and its responses.
#include <functional>
#include <memory>

#include "hyperex/fem/material/linear_viscoelastic.hpp"
#include "hyperex/fem/solve/node_order.hpp"
#include "hyperex/simulate/load/muscle_model.hpp"
#include "hyperex/simulate/options.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::simulate {

/// The support of a face that muscles drive: MuscleOptions' layers in the place of the given ones.
SupportOptions muscle_support(const SupportOptions& given, const MuscleOptions& options);

/// Raises E in the lips (MuscleOptions::lip_stiffening).
void stiffen_lips(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                  const MuscleOptions& options, fem::Material& material);

/// The responses of a face to its muscles and its jaw, whatever its motion. `stiffness`: assembled,
/// without springs. `order`: that of the same pattern and held nodes; null: found here. `between`:
/// may be empty, and is called repeatedly; it may throw, which ends the computation.
MuscleModel muscle_model(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                         const SimulationOptions& options, const fem::SparseMatrix& stiffness,
                         std::shared_ptr<const fem::NodeOrder> order,
                         const std::function<void()>& between = {});

}  // namespace hyperex::simulate
