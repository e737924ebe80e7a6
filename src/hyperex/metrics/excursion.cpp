// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/excursion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hyperex/face/canonical_face.hpp"

namespace hyperex::metrics {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Eigen::RowVector3d place(const motion::Motion& motion, size_t sample,
                         const std::vector<int>& columns) {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  for (const int column : columns) sum += motion.positions[sample].row(column);
  return sum / static_cast<double>(columns.size());
}

double greatest(const std::vector<double>& values) {
  double most = nan;
  for (const double value : values)
    if (!(value <= most)) most = std::isnan(value) ? most : value;
  return most;
}

SideExcursion side_of(const motion::Motion& motion, int column) {
  SideExcursion side;
  side.excursion_mm = greatest(distance_from_rest_mm(motion, {column}));
  side.peak_speed_mm_s = greatest(speed_mm_s(motion, {column}));
  Eigen::RowVector3d last = motion.positions.front().row(column);
  for (const Points& sample : motion.positions)
    if (sample.row(column).allFinite()) {
      side.path_mm += 1e3 * (sample.row(column) - last).norm();
      last = sample.row(column);
    }
  return side;
}

double ratio(double right, double left) {
  constexpr double least = 1e-3;
  return left >= least ? right / left : nan;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double n = 0, sum_a = 0, sum_b = 0;
  for (size_t i = 0; i < a.size(); ++i)
    if (!std::isnan(a[i]) && !std::isnan(b[i])) {
      ++n;
      sum_a += a[i];
      sum_b += b[i];
    }
  double aa = 0, bb = 0, ab = 0;
  for (size_t i = 0; i < a.size(); ++i)
    if (!std::isnan(a[i]) && !std::isnan(b[i])) {
      const double da = a[i] - sum_a / n, db = b[i] - sum_b / n;
      aa += da * da;
      bb += db * db;
      ab += da * db;
    }
  // Below a micrometre a second a speed does not vary.
  constexpr double still = 1e-6;
  return n > 2 && aa > still * n && bb > still * n ? ab / std::sqrt(aa * bb) : nan;
}

/// "48" and "p48" are ibug68_48 without its name.
std::string full_name(const std::string& name) {
  const std::string digits = name.starts_with("p") ? name.substr(1) : name;
  const bool number =
      !digits.empty() && digits.size() <= 2 &&
      std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
  return number ? "ibug68_" + digits : name;
}

int column_of(const motion::Motion& motion, const std::string& full) {
  for (size_t i = 0; i < motion.names.size(); ++i)
    if (motion.names[i] == full || full_name(motion.names[i]) == full) return static_cast<int>(i);
  return -1;
}

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

PairExcursion pair_of(const motion::Motion& motion, int left, int right, double jitter_m) {
  PairExcursion pair;
  pair.left = left;
  pair.right = right;
  pair.left_side = side_of(motion, left);
  pair.right_side = side_of(motion, right);
  const SideExcursion &l = pair.left_side, &r = pair.right_side;
  pair.excursion_ratio = ratio(r.excursion_mm, l.excursion_mm);
  pair.path_ratio = ratio(r.path_mm, l.path_mm);
  pair.speed_ratio = ratio(r.peak_speed_mm_s, l.peak_speed_mm_s);
  pair.speed_correlation = correlation(speed_mm_s(motion, {left}), speed_mm_s(motion, {right}));
  pair.jitter_floor_mm = 1.96 * 2 * 1e3 * jitter_m;
  pair.undecided = jitter_m > 0 && !(std::abs(pair.difference_mm()) >= pair.floor_mm());
  return pair;
}

double change_of_distance_mm(const motion::Motion& motion, int a, int b) {
  double most = nan;
  const auto length = [&](const Points& sample) {
    return 1e3 * (sample.row(a) - sample.row(b)).norm();
  };
  const double rest = length(motion.positions.front());
  for (const Points& sample : motion.positions) {
    const double change = length(sample) - rest;
    if (!std::isnan(change) && !(std::abs(change) <= std::abs(most))) most = change;
  }
  return most;
}

Commissure commissure_of(const motion::Motion& motion) {
  const auto either = [&](const char* name, const char* stand_in) {
    const int own = column_of(motion, name);
    return own >= 0 ? own : column_of(motion, stand_in);
  };
  Commissure mouth;
  mouth.left = either("cheilion_L", "ibug68_54");
  mouth.right = either("cheilion_R", "ibug68_48");
  mouth.left_from_midlip_mm = mouth.right_from_midlip_mm = nan;
  if (mouth.left < 0 || mouth.right < 0) return mouth;
  mouth.left_mm = distance_from_rest_mm(motion, {mouth.left});
  mouth.right_mm = distance_from_rest_mm(motion, {mouth.right});
  mouth.left_mm_s = speed_mm_s(motion, {mouth.left});
  mouth.right_mm_s = speed_mm_s(motion, {mouth.right});
  const int lip = either("labiale_inferius", "ibug68_57");
  if (lip < 0) return mouth;
  mouth.left_from_midlip_mm = change_of_distance_mm(motion, mouth.left, lip);
  mouth.right_from_midlip_mm = change_of_distance_mm(motion, mouth.right, lip);
  return mouth;
}

}  // namespace

std::vector<double> distance_from_rest_mm(const motion::Motion& motion,
                                          const std::vector<int>& columns) {
  std::vector<double> out;
  for (size_t k = 0; k < motion.positions.size(); ++k)
    out.push_back(1e3 * (place(motion, k, columns) - place(motion, 0, columns)).norm());
  return out;
}

std::vector<double> speed_mm_s(const motion::Motion& motion, const std::vector<int>& columns) {
  const size_t count = motion.positions.size();
  std::vector<double> out(count, nan);
  for (size_t k = 0; k < count && count > 1; ++k) {
    const size_t before = k == 0 ? 0 : k - 1, after = std::min(k + 1, count - 1);
    out[k] = 1e3 * (place(motion, after, columns) - place(motion, before, columns)).norm() /
             (motion.time_s[after] - motion.time_s[before]);
    if (!place(motion, k, columns).allFinite()) out[k] = nan;
  }
  return out;
}

Excursions excursions_of(const motion::Motion& motion, double jitter_m) {
  Excursions all;
  all.jitter_m = jitter_m;
  if (motion.positions.empty()) return all;
  for (size_t i = 0; i < motion.names.size(); ++i) {
    const std::string left = full_name(motion.names[i]);
    const std::string right = face::mirrored_landmark(left);
    if (right == left || !is_left(left)) continue;
    const int l = static_cast<int>(i), r = column_of(motion, right);
    if (r < 0 || !motion.positions.front().row(l).allFinite() ||
        !motion.positions.front().row(r).allFinite())
      continue;
    all.pairs.push_back(pair_of(motion, l, r, jitter_m));
    all.pairs.back().name = pair_name(left, right);
  }
  all.commissure = commissure_of(motion);
  return all;
}

}  // namespace hyperex::metrics
