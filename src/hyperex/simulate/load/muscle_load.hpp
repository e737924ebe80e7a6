// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <memory>

#include "hyperex/fem/solve/node_order.hpp"
#include "hyperex/simulate/drive/alignment.hpp"
#include "hyperex/simulate/drive/point_curve.hpp"
#include "hyperex/simulate/drive/skin_measured.hpp"
#include "hyperex/simulate/load/held_load.hpp"
#include "hyperex/simulate/load/muscle_tissue.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::simulate {

/// At most this many driven points below the nose are few: landmark error dominates, and the prior
/// decides most activations of the mouth's muscles.
inline constexpr int kFewPoints = 20;

/// Whether these driven points are few: at most kFewPoints of them lie more than 3 mm below the
/// base of the nose. Points of brows, lids and nose tell nothing of the mouth, and do not count.
/// `rest`: where they are at rest, N x 3, m. `landmarks`: complete, of the same face.
bool few_points(const Points& rest, const io::Landmarks& landmarks);

/// How many samples of a motion the forces of a run need: those up to its end (TimeOptions::end_s),
/// and those after it that the curve through the samples depends on up to there.
/// `time_s`: of the samples, rising, at least one.
Eigen::Index samples_of_run(const std::vector<double>& time_s, const TimeOptions& time);

/// The forces that make a recorded motion in this tissue. At each sample of the run
/// (samples_of_run()) activations and the jaw's pose are fitted to the driven points
/// (muscle_fit.hpp). Further forces account for the residual at the points: they keep the patches
/// of skin around the points (driven_skin) at the displacement by the muscles plus the interpolated
/// residual. In static equilibrium, the driven points are then where prescribed patches would place
/// them, although nothing is prescribed. `model`: muscle_model() with these options. `between` (may
/// be empty) is called repeatedly; it may throw, which ends the computation.
HeldLoad muscle_load(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                     const AlignedMotion& motion, const MeasuredRegion& region,
                     const SimulationOptions& options, const MuscleModel& model,
                     const std::function<void()>& between = {});

}  // namespace hyperex::simulate
