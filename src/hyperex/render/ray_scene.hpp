// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Internal to the module: the Embree scene of some surfaces as one camera sees it.
#include <optional>
#include <vector>

#include "hyperex/geometry/embree_device.hpp"
#include "hyperex/render/camera.hpp"
#include "hyperex/render/render.hpp"

namespace hyperex::render {

/// Where a ray met a surface.
struct Hit {
  int surface = -1, triangle = -1;
  double weight[3] = {0, 0, 0};  // barycentric
  Eigen::Vector3f normal;        // of the facet, camera frame, unit
};

/// All quantities are in the camera's frame (x right, y up, z towards the viewer, origin at the
/// target); rays run along -z.
class RayScene {
 public:
  RayScene(const std::vector<Surface>& surfaces, const Camera& camera);
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  std::optional<Hit> look_at(float x, float y) const;
  /// Whether a surface lies more than `bias` in front of the point (camera frame).
  bool hides(const Eigen::Vector3f& point, float bias) const;

 private:
  EmbreeScene scene_;
  float above_ = 1;  // a z above all surfaces
};

}  // namespace hyperex::render
