// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/point_pairs.hpp"

#include "hyperex/face/canonical_face.hpp"
#include "hyperex/face/ibug.hpp"

namespace hyperex::metrics {
namespace {

bool is_left(const std::string& full) {
  const auto& canonical = face::canonical_face();
  if (canonical.landmarks.contains(full))
    return canonical.landmark(full, canonical.mesh.points).x() > 0;
  return full.ends_with("_L");
}

std::string pair_name(const std::string& left, const std::string& right) {
  if (left.ends_with("_L")) return left.substr(0, left.size() - 2);
  return right + "/" + left.substr(left.rfind('_') + 1);
}

}  // namespace

int column_of(const motion::Motion& motion, const std::string& full) {
  for (size_t i = 0; i < motion.names.size(); ++i)
    if (motion.names[i] == full || face::full_name(motion.names[i]) == full)
      return static_cast<int>(i);
  return -1;
}

std::vector<PointPair> point_pairs(const motion::Motion& motion) {
  std::vector<PointPair> pairs;
  if (motion.positions.empty()) return pairs;
  for (size_t i = 0; i < motion.names.size(); ++i) {
    const std::string left = face::full_name(motion.names[i]);
    const std::string right = face::mirrored_landmark(left);
    if (right == left || !is_left(left)) continue;
    const int l = static_cast<int>(i), r = column_of(motion, right);
    if (r < 0 || !motion.positions.front().row(l).allFinite() ||
        !motion.positions.front().row(r).allFinite())
      continue;
    pairs.push_back({pair_name(left, right), l, r});
  }
  return pairs;
}

}  // namespace hyperex::metrics
