// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Sparse>
#include <string>
#include <vector>

#include "hyperex/simulate/drive/alignment.hpp"
#include "hyperex/simulate/drive/matching.hpp"
#include "hyperex/simulate/options.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::simulate {

/// The part of the skin that follows the tracked triangles [4.15], with a share per vertex.
struct MeasuredRegion {
  std::vector<double> share;        ///< per skin vertex, 0 (physical) to 1 (measured)
  std::vector<Match> skin;          ///< per skin vertex; empty where nothing is measured
  std::vector<double> outer_share;  ///< per outer node of the volume
  std::vector<Match> outer;
};

/// Uses the motion's triangles where it has some, else triangulate_points(). Throws InputError
/// where a named point is not in the motion.
MeasuredRegion measured_region(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                               const AlignedMotion& motion, const RegionOptions& options);

}  // namespace hyperex::simulate
