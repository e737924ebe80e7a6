// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/teeth/lathe.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/geometry/smooth_step.hpp"

namespace hyperex::anatomy {

using Eigen::Index;

double smooth_step(double from, double to, double x) {
  return hyperex::smooth_step((x - from) / (to - from));
}

double powered(double x, double power) {
  return std::copysign(std::pow(std::abs(x), power), x);
}

TriMesh Lathe::mesh() const {
  const auto n = Index(rings.front().size()), count = Index(rings.size());
  TriMesh out{Points(n * count + 2, 3), Triangles(2 * n * count, 3)};
  for (Index r = 0; r < count; ++r)
    for (Index k = 0; k < n; ++k)
      out.points.row(r * n + k) = rings[std::size_t(r)][std::size_t(k)].transpose();
  out.points.row(n * count) = first.transpose();
  out.points.row(n * count + 1) = last.transpose();
  Index row = 0;
  for (Index k = 0; k < n; ++k) {
    const int a = int(k), b = int((k + 1) % n), end = int(n * (count - 1));
    out.triangles.row(row++) << int(n * count), b, a;
    out.triangles.row(row++) << int(n * count) + 1, end + a, end + b;
    for (Index r = 0; r + 1 < count; ++r) {
      const int lower = int(r * n), upper = int((r + 1) * n);
      out.triangles.row(row++) << lower + a, lower + b, upper + b;
      out.triangles.row(row++) << lower + a, upper + b, upper + a;
    }
  }
  return out;
}

void turn_outwards(TriMesh& mesh) {
  double volume = 0;
  for (Index f = 0; f < mesh.triangles.rows(); ++f) {
    const Vec3 a = mesh.points.row(mesh.triangles(f, 0)), b = mesh.points.row(mesh.triangles(f, 1)),
               c = mesh.points.row(mesh.triangles(f, 2));
    volume += a.dot(b.cross(c));
  }
  if (volume < 0) mesh.triangles.col(1).swap(mesh.triangles.col(2));
}

}  // namespace hyperex::anatomy
