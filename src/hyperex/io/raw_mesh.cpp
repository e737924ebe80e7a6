// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/io/raw_mesh.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>

#include "hyperex/core/error.hpp"

namespace hyperex::io {
namespace {

void check_vertices(const std::filesystem::path& file, const Points& points) {
  if (points.rows() == 0) throw InputError(file, "has no vertices; expected a triangle mesh");
  if (points.rows() > std::numeric_limits<int>::max())
    throw InputError(file, fmt::format("has {} vertices; expected fewer than 2^31", points.rows()));
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    if (!points.row(i).allFinite())
      throw InputError(file, fmt::format("vertex {} (counted from 0) is ({}, {}, {}); expected "
                                         "three finite numbers",
                                         i, points(i, 0), points(i, 1), points(i, 2)));
}

void check_faces(const std::filesystem::path& file, const RawMesh& raw) {
  if (raw.face_end.empty())
    throw InputError(file, fmt::format("has {} vertices but no faces (a point cloud?); expected a "
                                       "triangle mesh",
                                       raw.points.rows()));
  std::int64_t begin = 0;
  for (std::size_t f = 0; f < raw.face_end.size(); ++f) {
    const std::int64_t end = raw.face_end[f];
    if (end - begin < 3)
      throw InputError(file, fmt::format("face {} (counted from 0) has {} corners; expected at "
                                         "least 3",
                                         f, end - begin));
    for (std::int64_t c = begin; c < end; ++c)
      if (raw.corner[c] < 0 || raw.corner[c] >= raw.points.rows())
        throw InputError(file, fmt::format("face {} (counted from 0) names vertex {}; expected 0 "
                                           "to {}",
                                           f, raw.corner[c], raw.points.rows() - 1));
    begin = end;
  }
}

}  // namespace

Scan triangulated(const std::filesystem::path& file, RawMesh raw) {
  check_vertices(file, raw.points);
  check_faces(file, raw);

  std::vector<std::array<std::int64_t, 3>> cut;  // indices into raw.corner
  cut.reserve(raw.corner.size() - 2 * raw.face_end.size());
  std::int64_t begin = 0;
  for (const std::int64_t end : raw.face_end) {
    const auto point = [&](std::int64_t k) { return raw.points.row(raw.corner[begin + k]); };
    const bool second_diagonal = end - begin == 4 && (point(1) - point(3)).squaredNorm() <
                                                         (point(0) - point(2)).squaredNorm();
    if (second_diagonal) {
      cut.push_back({begin, begin + 1, begin + 3});
      cut.push_back({begin + 1, begin + 2, begin + 3});
    } else {
      for (std::int64_t c = begin + 1; c + 1 < end; ++c) cut.push_back({begin, c, c + 1});
    }
    begin = end;
  }

  Scan scan;
  scan.file = file;
  scan.mesh.triangles.resize(static_cast<Eigen::Index>(cut.size()), 3);
  const bool has_uv = !raw.corner_uv.empty();
  if (has_uv) scan.corner_uv.resize(3 * static_cast<Eigen::Index>(cut.size()), 2);
  for (std::size_t t = 0; t < cut.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const std::int64_t c = cut[t][k];
      scan.mesh.triangles(t, k) = static_cast<int>(raw.corner[c]);
      if (has_uv) scan.corner_uv.row(3 * t + k) << raw.corner_uv[2 * c], raw.corner_uv[2 * c + 1];
    }
  }
  scan.mesh.points = std::move(raw.points);
  scan.vertex_colour = std::move(raw.vertex_colour);
  scan.texture = std::move(raw.texture);
  return scan;
}

}  // namespace hyperex::io
