// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "hyperex/anatomy/teeth/teeth.hpp"
#include "hyperex/expression/gaze.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/render/render.hpp"
#include "hyperex/report/face_backing.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::run {

/// report::face_backing() with pockets in the face's frame.
report::FaceBacking backing_in_frame(const TriMesh& skin_rest, const io::Landmarks& landmarks,
                                     const anatomy::Teeth* teeth, const face::FaceFrame& frame);

/// How the eyes turn in a frame; nothing where the recording has no gaze.
std::optional<expression::EyesGaze> gaze_in(const simulate::Performance& performance,
                                            std::size_t frame);

/// The surfaces behind the holes of a skin in one pose, in the face's frame: eyeballs, the lining
/// of the mouth, pockets behind the nostrils (so that the head does not look hollow), teeth with
/// gums, and the tongue.
class BackingSurfaces {
 public:
  /// `backing`: from backing_in_frame(). `skin`: the vertices in that pose in the face's frame, to
  /// which the pockets are attached. `teeth`: at rest, scan frame; null: none. `jaw`: motion of the
  /// lower teeth, now_from_rest; `upper`: that of the upper ones, where surgery moved them. `gaze`:
  /// nothing: the eyes look ahead.
  BackingSurfaces(const report::FaceBacking& backing, const face::FaceFrame& frame,
                  const Points& skin, const anatomy::Teeth* teeth, const Eigen::Isometry3d& jaw,
                  const Eigen::Isometry3d& upper = Eigen::Isometry3d::Identity(),
                  const std::optional<expression::EyesGaze>& gaze = {});

  /// The skin and all surfaces behind it. They refer to this object.
  std::vector<render::Surface> with(const render::Surface& skin) const;

 private:
  struct Part {
    TriMesh mesh;
    render::Colour colour;
    bool smooth = false;
    render::VertexColours colours = {};  ///< if not empty, used instead of `colour`
  };
  void add_teeth(const anatomy::Teeth& teeth, const face::FaceFrame& frame,
                 const Eigen::Isometry3d& jaw, const Eigen::Isometry3d& upper, double light);

  std::vector<Part> parts_;
};

}  // namespace hyperex::run
