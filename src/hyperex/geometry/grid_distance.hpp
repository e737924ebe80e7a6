// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include "hyperex/geometry/signed_distance.hpp"

namespace hyperex {

struct GridDistanceOptions {
  double cell_m = 5e-4;  ///< between samples, > 0
  double band_m = 1e-3;  ///< samples within this distance of the surface are exact, >= 0
};

/// The signed distance to a closed mesh, sampled on a regular grid. Between samples it is
/// interpolated by cubic convolution along each axis, which reproduces the samples and has
/// continuous first derivatives (Keys, IEEE Trans. Acoust. 29, 1981, 1153). Samples outside the
/// band around the surface are interpolated from exact values four cells apart. The grid extends
/// beyond the mesh by the band and some cells. For a place outside the grid, the distance to the
/// grid is added; the gradient is discontinuous there. The exact samples are those of MeshDistance.
class GridDistance final : public SignedDistance {
 public:
  /// `closed`: outward triangles, metres; each component must be watertight. Components may
  /// overlap; their union is then used. Inside the union, the value is the least (most negative) of
  /// the signed distances to the components. Its magnitude is at most the true distance. Throws
  /// std::invalid_argument if the mesh is empty, not finite or has a border, if an option is out of
  /// range, or if more than 2^28 samples would be needed.
  explicit GridDistance(const TriMesh& closed, const GridDistanceOptions& options = {});

  /// The gradient is that of the returned value, up to rounding. Its length is 1, except outside
  /// the grid and where several places of the surface are about equally close.
  double at(const Vec3& place, Vec3& outward) const override;

 private:
  std::array<int, 3> size_{};  // number of samples along each axis
  Vec3 origin_ = Vec3::Zero();
  double cell_m_ = 0;
  std::vector<float> sample_;  // x varies fastest
};

}  // namespace hyperex
