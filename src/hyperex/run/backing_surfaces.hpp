// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>
#include <vector>

#include "hyperex/anatomy/teeth/teeth.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/render/render.hpp"
#include "hyperex/report/face_backing.hpp"

namespace hyperex::run {

/// report::face_backing() with the directions of pockets in the face's frame.
report::FaceBacking backing_in_frame(const TriMesh& skin_rest, const io::Landmarks& landmarks,
                                     const face::FaceFrame& frame);

/// What stands behind the holes of a skin in one shape, in the face's frame: eyeballs, pockets
/// behind mouth and nostrils, so that nobody looks through the head, and teeth with their gums.
class BackingSurfaces {
 public:
  /// `backing`: as backing_in_frame() has it. `skin`: the vertices in that shape in the face's
  /// frame; pockets hang on them. `teeth`: at rest, scan frame; null: none. `jaw`: of the lower
  /// ones, now_from_rest.
  BackingSurfaces(const report::FaceBacking& backing, const face::FaceFrame& frame,
                  const Points& skin, const anatomy::Teeth* teeth, const Eigen::Isometry3d& jaw);

  /// The skin's surface with all that stands behind it; refers to this.
  std::vector<render::Surface> with(const render::Surface& skin) const;

 private:
  struct Part {
    TriMesh mesh;
    render::Colour colour;
    bool smooth = false;
    render::VertexColours colours = {};  ///< in the place of `colour`
  };
  std::vector<Part> parts_;
};

}  // namespace hyperex::run
