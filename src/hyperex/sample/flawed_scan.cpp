// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/sample/flawed_scan.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <vector>

#include "hyperex/core/assert.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/clean_mesh.hpp"
#include "hyperex/geometry/hole_filling.hpp"
#include "hyperex/geometry/remesh.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "hyperex/sample/noise.hpp"
#include "hyperex/sample/painted_face.hpp"

namespace hyperex::sample {
namespace {

constexpr std::uint32_t kBorderSeed = 2, kNoiseSeed = 3;
constexpr int kRaggedRounds = 4;

void join_lips(TriMesh& mesh) {
  const int upper = face::lip_contour()[face::lip_contour().size() / 4];
  for (const auto& loop : boundary_loops(mesh.triangles))
    if (std::find(loop.begin(), loop.end(), upper) != loop.end()) {
      [[maybe_unused]] const bool filled = fill_hole(mesh, loop);
      HX_ASSERT(filled);
      return;
    }
  HX_ASSERT(false);
}

/// With a centre far in front of the face, the edge length is practically uniform.
TriMesh remeshed(const TriMesh& mesh, double edge_m) {
  return remesh_graded(mesh, {.edge_m = edge_m, .focus = Vec3::Zero(), .centre = {0, 0, 100}});
}

TriMesh without_balls(const TriMesh& mesh, const std::vector<Vec3>& centres, double radius_m) {
  std::vector<char> drop(std::size_t(mesh.triangles.rows()), 0);
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const Vec3 middle =
        (mesh.points.row(mesh.triangles(t, 0)) + mesh.points.row(mesh.triangles(t, 1)) +
         mesh.points.row(mesh.triangles(t, 2)))
            .transpose() /
        3;
    for (const Vec3& centre : centres)
      if ((middle - centre).norm() < radius_m) drop[std::size_t(t)] = 1;
  }
  return without_triangles(mesh, drop);
}

/// Removes random triangles along the outer border, which is the longest loop.
TriMesh ragged(TriMesh mesh, double share) {
  Noise noise(kBorderSeed);
  for (int round = 0; round < kRaggedRounds; ++round) {
    const auto loops = boundary_loops(mesh.triangles);
    const auto outer =
        std::max_element(loops.begin(), loops.end(),
                         [](const auto& a, const auto& b) { return a.size() < b.size(); });
    std::vector<char> broken(std::size_t(mesh.points.rows()), 0);
    for (const int v : *outer) broken[std::size_t(v)] = noise.uniform() < share ? 1 : 0;
    mesh = without_triangles(mesh, touching(mesh.triangles, broken));
  }
  return mesh;
}

void add_noise(TriMesh& mesh, double sigma_m) {
  Noise noise(kNoiseSeed);
  const Points normals = vertex_normals(mesh);
  for (Eigen::Index v = 0; v < mesh.points.rows(); ++v)
    mesh.points.row(v) += sigma_m * noise.normal() * normals.row(v);
}

/// The face looks along the scanner's -y, a little to the side and down.
Eigen::Isometry3d scanner_pose() {
  constexpr double degree = std::numbers::pi / 180;
  return Eigen::Translation3d(0.4, -0.1, 0.25) * Eigen::AngleAxisd(7 * degree, Vec3::UnitZ()) *
         Eigen::AngleAxisd(94 * degree, Vec3::UnitX());
}

}  // namespace

FlawedScan flawed_scan(const anatomy::EmbeddedFace& face, const ScanFlaws& flaws) {
  TriMesh mesh = face.mesh;
  join_lips(mesh);
  mesh = remeshed(mesh, flaws.edge_m);
  const io::Landmarks& at = face.landmarks;
  const std::array<Vec3, 3> places = {at.at("glabella") + Vec3(-0.012, 0.022, 0),
                                      at.at("cheek_R") + Vec3(-0.018, -0.002, 0),
                                      at.at(face::ibug(11)) + Vec3(-0.008, 0.012, 0)};
  const auto holes = std::size_t(std::clamp(flaws.holes, 0, int(places.size())));
  std::vector<Vec3> centres;
  for (std::size_t k = 0; k < holes; ++k) {
    Eigen::Index nearest = 0;  // on the surface
    (mesh.points.leftCols<2>().rowwise() - places[k].head<2>().transpose())
        .rowwise()
        .squaredNorm()
        .minCoeff(&nearest);
    centres.push_back(mesh.points.row(nearest).transpose());
  }
  mesh = without_balls(mesh, centres, flaws.hole_radius_m);
  mesh = ragged(std::move(mesh), flaws.ragged_share);
  FlawedScan scan;
  scan.colours = painted_face(mesh.points, face.landmarks);
  add_noise(mesh, flaws.noise_m);
  scan.scan_from_face = scanner_pose();
  const auto turned = [&](const Vec3& p) -> Vec3 { return scan.scan_from_face * p; };
  for (auto point : mesh.points.rowwise()) point = turned(point.transpose()).transpose().eval();
  for (const auto& [name, p] : face.landmarks) scan.landmarks[name] = turned(p);
  scan.mesh = std::move(mesh);
  return scan;
}

}  // namespace hyperex::sample
