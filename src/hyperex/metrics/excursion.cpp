// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/excursion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "hyperex/core/within_95.hpp"
#include "hyperex/face/same_place.hpp"
#include "hyperex/metrics/nan.hpp"
#include "hyperex/metrics/point_pairs.hpp"
#include "hyperex/metrics/speed_floor.hpp"
#include "hyperex/motion/lowpass.hpp"

namespace hyperex::metrics {
namespace {

Eigen::RowVector3d place(const motion::Motion& motion, size_t sample,
                         const std::vector<int>& columns) {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  for (const int column : columns) sum += motion.positions[sample].row(column);
  return sum / static_cast<double>(columns.size());
}

/// 0 if no value is a number.
std::size_t index_of_greatest(const std::vector<double>& values) {
  std::size_t most = 0;
  for (std::size_t k = 1; k < values.size(); ++k)
    if (!(values[k] <= values[most]) && !std::isnan(values[k])) most = k;
  return most;
}

double greatest(const std::vector<double>& values) {
  return values.empty() ? kNan : values[index_of_greatest(values)];
}

motion::SmoothTrack smoothed_mm(const motion::Motion& motion, int column, double lowpass_hz) {
  return motion::lowpassed(motion.time_s, 1e3 * track_of(motion, column), lowpass_hz);
}

/// The smoothed path of a point, mm, with its distance from the first sample and its speed.
struct Path {
  Points position_mm;
  std::vector<double> distance_mm, speed_mm_s;
};

Path path_of(const motion::Motion& motion, int column, double lowpass_hz) {
  const motion::SmoothTrack track = smoothed_mm(motion, column, lowpass_hz);
  Path path{track.value, {}, {}};
  for (Eigen::Index k = 0; k < track.value.rows(); ++k) {
    path.distance_mm.push_back((track.value.row(k) - track.value.row(0)).norm());
    path.speed_mm_s.push_back(track.rate.row(k).norm());
  }
  return path;
}

SideExcursion side_of(const motion::Motion& motion, const Path& path, double lowpass_hz) {
  SideExcursion side;
  side.excursion_mm = greatest(path.distance_mm);
  side.peak_speed_mm_s = motion::greatest_inside(motion.time_s, path.speed_mm_s, lowpass_hz);
  Eigen::RowVector3d last = path.position_mm.row(0);
  for (Eigen::Index k = 0; k < path.position_mm.rows(); ++k)
    if (path.position_mm.row(k).allFinite()) {
      side.path_mm += (path.position_mm.row(k) - last).norm();
      last = path.position_mm.row(k);
    }
  return side;
}

/// Root mean square speed over the quietest half second; NaN if none is measured.
double quietest_rms(const std::vector<double>& time_s, const std::vector<double>& speed) {
  constexpr double window_s = 0.5;
  double least = kNan;
  for (size_t from = 0; from < speed.size(); ++from) {
    double squares = 0;
    size_t to = from;
    for (; to < speed.size() && time_s[to] <= time_s[from] + window_s; ++to)
      squares += speed[to] * speed[to];
    if (to == speed.size() && time_s.back() < time_s[from] + 0.9 * window_s) break;
    const double rms = std::sqrt(squares / static_cast<double>(to - from));
    if (!std::isnan(rms) && !(rms >= least)) least = rms;
  }
  return least;
}

/// The share of a speed's variance over time that is not explained by jitter.
double signal_share(const std::vector<double>& speed, double jitter_variance) {
  double n = 0, sum = 0, squares = 0;
  for (const double v : speed)
    if (!std::isnan(v)) ++n, sum += v, squares += v * v;
  const double variance = squares / n - sum * sum / n / n;
  return std::max(0.0, 1 - jitter_variance / variance);
}

double ratio(double right, double left) {
  constexpr double least = 1e-3;
  return left >= least ? right / left : kNan;
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
  // Below 1 um/s, a speed counts as constant.
  constexpr double still = 1e-6;
  return n > 2 && aa > still * n && bb > still * n ? ab / std::sqrt(aa * bb) : kNan;
}

void judge_speeds(const motion::Motion& motion, const std::vector<double>& left,
                  const std::vector<double>& right, const SpeedFloor& floor, PairExcursion& pair) {
  pair.speed_correlation = correlation(left, right);
  if (!(floor.rms_mm_s > 0)) return;
  const double quiet =
      std::fmin(quietest_rms(motion.time_s, left), quietest_rms(motion.time_s, right));
  const double wider = std::fmax(1, quiet / floor.rms_mm_s);
  pair.jitter_widening = wider;
  const SideExcursion &l = pair.left_side, &r = pair.right_side;
  pair.peak_speed_floor_mm_s = wider * floor.peak_mm_s;
  pair.path_floor_mm = wider * floor.path_mm;
  pair.peak_speed_undecided =
      !(std::abs(l.peak_speed_mm_s - r.peak_speed_mm_s) >= pair.peak_speed_floor_mm_s);
  pair.path_undecided = !(std::abs(l.path_mm - r.path_mm) >= pair.path_floor_mm);
  // One of three components.
  const double jitter_variance = std::pow(wider * floor.rms_mm_s, 2) / 3;
  constexpr double least_share = 0.9;
  pair.speed_correlation_undecided =
      !(std::sqrt(signal_share(left, jitter_variance) * signal_share(right, jitter_variance)) >=
        least_share);
  if (l.path_mm < pair.path_floor_mm) pair.path_ratio = kNan;
  if (l.peak_speed_mm_s < pair.peak_speed_floor_mm_s) pair.speed_ratio = kNan;
}

/// The noise that the filter leaves of a measured sample of white noise.
double noise_left(const std::vector<double>& time_s, const Path& path, std::size_t sample,
                  double lowpass_hz) {
  std::vector<double> measured_s;
  std::size_t own = 0;
  for (std::size_t k = 0; k < time_s.size(); ++k) {
    if (k == sample) own = measured_s.size();
    if (path.position_mm.row(Eigen::Index(k)).allFinite()) measured_s.push_back(time_s[k]);
  }
  return motion::lowpassed_noise(measured_s, own, lowpass_hz);
}

/// The share of jitter (of its variance) that the filter leaves, as the mean over the first and the
/// farthest position of both sides. `widening` allows for jitter that is correlated over time,
/// which the filter removes less than white noise.
double jitter_share(const std::vector<double>& time_s, const std::array<const Path*, 2>& sides,
                    double widening, double lowpass_hz) {
  double squares = 0;
  for (const Path* side : sides)
    for (const std::size_t sample : {std::size_t(0), index_of_greatest(side->distance_mm)}) {
      const double left = noise_left(time_s, *side, sample, lowpass_hz);
      squares += std::pow(std::fmin(1, widening * left), 2);
    }
  return squares / 4;
}

PairExcursion pair_of(const motion::Motion& motion, int left, int right, double jitter_m,
                      const SpeedFloor& floor, double lowpass_hz) {
  PairExcursion pair;
  pair.left = left;
  pair.right = right;
  const Path left_path = path_of(motion, left, lowpass_hz),
             right_path = path_of(motion, right, lowpass_hz);
  pair.left_side = side_of(motion, left_path, lowpass_hz);
  pair.right_side = side_of(motion, right_path, lowpass_hz);
  const SideExcursion &l = pair.left_side, &r = pair.right_side;
  pair.excursion_ratio = ratio(r.excursion_mm, l.excursion_mm);
  pair.path_ratio = ratio(r.path_mm, l.path_mm);
  pair.speed_ratio = ratio(r.peak_speed_mm_s, l.peak_speed_mm_s);
  judge_speeds(motion, left_path.speed_mm_s, right_path.speed_mm_s, floor, pair);
  if (jitter_m > 0)
    pair.jitter_share =
        jitter_share(motion.time_s, {&left_path, &right_path}, pair.jitter_widening, lowpass_hz);
  pair.jitter_floor_mm = kWithin95 * 2 * 1e3 * jitter_m * std::sqrt(pair.jitter_share);
  pair.judge();
  return pair;
}

/// `a`, `b`: positions over time, mm.
double change_of_distance_mm(const Points& a, const Points& b) {
  double most = kNan;
  const double rest = (a.row(0) - b.row(0)).norm();
  for (Eigen::Index k = 0; k < a.rows(); ++k) {
    const double change = (a.row(k) - b.row(k)).norm() - rest;
    if (!std::isnan(change) && !(std::abs(change) <= std::abs(most))) most = change;
  }
  return most;
}

Commissure commissure_of(const motion::Motion& motion, double lowpass_hz) {
  const auto either = [&](const std::string& name) {
    const int own = column_of(motion, name);
    return own >= 0 ? own : column_of(motion, face::other_name(name));
  };
  Commissure mouth;
  mouth.left = either("cheilion_L");
  mouth.right = either("cheilion_R");
  mouth.left_from_midlip_mm = mouth.right_from_midlip_mm = kNan;
  if (mouth.left < 0 || mouth.right < 0) return mouth;
  Path left = path_of(motion, mouth.left, lowpass_hz),
       right = path_of(motion, mouth.right, lowpass_hz);
  if (const int lip = either("labiale_inferius"); lip >= 0) {
    const Points lip_mm = smoothed_mm(motion, lip, lowpass_hz).value;
    mouth.left_from_midlip_mm = change_of_distance_mm(left.position_mm, lip_mm);
    mouth.right_from_midlip_mm = change_of_distance_mm(right.position_mm, lip_mm);
  }
  mouth.left_mm = std::move(left.distance_mm);
  mouth.right_mm = std::move(right.distance_mm);
  mouth.left_mm_s = std::move(left.speed_mm_s);
  mouth.right_mm_s = std::move(right.speed_mm_s);
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

std::vector<double> smooth_distance_mm(const motion::Motion& motion, int column,
                                       double lowpass_hz) {
  return path_of(motion, column, lowpass_hz).distance_mm;
}

Excursions excursions_of(const motion::Motion& motion, double jitter_m, double lowpass_hz) {
  Excursions all;
  all.jitter_m = jitter_m;
  all.lowpass_hz = jitter_m > 0 ? lowpass_hz : 0;
  if (motion.positions.empty()) return all;
  const SpeedFloor floor = speed_floor(motion.time_s, jitter_m, all.lowpass_hz);
  for (const PointPair& points : point_pairs(motion)) {
    all.pairs.push_back(
        pair_of(motion, points.left, points.right, jitter_m, floor, all.lowpass_hz));
    all.pairs.back().name = points.name;
  }
  all.commissure = commissure_of(motion, all.lowpass_hz);
  return all;
}

void set_known(Excursions& excursions, const KnownNoise& known) {
  excursions.known = known;
  for (PairExcursion& pair : excursions.pairs) pair.known = known;
}

}  // namespace hyperex::metrics
