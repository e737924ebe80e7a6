// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>

#include "hyperex/expression/face_model.hpp"
#include "hyperex/io/gltf_shapes.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::expression {

/// A rig of ARKit's blend shapes as a face model, for motion_of(): its vertices are the landmarks
/// alone, each at the point of the skin nearest to the given one, and each shape with one of
/// ARKit's names is a recorded unit ("JawOpen" and "mouthSmile_L" count too). So weights move the
/// landmarks as they move the rig. `landmarks`: metres, on the rig at rest. Throws InputError,
/// naming `file`, if no shape has one of ARKit's names or if there are no landmarks.
FaceModel rig_model(const io::ShapedMesh& rig, const io::Landmarks& landmarks,
                    const std::filesystem::path& file);

}  // namespace hyperex::expression
