// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/rig_face.hpp"

#include "hyperex/expression/rig_model.hpp"
#include "hyperex/io/gltf_shapes.hpp"
#include "hyperex/session/kept.hpp"

namespace hyperex::session {

expression::FaceModel rig_face(const std::filesystem::path& file, const KeptResults& kept) {
  const io::ShapedMesh rig = io::read_gltf_shapes(file);
  if (!rig.landmarks.empty()) return expression::rig_model(rig, rig.landmarks, file);
  io::Scan skin;
  skin.file = file;
  skin.mesh = rig.mesh;
  return expression::rig_model(rig, landmarks_on(skin, std::nullopt, kept).landmarks, file);
}

}  // namespace hyperex::session
