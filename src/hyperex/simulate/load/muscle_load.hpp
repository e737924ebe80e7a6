// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <memory>

#include "hyperex/fem/solve/node_order.hpp"
#include "hyperex/simulate/drive/alignment.hpp"
#include "hyperex/simulate/drive/point_curve.hpp"
#include "hyperex/simulate/drive/skin_measured.hpp"
#include "hyperex/simulate/load/held_load.hpp"
#include "hyperex/simulate/load/muscle_model.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::simulate {

/// Up to so many driven points are few: they move as one measures a landmark, and most muscles are
/// a matter of the prior.
inline constexpr int kFewPoints = 20;
/// What the tissue rests on where muscles drive it.
SupportOptions muscle_support(const SupportOptions& given, const MuscleOptions& options);

/// Raises E in the lips (MuscleOptions::lip_stiffening).
void stiffen_lips(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                  const MuscleOptions& options, fem::Material& material);

/// The forces that make a recorded motion in this tissue. At each sample of the motion activations
/// and the jaw's pose are fitted to the driven points (muscle_fit.hpp). What they leave over at the
/// points becomes forces too: those that hold patches of skin around the points (driven_skin) where
/// the muscles put them, plus the left-over interpolated. In static equilibrium the driven points
/// end where patches would put them, and nothing is prescribed.
/// `model`: muscle_model() with these options. `between` (may be empty): called again and again;
/// may throw, which ends it.
HeldLoad muscle_load(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                     const AlignedMotion& motion, const MeasuredRegion& region,
                     const SimulationOptions& options, const MuscleModel& model,
                     const std::function<void()>& between = {});

/// What muscles and jaw make of a face as these options have it, whatever its motion. `stiffness`:
/// assembled, without springs. `order`: of the same pattern and held nodes; null: found here.
/// `between`: as above.
MuscleModel muscle_model(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                         const SimulationOptions& options, const fem::SparseMatrix& stiffness,
                         std::shared_ptr<const fem::NodeOrder> order,
                         const std::function<void()>& between = {});

}  // namespace hyperex::simulate
