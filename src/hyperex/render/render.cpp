// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/render/render.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "hyperex/render/canvas.hpp"
#include "hyperex/render/raster.hpp"
#include "hyperex/render/ray_scene.hpp"

namespace hyperex::render {
namespace {

using Vec3f = Eigen::Vector3f;
using ColourTable = std::vector<Vec3f>;  // linear light

Vec3f linear(const Colour& colour) {
  return Eigen::Vector3d(linear_from_srgb(colour.r), linear_from_srgb(colour.g),
                         linear_from_srgb(colour.b))
      .cast<float>();
}

/// Linear light of a channel's byte.
float linear_byte(std::uint8_t byte) {
  static const auto table = [] {
    std::array<float, 256> t{};
    for (std::size_t i = 0; i < t.size(); ++i) t[i] = float(linear_from_srgb(double(i) / 255.0));
    return t;
  }();
  return table[byte];
}

std::uint8_t srgb_byte_exactly(float light) {
  return static_cast<std::uint8_t>(
      std::lround(255 * std::clamp(srgb_from_linear(std::min(light, 1.f)), 0.0, 1.0)));
}

/// The same, from a table of the bytes at 4096 intensities. Where the bytes on both sides of an
/// intensity differ, it is computed exactly.
std::uint8_t srgb_byte(float light) {
  constexpr int last = 4095;
  static const auto table = [] {
    std::array<std::uint8_t, last + 1> t{};
    for (int i = 0; i <= last; ++i) t[std::size_t(i)] = srgb_byte_exactly(float(i) / last);
    return t;
  }();
  if (!(light > 0) || light >= 1) return srgb_byte_exactly(light);
  const auto below = std::size_t(light * last);
  return table[below] == table[below + 1] ? table[below] : srgb_byte_exactly(light);
}

// Fine enough for 8 bits a channel.
const ColourTable& linear_moss() {
  static const ColourTable table = [] {
    constexpr int last = 4095;
    ColourTable t;
    for (int i = 0; i <= last; ++i) t.push_back(linear(moss(i / double(last))));
    return t;
  }();
  return table;
}

// A surface prepared for drawing: normals in the camera's frame, and a colour for each vertex
// unless it has a scalar. The scalar is interpolated first and then mapped to a colour, since
// interpolated colours would leave the colour map.
struct Prepared {
  const Surface* surface;
  PointsF normals;
  ColourTable colours;
  Vec3f plain;
  const ColourTable* map = &linear_moss();

  Prepared(const Surface& s, const Eigen::Matrix3d& camera_from_world)
      : surface(&s), plain(linear(s.plain)) {
    const TriMesh& mesh = s.mesh;
    const Eigen::Index vertices = mesh.points.rows();
    if (s.scalar.size() != 0 && s.scalar.size() != vertices)
      throw std::invalid_argument("render: one scalar a vertex is needed");
    if (s.colours.rows() != 0 && s.colours.rows() != vertices)
      throw std::invalid_argument("render: one colour a vertex is needed");
    if (mesh.triangles.rows() > 0 &&
        (mesh.triangles.minCoeff() < 0 || mesh.triangles.maxCoeff() >= vertices))
      throw std::invalid_argument("render: a triangle's index is out of range");
    if (s.smooth) {
      Points sum = Points::Zero(vertices, 3);
      for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
        const Vec3 a = mesh.points.row(mesh.triangles(f, 0));
        const Vec3 b = mesh.points.row(mesh.triangles(f, 1));
        const Vec3 c = mesh.points.row(mesh.triangles(f, 2));
        const Vec3 normal = (b - a).cross(c - a);  // its length weights by area
        for (int k = 0; k < 3; ++k) sum.row(mesh.triangles(f, k)) += normal.transpose();
      }
      normals = (sum * camera_from_world.transpose()).rowwise().normalized().cast<float>();
    }
    if (s.scalar.size() == 0)
      for (const auto bytes : s.colours.rowwise())
        colours.push_back({linear_byte(bytes[0]), linear_byte(bytes[1]), linear_byte(bytes[2])});
  }
};

// The corner values of a visible triangle. They are copied, since in the surface they are in
// separate rows.
class Corners {
 public:
  Corners() = default;
  Corners(const Prepared& prepared, const Raster& raster, const Raster::Drawn& drawn)
      : from_(&prepared), raster_(&raster), id_(drawn.id) {
    const Surface& s = *prepared.surface;
    const auto vertices = s.mesh.triangles.row(drawn.triangle);
    for (int k = 0; k < 3; ++k) {
      const Eigen::Index v = vertices[k];
      if (s.smooth) normal_[k] = prepared.normals.row(v).transpose();
      if (s.scalar.size() != 0)
        scalar_[k] = s.scalar[v];
      else if (!prepared.colours.empty())
        colour_[k] = prepared.colours[std::size_t(v)];
    }
  }

  /// Prefetches the memory that the constructor reads.
  static void fetch(const Prepared& prepared, const Raster::Drawn& drawn) {
    const Surface& s = *prepared.surface;
    const auto vertices = s.mesh.triangles.row(drawn.triangle);
    for (int k = 0; k < 3; ++k) {
      if (s.smooth) __builtin_prefetch(prepared.normals.row(vertices[k]).data());
      if (s.scalar.size() != 0)
        __builtin_prefetch(s.scalar.data() + vertices[k]);
      else if (!prepared.colours.empty())
        __builtin_prefetch(&prepared.colours[std::size_t(vertices[k])]);
    }
  }

  Vec3f colour_at(const Vec3f& weight) const {
    if (from_->surface->scalar.size() != 0) {
      const double value =
          weight[0] * scalar_[0] + weight[1] * scalar_[1] + double(weight[2]) * scalar_[2];
      if (std::isnan(value)) return from_->plain;
      const ColourTable& map = *from_->map;
      return map[std::size_t(share_in(from_->surface->range, value) * double(map.size() - 1) +
                             0.5)];
    }
    if (from_->colours.empty()) return from_->plain;
    return colour_[0] * weight[0] + colour_[1] * weight[1] + colour_[2] * weight[2];
  }

  Vec3f normal_at(const Vec3f& weight) const {
    if (!from_->surface->smooth) return raster_->normal(id_);
    const Vec3f normal = normal_[0] * weight[0] + normal_[1] * weight[1] + normal_[2] * weight[2];
    const float length = normal.norm();
    return length > 1e-6f ? Vec3f(normal / length) : raster_->normal(id_);
  }

 private:
  const Prepared* from_ = nullptr;
  const Raster* raster_ = nullptr;
  int id_ = -1;
  double scalar_[3] = {0, 0, 0};
  Vec3f normal_[3], colour_[3];
};

struct Sum {
  Vec3f light = Vec3f::Zero();
  int hits = 0;
};

/// Buffers of a thread for one band. They are kept from band to band, since allocating them would
/// cost more than using them.
struct Room {
  Raster::Seen seen;
  std::vector<char> known;       // for each triangle of the band, whether it is in `visible`
  std::vector<int> visible;      // indices of the triangles that a sample sees
  std::vector<Corners> corners;  // of the visible triangles, at the triangle's index in the band
  std::vector<Sum> row;
};

void take_corners(const Raster& raster, const std::vector<Prepared>& prepared, Room& room) {
  const Raster::Seen& seen = room.seen;
  std::vector<int>& visible = room.visible;
  visible.clear();
  room.known.assign(seen.drawn.size(), 0);
  for (const int i : seen.triangle) {
    if (i < 0 || room.known[std::size_t(i)]) continue;
    room.known[std::size_t(i)] = 1;
    visible.push_back(i);
  }
  constexpr std::size_t ahead = 8;
  if (room.corners.size() < seen.drawn.size()) room.corners.resize(seen.drawn.size());
  const auto drawn = [&](std::size_t v) -> const Raster::Drawn& {
    return seen.drawn[std::size_t(visible[v])];
  };
  const auto surface = [&](std::size_t v) -> const Prepared& {
    return prepared[std::size_t(drawn(v).surface)];
  };
  for (std::size_t v = 0; v < visible.size(); ++v) {
    if (v + ahead < visible.size()) Corners::fetch(surface(v + ahead), drawn(v + ahead));
    room.corners[std::size_t(visible[v])] = Corners(surface(v), raster, drawn(v));
  }
}

struct Lamps {
  Vec3f key = Vec3f(-0.42f, 0.52f, 0.74f).normalized();
  Vec3f fill = Vec3f(0.75f, 0.05f, 0.66f).normalized();
  Vec3f half_way = (key + Vec3f::UnitZ()).normalized();
};

// Key lamp up left of the camera, fill lamp at its right, ambient light, and a specular term that
// keeps the relief visible where the colour is dark.
Vec3f shaded(const Lamps& lamps, const Vec3f& colour, Vec3f normal, bool back) {
  if (back) normal = -normal;
  const float lit = std::max(0.f, normal.dot(lamps.key));
  const float light = 0.26f + 0.10f * (0.5f + 0.5f * normal.y()) + 0.66f * lit +
                      0.16f * std::max(0.f, normal.dot(lamps.fill));
  const float along = std::max(0.f, normal.dot(lamps.half_way));
  const float square = along * along, fourth = square * square;
  const float sheen = 0.03f * lit + 0.07f * fourth * fourth * fourth * square;  // power of 14
  return (colour * light).array() * (back ? 0.4f : 1.f) + (back ? 0.f : sheen);
}

/// The depth at each sample of a picture, to decide which lines and markers are hidden.
class DepthPicture {
 public:
  DepthPicture(int width, int height, double m_per_sample)
      : width_(width),
        height_(height),
        m_per_sample_(m_per_sample),
        nearest_(std::size_t(width) * std::size_t(height)) {}
  /// Copies the rows of a band.
  void take(const Raster::Seen& seen) {
    for (int y = 0; y < seen.rows; ++y)
      std::copy_n(seen.nearest.data() + std::ptrdiff_t(y) * seen.stride, width_,
                  nearest_.data() + std::ptrdiff_t(seen.first_row + y) * width_);
  }
  /// Whether a surface lies more than `bias_m` in front of the point (camera frame), at the sample
  /// nearest to the point.
  bool hides(const Vec3& point, double bias_m) const {
    const double x = std::nearbyint(point[0] / m_per_sample_ + width_ / 2.0 - 0.5);
    const double y = std::nearbyint(height_ / 2.0 - 0.5 - point[1] / m_per_sample_);
    if (!(x >= 0 && x < width_ && y >= 0 && y < height_)) return false;
    return nearest_[std::size_t(y) * std::size_t(width_) + std::size_t(x)] > point[2] + bias_m;
  }

 private:
  int width_, height_;
  double m_per_sample_;
  std::vector<float> nearest_;
};

/// Fills `depth` too, if it is not null.
void paint(const std::vector<Prepared>& prepared, const std::vector<Surface>& surfaces,
           const Camera& camera, const RenderOptions& options, Image& image, DepthPicture* depth) {
  constexpr int band_px = 8;
  const Vec3f background = linear(options.background);
  const int n = options.samples;
  const int along = n * options.width_px;  // samples in a row
  const Raster raster(surfaces, camera, along, n * options.height_px,
                      camera.height_m / options.height_px / n, n * band_px);
  const Lamps lamps;
  tbb::enumerable_thread_specific<Room> rooms;
  tbb::parallel_for(0, raster.bands(), [&](int band) {
    Room& room = rooms.local();
    Raster::Seen& seen = room.seen;
    raster.look(band, seen);
    if (depth) depth->take(seen);
    take_corners(raster, prepared, room);
    for (int y = 0; y < seen.rows / n; ++y) {
      room.row.assign(static_cast<std::size_t>(options.width_px), {});
      for (int s = n * y; s < n * (y + 1); ++s) {
        const int* ids = seen.triangle.data() + std::ptrdiff_t(s) * seen.stride;
        bool back = false;
        Raster::Weights weights{};
        for (int x = 0, first = 0, last = -1; x < along; ++x) {
          if (ids[x] < 0) continue;
          if (ids[x] != last) {
            first = x, last = ids[x];
            const Raster::Drawn& drawn = seen.drawn[std::size_t(last)];
            back = !drawn.faces_viewer();
            weights = drawn.weights(x, seen.first_row + s);
          }
          if (options.hide_backs && back) continue;
          const auto w = weights.at(x - first);
          const Vec3f weight(w[0], w[1], w[2]);
          Sum& sum = room.row[static_cast<std::size_t>(x / n)];
          const Corners& at = room.corners[std::size_t(last)];
          sum.light += shaded(lamps, at.colour_at(weight), at.normal_at(weight), back);
          ++sum.hits;
        }
      }
      for (int x = 0; x < options.width_px; ++x) {
        const Sum& sum = room.row[static_cast<std::size_t>(x)];
        if (sum.hits == 0) continue;
        const Vec3f light = (sum.light + static_cast<float>(n * n - sum.hits) * background) /
                            static_cast<float>(n * n);
        for (int k = 0; k < 3; ++k) image.pixel(x, seen.first_row / n + y)[k] = srgb_byte(light[k]);
      }
    }
  });
}

// Draws the visible stretches of a line, tested in pieces of about two pixels.
void draw_line(const Polyline& line, const DepthPicture& depth, const Camera& camera,
               const RenderOptions& options, Canvas& canvas) {
  const Eigen::Matrix3d camera_from_world = camera.axes();
  const double px_per_m = options.height_px / camera.height_m;
  const Eigen::Index segments = line.points.rows() - (line.closed ? 0 : 1);
  for (Eigen::Index s = 0; s < segments; ++s) {
    const Vec3 a = line.points.row(s), b = line.points.row((s + 1) % line.points.rows());
    const int pieces = std::clamp(static_cast<int>((b - a).norm() * px_per_m / 2), 1, 10000);
    for (int i = 0; i < pieces; ++i) {
      const Vec3 from = a + (b - a) * i / pieces, to = a + (b - a) * (i + 1) / pieces;
      const Vec3 middle = camera_from_world * ((from + to) / 2 - camera.target);
      if (depth.hides(middle, options.overlay_bias_m)) continue;
      const Projected p = project(camera, options.width_px, options.height_px, from);
      const Projected q = project(camera, options.width_px, options.height_px, to);
      canvas.line(p.x, p.y, q.x, q.y, line.colour, line.width_px);
    }
  }
}

// Draws the visible parts of a fan, tested in pieces of about four pixels along it.
void draw_fan(const Fan& fan, const DepthPicture& depth, const Camera& camera,
              const RenderOptions& options, Canvas& canvas) {
  const Eigen::Matrix3d camera_from_world = camera.axes();
  const double px_per_m = options.height_px / camera.height_m;
  std::vector<std::array<Eigen::Vector2d, 4>> visible;
  for (Eigen::Index i = 1; i + 1 < fan.points.rows(); ++i) {
    const Vec3 tip = fan.points.row(0), a = fan.points.row(i), b = fan.points.row(i + 1);
    const double length_m = std::max((a - tip).norm(), (b - tip).norm());
    const int pieces = std::clamp(static_cast<int>(length_m * px_per_m / 4), 1, 1000);
    for (int k = 0; k < pieces; ++k) {
      const double from = double(k) / pieces, to = double(k + 1) / pieces;
      const std::array<Vec3, 4> corners{tip + from * (a - tip), tip + to * (a - tip),
                                        tip + to * (b - tip), tip + from * (b - tip)};
      const Vec3 middle = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
      if (depth.hides(camera_from_world * (middle - camera.target), options.overlay_bias_m))
        continue;
      auto& cell = visible.emplace_back();
      for (std::size_t c = 0; c < corners.size(); ++c) {
        const Projected p = project(camera, options.width_px, options.height_px, corners[c]);
        cell[c] = {p.x, p.y};
      }
    }
  }
  canvas.fill(visible, fan.colour, fan.opacity);
}

void draw_marker(const Marker& marker, const DepthPicture& depth, const Camera& camera,
                 const RenderOptions& options, Canvas& canvas) {
  const Vec3 local = camera.axes() * (marker.at - camera.target);
  if (!local.allFinite()) return;
  const bool hollow = depth.hides(local, options.overlay_bias_m);
  if (hollow && depth.hides(local, options.hollow_within_m)) return;
  const Projected p = project(camera, options.width_px, options.height_px, marker.at);
  canvas.disc(p.x, p.y, marker.radius_px + 1, {1, 1, 1});
  canvas.disc(p.x, p.y, marker.radius_px, marker.colour);
  if (hollow) canvas.disc(p.x, p.y, marker.radius_px / 2, {1, 1, 1});
}

}  // namespace

Image render(const std::vector<Surface>& surfaces, const Camera& camera,
             const RenderOptions& options, const std::vector<Marker>& markers,
             const std::vector<Polyline>& lines, const std::vector<Fan>& fans) {
  if (options.width_px < 1 || options.height_px < 1 || options.samples < 1)
    throw std::invalid_argument("render: a picture needs at least one pixel and one sample");
  if (std::max(options.width_px, options.height_px) > Raster::most_samples / options.samples)
    throw std::invalid_argument("render: a picture of too many pixels");
  std::vector<Prepared> prepared;
  for (const Surface& surface : surfaces) prepared.emplace_back(surface, camera.axes());
  Image image(options.width_px, options.height_px, options.background);
  std::optional<DepthPicture> depth;
  if (!markers.empty() || !lines.empty() || !fans.empty())
    depth.emplace(options.samples * options.width_px, options.samples * options.height_px,
                  camera.height_m / options.height_px / options.samples);
  paint(prepared, surfaces, camera, options, image, depth ? &*depth : nullptr);
  if (!depth) return image;
  Canvas canvas(image);
  for (const Fan& fan : fans) draw_fan(fan, *depth, camera, options, canvas);
  for (const Polyline& line : lines) draw_line(line, *depth, camera, options, canvas);
  for (const Marker& marker : markers) draw_marker(marker, *depth, camera, options, canvas);
  return canvas.image();
}

std::vector<std::optional<Picked>> pick(const std::vector<Surface>& surfaces, const Camera& camera,
                                        int width_px, int height_px,
                                        const Eigen::MatrixX2d& places) {
  const RayScene scene(surfaces, camera);
  const double m_per_px = camera.height_m / height_px;
  std::vector<std::optional<Picked>> picked(static_cast<size_t>(places.rows()));
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    const auto hit = scene.look_at(static_cast<float>((places(i, 0) - width_px / 2.0) * m_per_px),
                                   static_cast<float>((height_px / 2.0 - places(i, 1)) * m_per_px));
    if (!hit) continue;
    Picked p{.surface = hit->surface, .triangle = hit->triangle, .facing = hit->normal.z()};
    const TriMesh& mesh = surfaces[static_cast<size_t>(hit->surface)].mesh;
    for (int k = 0; k < 3; ++k) {
      p.weights[k] = hit->weight[k];
      p.point += hit->weight[k] * mesh.points.row(mesh.triangles(hit->triangle, k)).transpose();
    }
    picked[static_cast<size_t>(i)] = p;
  }
  return picked;
}

}  // namespace hyperex::render
