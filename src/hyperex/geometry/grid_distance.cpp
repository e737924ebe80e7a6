// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/grid_distance.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/mesh_distance.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex {
namespace {

using Eigen::Index;

constexpr int kStride = 4;  // cells between the samples that are computed exactly everywhere
constexpr int kMargin = 3;  // cells beyond the band
constexpr double kMostSamples = 1 << 28;

/// The previous result in a row of samples. The distance between the two places bounds the change
/// of the result, and thereby the search.
struct Before {
  Vec3 place = Vec3::Zero();
  double distance = std::numeric_limits<double>::infinity();

  double bound(const Vec3& p) const { return distance + (p - place).norm(); }
  void set(const Vec3& p, double d) {
    place = p;
    distance = std::abs(d);
  }
};

std::vector<TriMesh> components_of(const TriMesh& mesh) {
  const std::vector<int> which = triangle_components(mesh.triangles, mesh.points.rows());
  const int count = 1 + *std::max_element(which.begin(), which.end());
  std::vector<std::vector<Index>> triangles(static_cast<std::size_t>(count));
  for (std::size_t f = 0; f < which.size(); ++f)
    triangles[std::size_t(which[f])].push_back(static_cast<Index>(f));
  std::vector<TriMesh> out;
  for (const auto& own : triangles) {
    std::map<int, int> renamed;
    TriMesh part;
    part.triangles.resize(static_cast<Index>(own.size()), 3);
    for (std::size_t i = 0; i < own.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const auto next = static_cast<int>(renamed.size());
        part.triangles(Index(i), k) =
            renamed.try_emplace(mesh.triangles(own[i], k), next).first->second;
      }
    part.points.resize(static_cast<Index>(renamed.size()), 3);
    for (const auto& [from, to] : renamed) part.points.row(to) = mesh.points.row(from);
    out.push_back(std::move(part));
  }
  return out;
}

/// The signed distance to the union of the components.
class Union {
 public:
  explicit Union(const TriMesh& mesh) : whole_(mesh) {
    for (TriMesh& part : components_of(mesh)) parts_.emplace_back(std::move(part));
  }
  /// The state that one sample of a row passes to the next.
  struct Row {
    std::vector<Before> part;
    Before whole;
    bool outside = false;  ///< whether whole.place is outside all components
  };
  Row begin_row() const { return {std::vector<Before>(parts_.size()), {}}; }

  double at(const Vec3& p, Row& row) const {
    // If the previous place was outside and farther from the surface than this step is long, this
    // place is outside too.
    if (!row.outside || (p - row.whole.place).norm() >= row.whole.distance) {
      double inside = 0;
      for (std::size_t c = 0; c < parts_.size(); ++c)
        if (parts_[c].may_hold(p)) {
          const double own = parts_[c].at(p, row.part[c].bound(p));
          row.part[c].set(p, own);
          inside = std::min(inside, own);
        }
      row.outside = inside >= 0;
      if (!row.outside) return inside;
    }
    // Outside the union, the closest surface is never a part that is hidden inside the union.
    const ClosestPoint near = whole_.query(p, row.whole.bound(p) * (1 + 1e-9) + 1e-12);
    row.whole.set(p, std::sqrt(near.squared_distance));
    return row.whole.distance;
  }

 private:
  SurfaceTree whole_;
  std::vector<MeshDistance> parts_;
};

/// Weights of four neighbouring samples, and their derivatives, at `t` in [0, 1] between the second
/// and the third.
struct Cubic {
  std::array<double, 4> value, slope;
  explicit Cubic(double t) {
    value = {t * (-0.5 + t * (1 - 0.5 * t)), 1 + t * t * (-2.5 + 1.5 * t),
             t * (0.5 + t * (2 - 1.5 * t)), t * t * (-0.5 + 0.5 * t)};
    slope = {-0.5 + t * (2 - 1.5 * t), t * (-5 + 4.5 * t), 0.5 + t * (4 - 4.5 * t),
             t * (-1 + 1.5 * t)};
  }
};

}  // namespace

GridDistance::GridDistance(const TriMesh& closed, const GridDistanceOptions& options)
    : cell_m_(options.cell_m) {
  if (closed.triangles.rows() == 0) throw std::invalid_argument("grid distance: no triangles");
  if (!(cell_m_ > 0) || !(options.band_m >= 0))
    throw std::invalid_argument("grid distance: cell or band out of range");
  if (!boundary_loops(closed.triangles).empty())
    throw std::invalid_argument("grid distance: the mesh has a border");
  const Union solid(closed);
  const Vec3 low = closed.points.colwise().minCoeff(), high = closed.points.colwise().maxCoeff();
  origin_ = low.array() - (options.band_m + kMargin * cell_m_);
  std::array<int, 3> coarse{};
  double samples = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double length = high[axis] - origin_[axis] + options.band_m + kMargin * cell_m_;
    const double blocks = std::ceil(length / (kStride * cell_m_));
    samples *= kStride * blocks + 1;
    if (!(samples <= kMostSamples)) throw std::invalid_argument("grid distance: too many samples");
    coarse[std::size_t(axis)] = static_cast<int>(blocks) + 1;
    size_[std::size_t(axis)] = kStride * static_cast<int>(blocks) + 1;
  }
  const auto offset = [](const std::array<int, 3>& size, int i, int j, int k) {
    return std::size_t(i) + std::size_t(size[0]) * (std::size_t(j) + std::size_t(size[1]) * k);
  };
  const auto place = [this](int i, int j, int k) {
    return Vec3(origin_ + cell_m_ * Vec3(i, j, k));
  };
  std::vector<float> far(std::size_t(coarse[0]) * coarse[1] * coarse[2]);
  tbb::parallel_for(0, coarse[1] * coarse[2], [&](int row) {
    const int j = row % coarse[1], k = row / coarse[1];
    Union::Row before = solid.begin_row();
    for (int i = 0; i < coarse[0]; ++i)
      far[offset(coarse, i, j, k)] =
          static_cast<float>(solid.at(place(kStride * i, kStride * j, kStride * k), before));
  });
  const double exact_within = options.band_m + cell_m_ * kStride / 2;
  sample_.resize(std::size_t(size_[0]) * size_[1] * size_[2]);
  tbb::parallel_for(0, size_[1] * size_[2], [&](int row) {
    const int j = row % size_[1], k = row / size_[1];
    Union::Row before = solid.begin_row();
    for (int i = 0; i < size_[0]; ++i) {
      const std::array<int, 3> at{i, j, k};
      std::array<int, 3> block{};
      std::array<double, 3> t{};
      for (std::size_t a = 0; a < 3; ++a) {
        block[a] = std::min(at[a] / kStride, coarse[a] - 2);
        t[a] = double(at[a] - kStride * block[a]) / kStride;
      }
      double value = 0;
      for (int corner = 0; corner < 8; ++corner) {
        const int x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
        value += (x ? t[0] : 1 - t[0]) * (y ? t[1] : 1 - t[1]) * (z ? t[2] : 1 - t[2]) *
                 far[offset(coarse, block[0] + x, block[1] + y, block[2] + z)];
      }
      if (std::abs(value) < exact_within) value = solid.at(place(i, j, k), before);
      sample_[offset(size_, i, j, k)] = static_cast<float>(value);
    }
  });
}

double GridDistance::at(const Vec3& place, Vec3& outward) const {
  const Vec3 grid = (place - origin_) / cell_m_;
  Vec3 within;
  std::array<int, 3> first{};
  for (int a = 0; a < 3; ++a) {
    const int last = size_[std::size_t(a)] - 3;
    within[a] = std::clamp(grid[a], 1.0, double(last) + 1);
    first[std::size_t(a)] = std::min(static_cast<int>(within[a]), last) - 1;
  }
  const Cubic x(within[0] - first[0] - 1), y(within[1] - first[1] - 1), z(within[2] - first[2] - 1);
  double value = 0;
  outward.setZero();
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t j = 0; j < 4; ++j) {
      const float* row = sample_.data() + std::size_t(first[0]) +
                         std::size_t(size_[0]) *
                             (std::size_t(first[1]) + j + std::size_t(size_[1]) * (first[2] + k));
      double along = 0, slope = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        along += x.value[i] * row[i];
        slope += x.slope[i] * row[i];
      }
      value += y.value[j] * z.value[k] * along;
      outward += Vec3(y.value[j] * z.value[k] * slope, y.slope[j] * z.value[k] * along,
                      y.value[j] * z.slope[k] * along);
    }
  outward /= cell_m_;
  const Vec3 beyond = cell_m_ * (grid - within);
  const double off = beyond.norm();
  if (off > 0) {
    outward = (beyond.array() == 0).select(outward, beyond / off);
    value += off;
  }
  return value;
}

}  // namespace hyperex
