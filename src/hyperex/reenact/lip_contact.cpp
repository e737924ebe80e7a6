// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/reenact/lip_contact.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/tissue/face_frame.hpp"

namespace hyperex::reenact {
namespace {
constexpr double lip_reach_m = 0.010;  // of the inner lip points
constexpr double deepest_m = 0.006;    // farther behind is another part of the face, not a lip
}  // namespace

LipContact::LipContact(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks) {
  const Points& skin = mesh.skin.points;
  std::vector<char> near(skin.rows(), 0);
  for (Eigen::Index v = 0; v < skin.rows(); ++v)
    for (int k = 61; k <= 67 && !near[v]; ++k)
      near[v] =
          k != 64 && (skin.row(v).transpose() - landmarks.at(tissue::ibug(k))).norm() < lip_reach_m;
  for (Eigen::Index v = 0; v < skin.rows(); ++v)
    if (near[v] && mesh.skin_upper_margin[v] < 0) lower_.push_back(static_cast<int>(v));
  std::vector<Eigen::Index> kept;
  for (Eigen::Index f = 0; f < mesh.skin.triangles.rows(); ++f) {
    bool keep = true;
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.skin.triangles(f, k);
      keep &= near[v] && mesh.skin_upper_margin[v] > 0;
    }
    if (keep) kept.push_back(f);
  }
  upper_.resize(kept.size(), 3);
  for (std::size_t i = 0; i < kept.size(); ++i) upper_.row(i) = mesh.skin.triangles.row(kept[i]);
  at_rest_ = raw_depth(skin);
}

double LipContact::depth(const Points& skin) const {
  return std::max(0.0, raw_depth(skin) - at_rest_);
}

double LipContact::raw_depth(const Points& skin) const {
  if (lower_.empty() || upper_.rows() == 0) return 0;
  const TriMesh upper{skin, upper_};
  const SurfaceTree tree(upper);
  double deepest = 0;
  for (int v : lower_) {
    const Vec3 p = skin.row(v);
    const ClosestPoint c = tree.query(p);
    // A foot on the rim of the lip says nothing about inside and outside.
    if (c.weights.minCoeff() < 1e-6) continue;
    const Vec3 a = skin.row(upper_(c.triangle, 0)), b = skin.row(upper_(c.triangle, 1)),
               d = skin.row(upper_(c.triangle, 2));
    const double height = (p - c.point).dot((b - a).cross(d - a).normalized());
    if (height < 0 && -height < deepest_m) deepest = std::max(deepest, -height);
  }
  return deepest;
}

}  // namespace hyperex::reenact
