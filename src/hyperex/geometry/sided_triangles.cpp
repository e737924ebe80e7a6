// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/sided_triangles.hpp"

namespace hyperex {
namespace {

/// The triangles that have no vertex of side `barred`; empty where that is none.
std::vector<char> triangles_without(const TriMesh& mesh, const std::vector<int>& side, int barred) {
  std::vector<char> keep(std::size_t(mesh.triangles.rows()), 1);
  bool any = false;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    char& kept = keep[std::size_t(f)];
    for (int k = 0; k < 3; ++k) kept &= side[std::size_t(mesh.triangles(f, k))] != barred;
    any |= kept != 0;
  }
  return any ? keep : std::vector<char>();
}

}  // namespace

SidedTriangles::SidedTriangles(const TriMesh& mesh, const std::vector<int>& side)
    : all_(std::size_t(mesh.triangles.rows()), 1) {
  if (side.empty()) return;
  without_first_ = triangles_without(mesh, side, 1);
  without_second_ = triangles_without(mesh, side, -1);
}

const std::vector<char>& SidedTriangles::open_to(int side) const {
  if (side > 0 && !without_second_.empty()) return without_second_;
  if (side < 0 && !without_first_.empty()) return without_first_;
  return all_;
}

}  // namespace hyperex
