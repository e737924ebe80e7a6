// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include "hyperex/geometry/signed_distance.hpp"

namespace hyperex {

struct GridDistanceOptions {
  double cell_m = 5e-4;  ///< between samples, > 0
  double band_m = 1e-3;  ///< samples as near to the surface as this are exact, >= 0
};

/// The distance to a closed mesh, sampled on a regular grid. Between samples it goes by cubic
/// convolution along each axis, which meets the samples and has continuous first derivatives
/// (Keys, IEEE Trans. Acoust. 29, 1981, 1153). Samples farther from the surface than the band are
/// interpolated from exact ones four cells apart. Beyond the grid, which ends a band and some cells
/// off the mesh, the way to the grid is added; the gradient jumps there.
/// The samples are those of MeshDistance.
class GridDistance final : public SignedDistance {
 public:
  /// `closed`: outward triangles, metres; each of its components watertight. Components may overlap
  /// and then count as their union, in whose inside the distance is that to the farthest of the
  /// components' own surfaces: no greater than the true one in size.
  /// Throws std::invalid_argument where the mesh is empty, not finite or has a border, or an option
  /// is out of range, or more than 2^28 samples were needed.
  explicit GridDistance(const TriMesh& closed, const GridDistanceOptions& options = {});

  /// The gradient is that of what is returned, to rounding; its length is 1 but where several
  /// places of the surface are about as near, and beyond the grid.
  double at(const Vec3& place, Vec3& outward) const override;

 private:
  std::array<int, 3> size_{};  // samples along each axis
  Vec3 origin_ = Vec3::Zero();
  double cell_m_ = 0;
  std::vector<float> sample_;  // x fastest
};

}  // namespace hyperex
