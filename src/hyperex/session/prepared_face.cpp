// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/prepared_face.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <concepts>
#include <utility>

#include "hyperex/core/pack_options.hpp"
#include "hyperex/core/packed.hpp"
#include "hyperex/core/run_together.hpp"
#include "hyperex/session/kept.hpp"
#include "hyperex/session/thinned_scan.hpp"

namespace hyperex {

// The parts of each type, for packed.hpp.

template <class T, class Of>
concept SameButConst = std::same_as<std::remove_const_t<T>, Of>;

template <class Archive, SameButConst<TriMesh> T>
void parts(Archive& archive, T& of) {
  auto& [points, triangles] = of;
  archive(points, triangles);
}
template <class Archive, SameButConst<EdgePoint> T>
void parts(Archive& archive, T& of) {
  auto& [a, b, t] = of;
  archive(a, b, t);
}
template <class Archive, SameButConst<MeshPlace> T>
void parts(Archive& archive, T& of) {
  auto& [vertex, weight] = of;
  archive(vertex, weight);
}
template <class Archive, SameButConst<tissue::Anchor> T>
void parts(Archive& archive, T& of) {
  auto& [node, weight] = of;
  archive(node, weight);
}
template <class Archive, SameButConst<tissue::RimVertex> T>
void parts(Archive& archive, T& of) {
  auto& [vertex, node, weight] = of;
  archive(vertex, node, weight);
}
template <class Archive, SameButConst<tissue::FullSkin> T>
void parts(Archive& archive, T& of) {
  auto& [skin, scan_vertices, appended, source_triangle, kept, kept_triangle, places] = of;
  archive(skin, scan_vertices, appended, source_triangle, kept, kept_triangle, places);
}
template <class Archive, SameButConst<Note> T>
void parts(Archive& archive, T& of) {
  auto& [id, severity, text, key, variant] = of;
  archive(id, severity, text, key, variant);
}
template <class Archive, SameButConst<tissue::VolumeMesh> T>
void parts(Archive& archive, T& of) {
  auto& [nodes, tets, outer, layers, thickness_m, notes] = of;
  archive(nodes, tets, outer, layers, thickness_m, notes);
}
template <class Archive, SameButConst<tissue::MeshQuality> T>
void parts(Archive& archive, T& of) {
  auto& [least, mean, total, least_deg, greatest_deg, shares, ratio] = of;
  archive(least, mean, total, least_deg, greatest_deg, shares, ratio);
}
template <class Archive, SameButConst<tissue::TissueMesh> T>
void parts(Archive& archive, T& of) {
  // `full` is packed apart, and `bones` are an input.
  auto& [skin, full, scan_vertices, appended, source_triangle, lip_cut, volume, anchors, rim,
         upper_margin, skin_upper_margin, on_border, quality, mean_mm, max_mm, notes, bones] = of;
  archive(skin, scan_vertices, appended, source_triangle, lip_cut, volume, anchors, rim,
          upper_margin, skin_upper_margin, on_border, quality, mean_mm, max_mm, notes);
}
template <class Archive, SameButConst<metrics::MidsagittalPlane> T>
void parts(Archive& archive, T& of) {
  auto& [normal, offset_m, landmark_rms_m, surface_rms_m, turned_deg, shifted_m, rounds, note] = of;
  archive(normal, offset_m, landmark_rms_m, surface_rms_m, turned_deg, shifted_m, rounds, note);
}
template <class Archive, SameButConst<metrics::Counterparts> T>
void parts(Archive& archive, T& of) {
  auto& [vertices, weights, distance_m, found] = of;
  archive(vertices, weights, distance_m, found);
}
template <class Archive, SameButConst<metrics::RestAsymmetry> T>
void parts(Archive& archive, T& of) {
  auto& [plane, pairs, rms_mm, p95_mm, paired_share, face, mouth] = of;
  archive(plane, pairs, rms_mm, p95_mm, paired_share, face, mouth);
}

}  // namespace hyperex

namespace hyperex::session {

metrics::RestAsymmetry rest_asymmetry(const tissue::TissueMesh& mesh, const Inputs& inputs) {
  constexpr double lip_margin_m = 0.002;  // nearer to both lips, a vertex is of neither
  std::vector<int> side;
  for (const double m : mesh.skin_upper_margin)
    side.push_back(m > lip_margin_m ? 1 : m < -lip_margin_m ? -1 : 0);
  return metrics::rest_asymmetry(mesh.skin, inputs.landmarks, side);
}

namespace {

std::string mesh_key(const scene::Scene& scene, const Inputs& inputs,
                     const std::vector<char>& held) {
  Packer of;
  of(inputs.scan.mesh.points, inputs.scan.mesh.triangles, inputs.scan.file.string(), held);
  for (const auto& [name, at] : inputs.landmarks) of(name, at);
  pack_options(scene.mesh, of);
  if (inputs.bones)
    for (const TriMesh* bone : {&inputs.bones->skull(), &inputs.bones->mandible()})
      of(bone->points, bone->triangles);
  return kept_key("face", of.bytes());
}

PreparedFace made(const scene::Scene& scene, Inputs& inputs, const std::vector<char>& held,
                  const std::function<void()>& skin_known) {
  PreparedFace face;
  tissue::TissueMeshBuilder builder(inputs.scan.mesh, inputs.landmarks, scene.mesh,
                                    inputs.scan.file.string(), held, inputs.bones);
  const tissue::TissueMesh& skin = builder.with_skin();
  if (skin.full) inputs.scan = thinned_scan(inputs.scan, *skin.full, skin.skin);
  skin_known();
  run_together(
      {[&] { face.mesh = builder.build(); }, [&] { face.at_rest = rest_asymmetry(skin, inputs); }});
  return face;
}

}  // namespace

namespace {

bool below(int i, Eigen::Index bound) {
  return i >= 0 && i < bound;
}
/// A list of indices, or of three each.
bool below(const auto& list, Eigen::Index bound) {
  return std::all_of(std::begin(list), std::end(list),
                     [&](const auto& i) { return below(i, bound); });
}
template <class Int, int... of>
bool below(const Eigen::Matrix<Int, of...>& all, Eigen::Index bound) {
  return all.size() == 0 || (all.minCoeff() >= 0 && all.maxCoeff() < bound);
}
bool below(const TriMesh& mesh) {
  return below(mesh.triangles, mesh.points.rows());
}
bool as_many(const auto& list, Eigen::Index count) {
  return Eigen::Index(list.size()) == count;
}

/// The parts of `skin` that say where it lies on a scan.
bool lies_on(const auto& on, const TriMesh& scan) {
  return on.scan_vertices == scan.points.rows() && below(on.skin) &&
         as_many(on.appended, on.skin.points.rows() - on.scan_vertices) &&
         as_many(on.source_triangle, on.skin.triangles.rows()) &&
         below(on.source_triangle, scan.triangles.rows()) &&
         std::all_of(on.appended.begin(), on.appended.end(), [&](const EdgePoint& e) {
           return below(e.a, on.scan_vertices) && below(e.b, on.scan_vertices);
         });
}

bool is_sound(const tissue::FullSkin& full, const TriMesh& thinned) {
  const Eigen::Index all = full.skin.points.rows();
  return as_many(full.kept, thinned.points.rows()) && below(full.kept, all) &&
         as_many(full.kept_triangle, thinned.triangles.rows()) &&
         below(full.kept_triangle, full.skin.triangles.rows()) && as_many(full.places, all) &&
         std::all_of(full.places.begin(), full.places.end(), [&](const MeshPlace& place) {
           return below(place.vertex, thinned.points.rows());
         });
}

bool is_sound(const tissue::VolumeMesh& volume) {
  return volume.tets.rows() > 0 && below(volume.tets, volume.nodes.rows()) && below(volume.outer) &&
         volume.layers >= 1 &&
         volume.nodes.rows() == (volume.layers + 1) * volume.surface_nodes() &&
         as_many(volume.thickness_m, volume.surface_nodes());
}

bool is_sound(const tissue::TissueMesh& mesh) {
  const Eigen::Index skin = mesh.skin.points.rows(), outer = mesh.volume.surface_nodes();
  return is_sound(mesh.volume) && as_many(mesh.anchors, skin) && as_many(mesh.on_border, outer) &&
         as_many(mesh.upper_margin, outer) && as_many(mesh.skin_upper_margin, skin) &&
         std::all_of(mesh.anchors.begin(), mesh.anchors.end(),
                     [&](const tissue::Anchor& a) { return below(a.node, outer); }) &&
         std::all_of(mesh.rim.begin(), mesh.rim.end(), [&](const tissue::RimVertex& r) {
           return below(r.vertex, skin) && below(r.node, outer) && r.weight.size() == r.node.size();
         });
}

bool is_sound(const metrics::RestAsymmetry& at_rest, Eigen::Index skin) {
  const metrics::Counterparts& pairs = at_rest.pairs;
  return as_many(pairs.vertices, skin) && as_many(pairs.weights, skin) &&
         as_many(pairs.distance_m, skin) && as_many(pairs.found, skin) &&
         below(at_rest.face, skin) && below(at_rest.mouth, skin) &&
         std::all_of(pairs.vertices.begin(), pairs.vertices.end(),
                     [&](const auto& vertices) { return below(vertices, skin); });
}

}  // namespace

bool fits(const PreparedFace& face, const TriMesh& scan) {
  const tissue::TissueMesh& mesh = *face.mesh;
  const bool on_scan = mesh.full ? lies_on(*mesh.full, scan) && is_sound(*mesh.full, mesh.skin) &&
                                       lies_on(mesh, mesh.skin)
                                 : lies_on(mesh, scan);
  return on_scan && is_sound(mesh) && is_sound(face.at_rest, mesh.skin.points.rows());
}

std::string bytes_of(const PreparedFace& face) {
  Packer packer;
  packer(*face.mesh, face.at_rest, face.mesh->full != nullptr);
  if (face.mesh->full) packer(*face.mesh->full);
  return packer.bytes();
}

std::optional<PreparedFace> prepared_face_from(const std::string& bytes) {
  try {
    Unpacker unpacker(bytes);
    auto mesh = std::make_shared<tissue::TissueMesh>();
    PreparedFace face;
    bool thinned = false;
    unpacker(*mesh, face.at_rest, thinned);
    if (thinned) {
      auto full = std::make_shared<tissue::FullSkin>();
      unpacker(*full);
      mesh->full = std::move(full);
    }
    if (!unpacker.at_end()) return std::nullopt;
    face.mesh = std::move(mesh);
    return face;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

namespace {

/// The mesh with the bones that it was made on, which are not kept with it.
std::shared_ptr<const tissue::TissueMesh> with_bones(std::shared_ptr<const tissue::TissueMesh> mesh,
                                                     std::shared_ptr<const anatomy::Bones> bones) {
  if (!bones) return mesh;
  auto out = std::make_shared<tissue::TissueMesh>(*mesh);
  out->bones = std::move(bones);
  return out;
}

}  // namespace

PreparedFace prepare_face(const scene::Scene& scene, Inputs& inputs,
                          const std::function<void()>& skin_known) {
  const std::vector<char> held = on_seams(inputs.scan);
  if (!scene.kept.in_use()) return made(scene, inputs, held, skin_known);
  const std::string key = mesh_key(scene, inputs, held);
  if (const auto bytes = scene.kept.find(key))
    if (auto face = prepared_face_from(*bytes); face && fits(*face, inputs.scan.mesh)) {
      spdlog::info(
          "using the mesh that an earlier run made of this scan (--no-cache makes it anew)");
      if (const auto& full = face->mesh->full)
        inputs.scan = thinned_scan(inputs.scan, *full, face->mesh->skin);
      skin_known();
      face->mesh = with_bones(std::move(face->mesh), inputs.bones);
      return *std::move(face);
    }
  PreparedFace face = made(scene, inputs, held, skin_known);
  scene.kept.keep(key, bytes_of(face));
  return face;
}

}  // namespace hyperex::session
