// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/render/raster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hyperex/core/assert.hpp"
#include "hyperex/core/vector_clones.hpp"

namespace hyperex::render {
namespace {

/// Rounds to a grid of 2^-14 samples, on which all corners lie. The test on which side of an edge a
/// sample lies is then exact in double precision (for pictures of up to 4096 samples), and
/// antisymmetric in the edge.
double on_grid(double samples) {
  constexpr double per_sample = 1 << 14;
  return std::nearbyint(samples * per_sample) / per_sample;
}

/// Rounds up a number that fits an int; 0 for a negative one.
int rounded_up(double samples) {
  if (samples <= 0) return 0;
  const auto below = int(samples);
  return below + (samples > below ? 1 : 0);
}

using Plane = Raster::Plane;

/// A triangle over a box of samples; the planes start at the box's first sample.
struct Cover {
  Plane inside[3];  // one per edge; not below 0 on the triangle's side
  Plane z;          // depth
  int columns, rows;
};

/// Samples are processed in blocks of this many rows and columns. Most triangles of a face fit into
/// one block, so that no branch depends on their size.
constexpr int kBlock = 4;

/// Corners are prefetched for this many triangles ahead, since their addresses are not predictable.
constexpr int kAhead = 6;

/// Writes the triangle into the samples where it is nearer than the nearest one so far. Rows of
/// samples are `stride` apart. Up to kBlock - 1 samples beyond the box are processed in each row
/// and column; they lie outside the triangle or the band.
HX_CLONES void keep_nearer(const Cover& cover, int id, int stride, float* nearest, int* seen) {
  const Plane a = cover.inside[0], b = cover.inside[1], c = cover.inside[2];
  for (int y0 = 0; y0 < cover.rows; y0 += kBlock)
    for (int x0 = 0; x0 < cover.columns; x0 += kBlock)
      for (int y = y0; y < y0 + kBlock; ++y) {
        const double a0 = a.first + y * a.down, b0 = b.first + y * b.down;
        const double c0 = c.first + y * c.down, z0 = cover.z.first + y * cover.z.down;
        float* const near = nearest + std::ptrdiff_t(y) * stride;
        int* const ids = seen + std::ptrdiff_t(y) * stride;
        for (int x = x0; x < x0 + kBlock; ++x) {
          const auto z = static_cast<float>(z0 + x * cover.z.right);
          const bool covered = (a0 + x * a.right >= 0) & (b0 + x * b.right >= 0) &
                               (c0 + x * c.right >= 0) & (z > near[x]);
          near[x] = covered ? z : near[x];
          ids[x] = covered ? id : ids[x];
        }
      }
}

/// Twice the area of the triangle (p, q, sample), over a box that begins at sample (x, y).
template <class Corner>
Plane edge(const Corner& p, const Corner& q, double x, double y) {
  return {(p.x - x) * (q.y - y) - (p.y - y) * (q.x - x), p.y - q.y, q.x - p.x};
}

Plane times(double scale, const Plane& p) {
  return {scale * p.first, scale * p.right, scale * p.down};
}

}  // namespace

Raster::Raster(const std::vector<Surface>& surfaces, const Camera& camera, int width, int height,
               double m_per_sample, int band_rows)
    : width_(width), height_(height), band_rows_(band_rows), m_per_sample_(m_per_sample) {
  HX_ASSERT(width <= most_samples && height <= most_samples);
  std::vector<Triangle> seen;
  std::size_t corners = 0, triangles = 0;
  for (const Surface& surface : surfaces) {
    corners += std::size_t(surface.mesh.points.rows());
    triangles += std::size_t(surface.mesh.triangles.rows());
  }
  corners_.reserve(corners);  // for all at once: a reserve for each would copy the earlier ones
  seen.reserve(triangles);
  for (std::size_t s = 0; s < surfaces.size(); ++s)
    add(surfaces[s], int(s), camera, m_per_sample, seen);
  sort_into_bands(seen);
}

void Raster::add(const Surface& surface, int index, const Camera& camera, double m_per_sample,
                 std::vector<Triangle>& seen) {
  const Eigen::Matrix3d camera_from_world = camera.axes();
  const auto first = int(corners_.size());
  for (Eigen::Index v = 0; v < surface.mesh.points.rows(); ++v) {
    const Vec3 world = surface.mesh.points.row(v).transpose();
    const Vec3 local = camera_from_world * (world - camera.target);
    corners_.push_back({on_grid(local[0] / m_per_sample + width_ / 2.0 - 0.5),
                        on_grid(height_ / 2.0 - 0.5 - local[1] / m_per_sample), local[2]});
  }
  for (Eigen::Index f = 0; f < surface.mesh.triangles.rows(); ++f) {
    const auto at = [&](int k) { return first + surface.mesh.triangles(f, k); };
    Triangle t{{at(0), at(1), at(2)}, index, int(f), {}};
    if (may_be_seen(t)) seen.push_back(t);
  }
}

bool Raster::may_be_seen(Triangle& t) const {
  const Corner &a = corner(t, 0), &b = corner(t, 1), &c = corner(t, 2);
  const auto [left, right] = std::minmax({a.x, b.x, c.x});
  const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
  // This test comes before any rounding. It is also false where a coordinate is not finite.
  if (!(right >= 0 && left <= width_ - 1 && bottom >= 0 && top <= height_ - 1)) return false;
  if (!std::isfinite(left + right + top + bottom + a.z + b.z + c.z)) return false;
  const int first_x = rounded_up(left), first_y = rounded_up(top);
  const auto last_x = int(std::min(width_ - 1.0, right));
  const auto last_y = int(std::min(height_ - 1.0, bottom));
  if (first_x > last_x || first_y > last_y || area(t) == 0) return false;
  t.box = {std::uint16_t(first_x), std::uint16_t(last_x), std::uint16_t(first_y),
           std::uint16_t(last_y)};
  return true;
}

void Raster::sort_into_bands(const std::vector<Triangle>& seen) {
  const int count = (height_ + band_rows_ - 1) / band_rows_;
  const auto bands_of = [&](const Triangle& t) {
    return std::pair{t.box.top / band_rows_, t.box.bottom / band_rows_};
  };
  first_.assign(std::size_t(count) + 1, 0);
  for (const Triangle& t : seen)
    for (auto [band, last] = bands_of(t); band <= last; ++band) ++first_[std::size_t(band) + 1];
  for (std::size_t b = 1; b < first_.size(); ++b) first_[b] += first_[b - 1];
  triangles_.resize(std::size_t(first_.back()));
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (const Triangle& t : seen)
    for (auto [band, last] = bands_of(t); band <= last; ++band)
      triangles_[std::size_t(next[std::size_t(band)]++)] = t;
}

void Raster::look(int band, Seen& seen) const {
  const int begin = band * band_rows_, end = std::min(height_, begin + band_rows_);
  seen.stride = width_ + kBlock;
  const auto samples = std::size_t(end - begin + kBlock) * std::size_t(seen.stride);
  seen.first_row = begin;
  seen.rows = end - begin;
  seen.nearest.assign(samples, -std::numeric_limits<float>::infinity());
  seen.triangle.assign(samples, -1);
  const int first = first_[std::size_t(band)], last = first_[std::size_t(band) + 1];
  seen.drawn.clear();
  seen.drawn.reserve(std::size_t(last - first));
  for (int i = first; i < last; ++i) {
    if (i + kAhead < last)
      for (int k = 0; k < 3; ++k)
        __builtin_prefetch(&corner(triangles_[std::size_t(i + kAhead)], k));
    draw(i, seen);
  }
}

void Raster::draw(int id, Seen& seen) const {
  const Triangle& t = triangles_[std::size_t(id)];
  const Corner &a = corner(t, 0), &b = corner(t, 1), &c = corner(t, 2);
  const int x0 = t.box.left, y0 = std::max(seen.first_row, int(t.box.top));
  const int y1 = std::min(seen.first_row + seen.rows - 1, int(t.box.bottom));
  const double twice = area(t), sign = twice > 0 ? 1 : -1, per_area = sign / twice;
  const Plane of_a = edge(b, c, x0, y0), of_b = edge(c, a, x0, y0), of_c = edge(a, b, x0, y0);
  Cover cover{{times(sign, of_a), times(sign, of_b), times(sign, of_c)},
              {},
              t.box.right - x0 + 1,
              y1 - y0 + 1};
  const auto mixed = [&](double Plane::*part) {
    return per_area * (cover.inside[0].*part * a.z + cover.inside[1].*part * b.z +
                       cover.inside[2].*part * c.z);
  };
  cover.z = {mixed(&Plane::first), mixed(&Plane::right), mixed(&Plane::down)};
  const auto at = std::size_t(y0 - seen.first_row) * std::size_t(seen.stride) + std::size_t(x0);
  keep_nearer(cover, int(seen.drawn.size()), seen.stride, seen.nearest.data() + at,
              seen.triangle.data() + at);
  seen.drawn.push_back({t.surface, t.triangle, id, x0, y0, twice, {of_a, of_b}});
}

Raster::Weights Raster::Drawn::weights(int at_x, int at_y) const {
  const double per_area = 1 / area;
  const auto at = [&](const Plane& p) {
    return per_area * (p.first + (at_x - x) * p.right + (at_y - y) * p.down);
  };
  return {at(inside[0]), at(inside[1]), per_area * inside[0].right, per_area * inside[1].right};
}

Eigen::Vector3f Raster::normal(int id) const {
  const Triangle& t = triangles_[std::size_t(id)];
  const auto side = [&](const Corner& p, const Corner& q) {
    return Vec3((q.x - p.x) * m_per_sample_, (p.y - q.y) * m_per_sample_, q.z - p.z);
  };
  return side(corner(t, 0), corner(t, 1))
      .cross(side(corner(t, 0), corner(t, 2)))
      .normalized()
      .cast<float>();
}

}  // namespace hyperex::render
