// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "hyperex/expression/face_model.hpp"
#include "hyperex/io/gltf_shapes.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::expression {

/// Which lip is which, so that a point of one lip never moves with the other, on which it lies
/// where the mouth is closed.
struct RigLips {
  /// Per vertex of the rig: 1 on the upper lip's side, -1 on the lower one's, 0 where neither is
  /// sure. Empty: not known, and distance alone decides.
  std::vector<int> of_vertex;
  std::map<std::string, int> of_landmark;  ///< the same by name; 0 where it is not listed
};

/// A rig of ARKit's blend shapes as a face model, for motion_of(): its vertices are the landmarks
/// alone, each at the point of the skin nearest to the given one (a lip's on that lip), and each
/// shape with one of ARKit's names is a recorded unit ("JawOpen" and "mouthSmile_L" count too), as
/// is each corrective (correctives.hpp) of two shapes that the rig has. So weights move the
/// landmarks as they move the rig. `landmarks`: metres, on the rig at rest. Throws InputError,
/// naming `file`, if no shape has one of ARKit's names or if there are no landmarks.
FaceModel rig_model(const io::ShapedMesh& rig, const io::Landmarks& landmarks,
                    const std::filesystem::path& file, const RigLips& lips = {});

}  // namespace hyperex::expression
