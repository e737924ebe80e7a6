// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/render/raster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hyperex::render {
namespace {

/// Corners lie on a grid of 2^-14 samples: what tells on which side of an edge a sample lies is
/// then exact in double precision (pictures of up to 4096 samples), and the same number but for its
/// sign from either side of an edge.
double on_grid(double samples) {
  constexpr double per_sample = 1 << 14;
  return std::nearbyint(samples * per_sample) / per_sample;
}

/// Twice the area of (p, q, sample) along a row of samples, the sign turned so that it is positive
/// on the triangle's side of the edge from p to q.
struct Edge {
  double first, step;  // at the row's first sample, and from one to the next

  template <class Corner>
  Edge(const Corner& p, const Corner& q, double x, double y, double sign)
      : first(sign * ((p.x - x) * (q.y - y) - (p.y - y) * (q.x - x))), step(sign * (p.y - q.y)) {}
  double at(int sample) const { return first + sample * step; }
  bool holds(int sample) const { return at(sample) >= 0; }

  /// Narrows begin to end, a range of samples, to those that it holds.
  void narrow(int& begin, int& end) const {
    if (step == 0) {
      if (first < 0) end = begin;
      return;
    }
    const double zero = std::clamp(-first / step, double(begin), double(end));
    if (step > 0) {
      begin = std::max(begin, int(zero));  // the quotient is rounded: what decides is holds()
      while (begin < end && !holds(begin)) ++begin;
    } else {
      end = std::min(end, int(zero) + 2);
      while (begin < end && !holds(end - 1)) --end;
    }
  }
};

/// Where a plane over samples `begin` to `end` of a row is nearer than what was seen so far.
void keep_nearer(float first_z, float step_z, int id, int begin, int end, float* z, int* seen) {
  for (int x = begin; x < end; ++x) {
    const float here = first_z + float(x) * step_z;
    const bool nearer = here > z[x];
    z[x] = nearer ? here : z[x];
    seen[x] = nearer ? id : seen[x];
  }
}

}  // namespace

Raster::Raster(const std::vector<Surface>& surfaces, const Camera& camera, int width, int height,
               double m_per_sample, int band_rows)
    : width_(width), height_(height), band_rows_(band_rows), m_per_sample_(m_per_sample) {
  for (std::size_t s = 0; s < surfaces.size(); ++s) add(surfaces[s], int(s), camera, m_per_sample);
  sort_into_bands();
}

void Raster::add(const Surface& surface, int index, const Camera& camera, double m_per_sample) {
  const Eigen::Matrix3d camera_from_world = camera.axes();
  std::vector<Corner> corners(std::size_t(surface.mesh.points.rows()));
  for (std::size_t v = 0; v < corners.size(); ++v) {
    const Vec3 world = surface.mesh.points.row(Eigen::Index(v)).transpose();
    const Vec3 local = camera_from_world * (world - camera.target);
    corners[v] = {on_grid(local[0] / m_per_sample + width_ / 2.0 - 0.5),
                  on_grid(height_ / 2.0 - 0.5 - local[1] / m_per_sample), local[2]};
  }
  for (Eigen::Index f = 0; f < surface.mesh.triangles.rows(); ++f) {
    const auto corner = [&](int k) { return corners[std::size_t(surface.mesh.triangles(f, k))]; };
    const Triangle t{corner(0), corner(1), corner(2), index, int(f)};
    const auto [left, right] = std::minmax({t.a.x, t.b.x, t.c.x});
    const auto [top, bottom] = std::minmax({t.a.y, t.b.y, t.c.y});
    // No sample lies in it; false, too, where a coordinate is not finite.
    if (!(std::ceil(left) <= std::floor(right) && std::ceil(top) <= std::floor(bottom))) continue;
    if (right < 0 || left > width_ - 1 || bottom < 0 || top > height_ - 1) continue;
    if (std::isfinite(t.a.z + t.b.z + t.c.z)) triangles_.push_back(t);
  }
}

void Raster::sort_into_bands() {
  const int count = (height_ + band_rows_ - 1) / band_rows_;
  const auto bands_of = [&](const Triangle& t) {
    const auto [top, bottom] = std::minmax({t.a.y, t.b.y, t.c.y});
    return std::pair{int(std::max(0.0, std::ceil(top))) / band_rows_,
                     int(std::min(height_ - 1.0, std::floor(bottom))) / band_rows_};
  };
  first_.assign(std::size_t(count) + 1, 0);
  for (const Triangle& t : triangles_)
    for (auto [band, last] = bands_of(t); band <= last; ++band) ++first_[std::size_t(band) + 1];
  for (std::size_t b = 1; b < first_.size(); ++b) first_[b] += first_[b - 1];
  of_band_.resize(std::size_t(first_.back()));
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < triangles_.size(); ++i)
    for (auto [band, last] = bands_of(triangles_[i]); band <= last; ++band)
      of_band_[std::size_t(next[std::size_t(band)]++)] = int(i);
}

void Raster::look(int band, std::vector<Hit>& hits) const {
  const int begin = band * band_rows_, end = std::min(height_, begin + band_rows_);
  const auto samples = std::size_t(end - begin) * std::size_t(width_);
  std::vector<float> nearest(samples, -std::numeric_limits<float>::infinity());
  std::vector<int> seen(samples, -1);
  for (int i = first_[std::size_t(band)]; i < first_[std::size_t(band) + 1]; ++i) {
    const int id = of_band_[std::size_t(i)];
    draw(triangles_[std::size_t(id)], id, begin, end, nearest.data(), seen.data());
  }
  hits.resize(samples);
  int last = -1;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  for (int y = begin; y < end; ++y)
    for (int x = 0; x < width_; ++x) {
      const auto at = std::size_t(y - begin) * std::size_t(width_) + std::size_t(x);
      Hit& hit = hits[at];
      hit.surface = -1;
      if (seen[at] < 0) continue;
      const Triangle& t = triangles_[std::size_t(seen[at])];
      if (seen[at] != last) normal = normal_of(t);
      last = seen[at];
      const double per_area = 1 / t.area();
      const double a = per_area * Edge(t.b, t.c, x, y, 1).first;
      const double b = per_area * Edge(t.c, t.a, x, y, 1).first;
      hit = {t.surface, t.triangle, {a, b, 1 - a - b}, normal};
    }
}

void Raster::draw(const Triangle& t, int id, int begin, int end, float* nearest, int* seen) const {
  const double area = t.area();
  if (area == 0) return;
  const auto [left, right] = std::minmax({t.a.x, t.b.x, t.c.x});
  const auto [top, bottom] = std::minmax({t.a.y, t.b.y, t.c.y});
  const int x0 = int(std::max(0.0, std::ceil(left)));
  const int count = int(std::min(width_ - 1.0, std::floor(right))) + 1 - x0;
  const int y0 = std::max(begin, int(std::max(0.0, std::ceil(top))));
  const int y1 = int(std::min(end - 1.0, std::floor(bottom)));
  const double sign = area > 0 ? 1 : -1, per_area = sign / area;
  for (int y = y0; y <= y1; ++y) {
    const Edge of_a(t.b, t.c, x0, y, sign), of_b(t.c, t.a, x0, y, sign),
        of_c(t.a, t.b, x0, y, sign);
    int from = 0, to = count;
    for (const Edge* edge : {&of_a, &of_b, &of_c}) edge->narrow(from, to);
    if (from >= to) continue;
    const auto z = [&](double a, double b, double c) {
      return per_area * (a * t.a.z + b * t.b.z + c * t.c.z);
    };
    const auto row = std::size_t(y - begin) * std::size_t(width_) + std::size_t(x0);
    keep_nearer(float(z(of_a.first, of_b.first, of_c.first)),
                float(z(of_a.step, of_b.step, of_c.step)), id, from, to, nearest + row, seen + row);
  }
}

Eigen::Vector3f Raster::normal_of(const Triangle& t) const {
  const auto side = [&](const Corner& p, const Corner& q) {
    return Vec3((q.x - p.x) * m_per_sample_, (p.y - q.y) * m_per_sample_, q.z - p.z);
  };
  return side(t.a, t.b).cross(side(t.a, t.c)).normalized().cast<float>();
}

}  // namespace hyperex::render
