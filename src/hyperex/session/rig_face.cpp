// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/rig_face.hpp"

#include "hyperex/anatomy/lips.hpp"
#include "hyperex/expression/rig_model.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/clean_mesh.hpp"
#include "hyperex/io/gltf_shapes.hpp"
#include "hyperex/session/kept.hpp"
#include "hyperex/simulate/drive/skin_places.hpp"

namespace hyperex::session {
namespace {

/// Which lip is which on a rig's skin. Nothing where points of the mouth are missing.
expression::RigLips lips_of_rig(TriMesh skin, const io::Landmarks& landmarks) {
  for (int k = 48; k < 68; ++k)
    if (!landmarks.contains(face::ibug(k))) return {};
  // Programs repeat vertices where normals or textures part; paths must not end there.
  const std::vector<int> first = first_at_same_place(skin.points);
  skin.triangles =
      skin.triangles.unaryExpr([&](int vertex) { return first[std::size_t(vertex)]; }).eval();
  const std::vector<int> joined = simulate::lip_sides(anatomy::upper_lip_margin(skin, landmarks));
  expression::RigLips lips;
  for (const int vertex : first) lips.of_vertex.push_back(joined[std::size_t(vertex)]);
  for (const auto& [name, at] : landmarks) lips.of_landmark[name] = anatomy::lip_of(name);
  return lips;
}

}  // namespace

expression::FaceModel rig_face(const std::filesystem::path& file, const KeptResults& kept) {
  const io::ShapedMesh rig = io::read_gltf_shapes(file);
  io::Landmarks landmarks = rig.landmarks;
  if (landmarks.empty()) {
    io::Scan skin;
    skin.file = file;
    skin.mesh = rig.mesh;
    landmarks = landmarks_on(skin, std::nullopt, kept).landmarks;
  }
  return expression::rig_model(rig, landmarks, file, lips_of_rig(rig.mesh, landmarks));
}

}  // namespace hyperex::session
