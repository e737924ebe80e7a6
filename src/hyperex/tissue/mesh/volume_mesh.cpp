// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/mesh/volume_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hyperex/core/error.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "hyperex/tissue/mesh/bone_depth.hpp"
#include "hyperex/tissue/mesh/prism_split.hpp"
#include "hyperex/tissue/mesh/unfold.hpp"

namespace hyperex::tissue {
namespace {

double six_volumes(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (b - a).cross(c - a).dot(d - a);
}

class LayerBuilder {
 public:
  LayerBuilder(const TriMesh& outer, const Eigen::VectorXd& thickness,
               const VolumeMeshOptions& options)
      : outer_(outer),
        options_(options),
        around_(vertex_neighbours(outer.triangles, outer.points.rows())),
        fans_(vertex_triangles(outer.triangles, outer.points.rows())),
        unsound_(outer.triangles.rows(), 1) {
    normals_ = vertex_normals(outer);
    visible_ = visibility_of(outer_);
    inward_ = -(thickness.asDiagonal() * normals_);
    smooth_all(8, 0.5);
    // Opposite directions cancel in a mean, as at the corners of the mouth, where the layer would
    // become a membrane: what is smoothed is the direction.
    wanted_ = options.bones ? bone_depths(outer, inward_, thickness, *options.bones) : thickness;
    for (Eigen::Index v = 0; v < inward_.rows(); ++v) set_length(v, wanted_[v]);
  }

  int untangle();
  const Points& inward() const { return inward_; }
  const TriMesh& outer() const { return outer_; }
  int thinned(double share) const {
    int count = 0;
    for (Eigen::Index v = 0; v < inward_.rows(); ++v)
      count += inward_.row(v).norm() < share * wanted_[v];
    return count;
  }

 private:
  void smooth_all(int rounds, double weight) {
    for (int r = 0; r < rounds; ++r) {
      const Points old = inward_;
      for (Eigen::Index v = 0; v < old.rows(); ++v) {
        inward_.row(v) =
            (1 - weight) * old.row(v) + weight * mean_around(old, static_cast<int>(v)).transpose();
      }
    }
  }

  void set_length(Eigen::Index v, double length) {
    if (const double now = inward_.row(v).norm(); now > 0) inward_.row(v) *= length / now;
  }
  Vec3 point(int f, int k) const { return outer_.points.row(outer_.triangles(f, k)); }
  bool sound(int f) const;
  std::vector<char> unsound_vertices(const std::vector<char>& changed);
  void flatten(const std::vector<char>& bad);
  Vec3 mean_around(const Points& values, int v) const;

  TriMesh outer_;
  VolumeMeshOptions options_;
  std::vector<std::vector<int>> around_, fans_;
  std::vector<char> unsound_;  // per triangle
  Visibility visible_;
  Points normals_, inward_;
  Eigen::VectorXd wanted_;
};

/// Every tetrahedron of every sub-prism of triangle f is far enough from flat.
bool LayerBuilder::sound(int f) const {
  const std::array<int, 3> v{outer_.triangles(f, 0), outer_.triangles(f, 1),
                             outer_.triangles(f, 2)};
  const auto tets = split_prism({double(v[0]), double(v[1]), double(v[2])});
  const double area = 0.5 * (point(f, 1) - point(f, 0)).cross(point(f, 2) - point(f, 0)).norm();
  for (int layer = 0; layer < options_.layers; ++layer) {
    const double height =
        (inward_.row(v[0]).norm() + inward_.row(v[1]).norm() + inward_.row(v[2]).norm()) /
        (3 * options_.layers);
    const double least = options_.least_volume_share * 6 * area * height / 3;
    for (const auto& tet : tets) {
      Vec3 x[4];
      for (int i = 0; i < 4; ++i) {
        const double share = double(layer + tet[i].below) / options_.layers;
        x[i] = outer_.points.row(v[tet[i].corner]) + share * inward_.row(v[tet[i].corner]);
      }
      if (!(six_volumes(x[0], x[1], x[2], x[3]) > least)) return false;
    }
  }
  return true;
}

/// Returns how many vertices had to be changed. Each round turns the vertices of unsound prisms
/// towards the mean of their neighbours (first) or towards their most visible direction (later),
/// and thins them; from half way on it also flattens the skin there, which a fold needs.
int LayerBuilder::untangle() {
  std::vector<char> touched(inward_.rows(), 0);
  constexpr int rounds = 160;
  constexpr double thinnest_share =
      0.3;  // of the wanted thickness; thinner layers make flat elements
  std::vector<char> bad(inward_.rows(), 1);
  for (int round = 0; round < rounds; ++round) {
    bad = unsound_vertices(bad);
    if (std::count(bad.begin(), bad.end(), 1) == 0)
      return static_cast<int>(std::count(touched.begin(), touched.end(), 1));
    if (round >= rounds / 4 && round % 4 == 0) flatten(bad);
    const Points old = inward_;
    for (Eigen::Index v = 0; v < old.rows(); ++v) {
      if (!bad[v]) continue;
      touched[v] = 1;
      const Vec3 mean = mean_around(old, static_cast<int>(v));
      const Vec3 clear = -visible_.direction.row(v).transpose() * old.row(v).norm();
      const double turn = std::min(1.0, round / 40.0);
      const Vec3 target = (1 - turn) * mean + turn * clear;
      const double length = old.row(v).norm();
      const double thinner = length > thinnest_share * wanted_[v] ? 0.97 : 1;
      inward_.row(v) = thinner * (0.5 * old.row(v) + 0.5 * target.transpose());
      const double kept = std::min(length, thinnest_share * wanted_[v]);
      if (inward_.row(v).norm() < kept) set_length(v, kept);
    }
  }
  std::vector<int> left;
  for (int f = 0; f < outer_.triangles.rows(); ++f)
    if (!sound(f)) left.push_back(f);
  if (left.empty()) return static_cast<int>(std::count(touched.begin(), touched.end(), 1));
  const Vec3 where = 1e3 * point(left.front(), 0);
  throw FoldedSurface(
      fmt::format("no layer of tissue with positive volume fits under {} triangles of the skin, "
                  "one at ({:.1f}, {:.1f}, {:.1f}) mm: the surface is folded there",
                  left.size(), where.x(), where.y(), where.z()),
      left);
}

/// Looks again at the triangles of changed vertices alone: a fold is small, the face is not.
std::vector<char> LayerBuilder::unsound_vertices(const std::vector<char>& changed) {
  std::vector<char> stale(unsound_.size(), 0), bad(inward_.rows(), 0);
  for (std::size_t v = 0; v < changed.size(); ++v)
    if (changed[v])
      for (const int f : fans_[v]) stale[f] = 1;
  for (std::size_t f = 0; f < unsound_.size(); ++f) {
    if (stale[f]) unsound_[f] = !sound(static_cast<int>(f));
    if (unsound_[f])
      for (int k = 0; k < 3; ++k) bad[outer_.triangles(f, k)] = 1;
  }
  return bad;
}

void LayerBuilder::flatten(const std::vector<char>& bad) {
  const Points old = outer_.points;
  for (Eigen::Index v = 0; v < old.rows(); ++v)
    if (bad[v])
      outer_.points.row(v) =
          0.6 * old.row(v) + 0.4 * mean_around(old, static_cast<int>(v)).transpose();
  update_visibility(outer_, bad, fans_, visible_);
}

Vec3 LayerBuilder::mean_around(const Points& values, int v) const {
  Vec3 mean = Vec3::Zero();
  for (int w : around_[v]) mean += values.row(w).transpose();
  return mean / double(std::max<std::size_t>(1, around_[v].size()));
}

VolumeMesh build_once(const TriMesh& outer, const Eigen::VectorXd& thickness_m,
                      const VolumeMeshOptions& options) {
  LayerBuilder builder(outer, thickness_m, options);
  VolumeMesh mesh;
  const int changed = builder.untangle();
  if (changed > 0)
    mesh.notes.push_back(make_note(
        "mesh.layer_thinned", fmt::format("the layer was turned or thinned at {} of {} skin nodes, "
                                          "to below half of its thickness at {}",
                                          changed, outer.points.rows(), builder.thinned(0.5))));
  const Eigen::Index n = outer.points.rows();
  mesh.outer = builder.outer();
  mesh.layers = options.layers;
  mesh.thickness_m = builder.inward().rowwise().norm();
  mesh.nodes.resize(n * (options.layers + 1), 3);
  for (int level = 0; level <= options.layers; ++level)
    mesh.nodes.middleRows(level * n, n) =
        mesh.outer.points + (double(level) / options.layers) * builder.inward();
  mesh.tets.resize(outer.triangles.rows() * options.layers * 3, 4);
  for (int layer = 0; layer < options.layers; ++layer) {
    const std::vector<double> rank =
        prism_ranks(outer.triangles, mesh.nodes.middleRows(layer * n, n),
                    mesh.nodes.middleRows((layer + 1) * n, n));
    for (Eigen::Index f = 0; f < outer.triangles.rows(); ++f) {
      const std::array<int, 3> v{outer.triangles(f, 0), outer.triangles(f, 1),
                                 outer.triangles(f, 2)};
      Eigen::Index t = 3 * (f * options.layers + layer);
      for (const auto& tet : split_prism({rank[v[0]], rank[v[1]], rank[v[2]]})) {
        for (int i = 0; i < 4; ++i)
          mesh.tets(t, i) = static_cast<int>((layer + tet[i].below) * n) + v[tet[i].corner];
        ++t;
      }
    }
  }
  return mesh;
}

}  // namespace

VolumeMesh build_volume_mesh(const TriMesh& outer, const Eigen::VectorXd& thickness_m,
                             const VolumeMeshOptions& options) {
  // Plump elements everywhere if that can be had, flatter ones in the folds if not.
  VolumeMeshOptions attempt = options;
  for (const double share : {0.15, 0.08, 0.03}) {
    if (share <= options.least_volume_share) break;
    attempt.least_volume_share = share;
    try {
      return build_once(outer, thickness_m, attempt);
    } catch (const FoldedSurface&) {
    }
  }
  return build_once(outer, thickness_m, options);
}

MeshQuality quality_of(const Points& nodes, const Tetrahedra& tets) {
  MeshQuality q;
  q.least_volume_mm3 = 1e300;
  q.least_dihedral_deg = 180;
  q.worst_radius_ratio = 1;
  constexpr int bins = std::size(dihedral_bounds_deg) - 1;
  q.least_dihedral_shares.assign(bins, 0.0);
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    std::array<Vec3, 4> x;
    for (int i = 0; i < 4; ++i) x[i] = nodes.row(tets(t, i)) * 1e3;
    const double volume = six_volumes(x[0], x[1], x[2], x[3]) / 6;
    q.least_volume_mm3 = std::min(q.least_volume_mm3, volume);
    q.total_volume_mm3 += volume;
    // Face k lies opposite corner k; its area vector points outwards.
    constexpr int face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
    Vec3 area[4];
    for (int k = 0; k < 4; ++k)
      area[k] = 0.5 * (x[face[k][1]] - x[face[k][0]]).cross(x[face[k][2]] - x[face[k][0]]);
    double least = 180;
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) {
        const double cosine = -area[i].dot(area[j]) / (area[i].norm() * area[j].norm());
        const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
        least = std::min(least, angle);
        q.greatest_dihedral_deg = std::max(q.greatest_dihedral_deg, angle);
      }
    q.least_dihedral_deg = std::min(q.least_dihedral_deg, least);
    for (int b = 0; b < bins; ++b)
      if (least >= dihedral_bounds_deg[b] && least < dihedral_bounds_deg[b + 1])
        q.least_dihedral_shares[b] += 1.0 / double(tets.rows());
    q.worst_radius_ratio = std::min(q.worst_radius_ratio, radius_ratio(x));
  }
  q.mean_volume_mm3 = q.total_volume_mm3 / double(std::max<Eigen::Index>(1, tets.rows()));
  return q;
}

TriMesh boundary_of(const VolumeMesh& volume) {
  const auto count = static_cast<int>(volume.surface_nodes());
  const int inner = volume.inner_node(0);
  std::vector<std::array<int, 3>> triangles;
  for (Eigen::Index f = 0; f < volume.outer.triangles.rows(); ++f) {
    const auto t = volume.outer.triangles.row(f);
    triangles.push_back({t[0], t[1], t[2]});
    triangles.push_back({inner + t[0], inner + t[2], inner + t[1]});
  }
  for (const std::vector<int>& loop : boundary_loops(volume.outer.triangles))
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int a = loop[i], b = loop[(i + 1) % loop.size()];
      triangles.push_back({b, a, inner + a});
      triangles.push_back({b, inner + a, inner + b});
    }
  TriMesh out;
  out.points.resize(2 * count, 3);
  out.points << volume.nodes.topRows(count), volume.nodes.bottomRows(count);
  out.triangles.resize(Eigen::Index(triangles.size()), 3);
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int node = triangles[f][std::size_t(k)];
      out.triangles(Eigen::Index(f), k) = node < inner ? node : node - inner + count;
    }
  return out;
}

}  // namespace hyperex::tissue
