// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/rig_face.hpp"

#include <map>
#include <utility>
#include <vector>

#include "hyperex/anatomy/lips.hpp"
#include "hyperex/expression/rig_model.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/clean_mesh.hpp"
#include "hyperex/io/gltf_shapes.hpp"
#include "hyperex/session/kept.hpp"
#include "hyperex/simulate/drive/skin_places.hpp"

namespace hyperex::session {
namespace {

/// For each vertex the first one that is at the same place at rest and moves alike. Programs repeat
/// vertices where normals or textures part. The rims of a mouth that was cut open are at one place
/// at rest, too, but move apart.
std::vector<int> first_alike(const io::ShapedMesh& rig) {
  Points moved = rig.mesh.points;
  for (std::size_t k = 0; k < rig.shapes.size(); ++k)  // by different weights: none cancel out
    moved += (1 + 0.01 * double(k)) * rig.shapes[k].displacement_m.cast<double>();
  const std::vector<int> at_rest = first_at_same_place(rig.mesh.points);
  const std::vector<int> in_motion = first_at_same_place(moved);
  std::map<std::pair<int, int>, int> known;
  std::vector<int> first(at_rest.size());
  for (std::size_t v = 0; v < first.size(); ++v)
    first[v] = known.try_emplace({at_rest[v], in_motion[v]}, int(v)).first->second;
  return first;
}

/// Which lip is which on a rig's skin. Nothing where points of the mouth are missing.
expression::RigLips lips_of_rig(const io::ShapedMesh& rig, const io::Landmarks& landmarks) {
  for (int k = 48; k < 68; ++k)
    if (!landmarks.contains(face::ibug(k))) return {};
  const std::vector<int> first = first_alike(rig);  // paths along the skin go on at repeated ones
  TriMesh skin = rig.mesh;
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
  return expression::rig_model(rig, landmarks, file, lips_of_rig(rig, landmarks));
}

}  // namespace hyperex::session
