// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/lid_skin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/geodesic.hpp"
#include "hyperex/geometry/smooth_step.hpp"
#include "hyperex/simulate/drive/eye_opening.hpp"

namespace hyperex::simulate {
namespace {

constexpr double kLeastAperture_m = 0.002, kMostRatio = 2;
constexpr double kOfUpper = 6.0 / 7;
constexpr double kWholeChange_m = 0.002,
                 kNoChange_m = 0.007;    // walk to an edge: the whole change; none
constexpr double kBeyondEnds_m = 0.002;  // how far the change goes on there
constexpr double kDropped = 1e-5;        // a node with less is left out

/// Weights of outer nodes.
using NodeWeights = std::map<int, double>;

void add(NodeWeights& to, double factor, const NodeWeights& weights) {
  for (const auto& [node, weight] : weights) to[node] += factor * weight;
}

/// Which nodes move the skin.
class SkinMotion {
 public:
  SkinMotion(const tissue::TissueMesh& mesh, const std::vector<tissue::RimVertex>& rim)
      : mesh_(mesh) {
    for (const tissue::RimVertex& one : rim) rim_[one.vertex] = &one;
  }
  NodeWeights at_vertex(int vertex) const {
    NodeWeights weights;
    if (const auto at = rim_.find(vertex); at != rim_.end()) {
      for (std::size_t k = 0; k < at->second->node.size(); ++k)
        weights[at->second->node[k]] += at->second->weight[k];
      return weights;
    }
    const tissue::Anchor& anchor = mesh_.anchors[std::size_t(vertex)];
    for (int k = 0; k < 3; ++k) weights[anchor.node[std::size_t(k)]] += anchor.weight[k];
    return weights;
  }
  NodeWeights at(const Match& place) const {
    NodeWeights weights;
    for (int k = 0; k < 3; ++k)
      add(weights, place.weight[k], at_vertex(place.point[std::size_t(k)]));
    return weights;
  }
  NodeWeights at(const render::Picked& place) const {
    const auto corners = mesh_.skin.triangles.row(place.triangle);
    return at(Match{{corners[0], corners[1], corners[2]}, place.weights});
  }

 private:
  const tissue::TissueMesh& mesh_;
  std::map<int, const tissue::RimVertex*> rim_;
};

/// Of the two pairs: the place of the upper point and that of the lower one.
using EyePlaces = std::array<std::pair<Match, Match>, 2>;

/// Nothing where a point does not drive.
std::optional<EyePlaces> places_of(const EyePoints& points, const std::vector<std::string>& names,
                                   const std::vector<Match>& places) {
  EyePlaces found;
  for (std::size_t k = 0; k < 2; ++k)
    for (const auto& [point, place] : {std::pair{points.pairs[k].first, &found[k].first},
                                       {points.pairs[k].second, &found[k].second}}) {
      const auto at = std::ranges::find(names, face::ibug(point));
      if (at == names.end()) return {};
      *place = places[std::size_t(at - names.begin())];
    }
  return found;
}

/// How the aperture changes at the columns of an eye, less how it has to.
class MissingMotion {
 public:
  MissingMotion(const EyeOpening& eye, const std::vector<LidColumn>& columns,
                const EyePlaces& places, const SkinMotion& motion)
      : columns_(columns) {
    std::array<NodeWeights, 2> of_pair;
    for (std::size_t k = 0; k < 2; ++k) {
      add(of_pair[k], 1 / eye.aperture_m(k), motion.at(places[k].first));
      add(of_pair[k], -1 / eye.aperture_m(k), motion.at(places[k].second));
    }
    const double start_m = eye.along_of_pair_m(0), end_m = eye.along_of_pair_m(1);
    for (const LidColumn& column : columns) {
      const double aperture_m = eye.aperture_m(column);
      const double share = std::clamp((column.along_m - start_m) / (end_m - start_m), 0.0, 1.0);
      NodeWeights missing;
      add(missing, (1 - share) * aperture_m, of_pair[0]);
      add(missing, share * aperture_m, of_pair[1]);
      add(missing, -1, motion.at(column.upper));
      add(missing, 1, motion.at(column.lower));
      missing_.push_back(std::move(missing));
    }
  }

  /// Linear between columns; it ends soon after the last one.
  NodeWeights at(double along_m) const {
    NodeWeights missing;
    const double before_m = columns_.front().along_m - along_m,
                 behind_m = along_m - columns_.back().along_m;
    if (const double beyond_m = std::max(before_m, behind_m); beyond_m >= 0) {
      if (beyond_m < kBeyondEnds_m)
        add(missing, 1 - beyond_m / kBeyondEnds_m,
            before_m > behind_m ? missing_.front() : missing_.back());
      return missing;
    }
    const double place = -before_m / kLidColumn_m;
    const auto column = std::min(std::size_t(place), missing_.size() - 2);
    const double share = place - double(column);
    add(missing, 1 - share, missing_[column]);
    add(missing, share, missing_[column + 1]);
    return missing;
  }

 private:
  const std::vector<LidColumn>& columns_;
  std::vector<NodeWeights> missing_;
};

bool can_be_trusted(const EyeOpening& eye, const std::vector<LidColumn>& columns) {
  if (columns.size() < 2) return false;
  double widest_m = 0;
  for (const LidColumn& column : columns) widest_m = std::max(widest_m, eye.aperture_m(column));
  const double least_m = std::min(eye.aperture_m(0), eye.aperture_m(1));
  return least_m > kLeastAperture_m && least_m * kMostRatio > widest_m &&
         eye.along_of_pair_m(0) < eye.along_of_pair_m(1);
}

/// The corners of the triangles in which an edge of the lids is seen.
std::vector<int> vertices_at(const std::vector<LidColumn>& columns, render::Picked LidColumn::*edge,
                             const TriMesh& skin) {
  std::vector<int> vertices;
  for (const LidColumn& column : columns)
    for (const int v : skin.triangles.row((column.*edge).triangle)) vertices.push_back(v);
  return vertices;
}

tissue::RimVertex rim_vertex(int vertex, const NodeWeights& weights) {
  tissue::RimVertex out{vertex, {}, {}};
  for (const auto& [node, weight] : weights) {
    if (std::abs(weight) < kDropped) continue;
    out.node.push_back(node);
    out.weight.push_back(weight);
  }
  const double sum = std::accumulate(out.weight.begin(), out.weight.end(), 0.0);
  for (double& weight : out.weight) weight /= sum;
  return out;
}

}  // namespace

std::vector<tissue::RimVertex> share_lid_apertures(const tissue::TissueMesh& mesh,
                                                   const io::Landmarks& landmarks,
                                                   const std::vector<std::string>& names,
                                                   const std::vector<Match>& places,
                                                   std::vector<tissue::RimVertex> rim) {
  std::map<int, tissue::RimVertex> changed;
  const SkinMotion motion(mesh, rim);
  for (const EyePoints& points : kEyes) {
    const auto driven = places_of(points, names, places);
    if (!driven) continue;
    const EyeOpening eye(landmarks, points);
    const std::vector<LidColumn> columns = eye.columns(mesh.skin);
    if (!can_be_trusted(eye, columns)) continue;
    const MissingMotion missing(eye, columns, *driven, motion);
    const EdgePaths paths(mesh.skin);
    const auto to_upper =
                   paths.distances(vertices_at(columns, &LidColumn::upper, mesh.skin), kNoChange_m),
               to_lower =
                   paths.distances(vertices_at(columns, &LidColumn::lower, mesh.skin), kNoChange_m);
    for (std::size_t v = 0; v < mesh.anchors.size(); ++v) {
      const double walk_m = std::min(to_upper[v], to_lower[v]);
      if (!(walk_m < kNoChange_m)) continue;
      const double whole =
          1 - smooth_step((walk_m - kWholeChange_m) / (kNoChange_m - kWholeChange_m));
      const double share = to_upper[v] < to_lower[v] ? kOfUpper : kOfUpper - 1;
      NodeWeights weights = motion.at_vertex(int(v));
      add(weights, share * whole,
          missing.at(eye.along_m(mesh.skin.points.row(Eigen::Index(v)).transpose())));
      changed.insert_or_assign(int(v), rim_vertex(int(v), weights));
    }
  }
  if (changed.empty()) return rim;
  for (tissue::RimVertex& one : rim) {
    const int vertex = one.vertex;
    changed.try_emplace(vertex, std::move(one));
  }
  rim.clear();
  for (auto& [vertex, one] : changed) rim.push_back(std::move(one));
  return rim;
}

}  // namespace hyperex::simulate
