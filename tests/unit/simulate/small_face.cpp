// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/small_face.hpp"

#include <algorithm>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/anatomy/lips.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/clean_mesh.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "hyperex/motion/embedded_motion.hpp"

namespace hyperex::simulate::test {

SmallFace small_face(int layers) {
  const anatomy::CanonicalFace& canonical = anatomy::canonical_face();
  SmallFace face;
  for (const auto& name : face::all_ibug())
    face.landmarks[name] = canonical.landmark(name, canonical.mesh.points);
  TriMesh open{canonical.mesh.points, Triangles(0, 3)};
  for (int f = 0; f < canonical.mesh.triangles.rows(); ++f) {
    bool closes = false;
    for (const auto* part : {&canonical.right_eye, &canonical.left_eye, &canonical.mouth})
      closes |= std::count(part->begin(), part->end(), f) > 0;
    if (closes) continue;
    open.triangles.conservativeResize(open.triangles.rows() + 1, 3);
    open.triangles.bottomRows(1) = canonical.mesh.triangles.row(f);
  }
  tissue::TissueMesh& mesh = face.mesh;
  tissue::VolumeMeshOptions options;
  options.layers = layers;
  mesh.volume = tissue::build_volume_mesh(
      open, Eigen::VectorXd::Constant(open.points.rows(), 0.004), options);
  mesh.skin = mesh.volume.outer;
  mesh.scan_vertices = mesh.skin.points.rows();
  for (int f = 0; f < mesh.skin.triangles.rows(); ++f) mesh.source_triangle.push_back(f);
  for (int v = 0; v < mesh.skin.points.rows(); ++v) mesh.anchors.push_back({{v, v, v}, {1, 0, 0}});
  mesh.upper_margin = mesh.skin_upper_margin = anatomy::upper_lip_margin(mesh.skin, face.landmarks);
  mesh.on_border.assign(mesh.skin.points.rows(), 0);
  const auto loops = boundary_loops(mesh.skin.triangles);
  const auto& outer = *std::max_element(
      loops.begin(), loops.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
  for (int v : outer) mesh.on_border[v] = 1;
  mesh.quality = tissue::quality_of(mesh.volume.nodes, mesh.volume.tets);
  return face;
}

AlignedMotion motion_of(
    const io::Landmarks& landmarks, int samples, double rate_hz,
    const std::function<Vec3(const std::string&, const Vec3&, int)>& displacement) {
  AlignedMotion out;
  out.motion.source = "test motion";
  out.rest.resize(static_cast<Eigen::Index>(landmarks.size()), 3);
  for (const auto& [name, p] : landmarks) {
    out.rest.row(static_cast<Eigen::Index>(out.motion.names.size())) = p.transpose();
    out.motion.names.push_back(name);
  }
  out.common = out.motion.names;
  for (int k = 0; k < samples; ++k) {
    out.motion.time_s.push_back(k / rate_hz);
    Points at = out.rest;
    for (Eigen::Index i = 0; i < at.rows(); ++i)
      at.row(i) += displacement(out.motion.names[i], out.rest.row(i), k).transpose();
    out.motion.positions.push_back(at);
  }
  return out;
}

AlignedMotion mouth_opening(const io::Landmarks& landmarks, double peak_deg, int samples,
                            double rate_hz) {
  motion::MouthOpeningOptions options;
  options.peak_deg = peak_deg;
  options.duration_s = samples / rate_hz;
  options.rate_hz = rate_hz;
  options.head_moves = false;
  const motion::Motion made = motion::embedded_mouth_opening(landmarks, options);
  return motion_of(landmarks, samples, rate_hz, [&](const std::string& name, const Vec3& x, int k) {
    return Vec3(made.positions[k].row(made.index_of(name)).transpose() - x);
  });
}

const std::vector<std::string>& seven_points() {
  static const std::vector<std::string> names = {"ibug68_48", "ibug68_54", "ibug68_51", "ibug68_57",
                                                 "ibug68_8",  "ibug68_58", "ibug68_56"};
  return names;
}

}  // namespace hyperex::simulate::test
