// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/symmetry.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "hyperex/core/error.hpp"
#include "hyperex/face/ibug.hpp"

namespace hyperex::metrics {
namespace {

struct Definition {
  const char* name;
  std::vector<int> ibug_right, ibug_left;
};

const std::array<Definition, 5>& definitions() {
  static const std::array<Definition, 5> all = {{{"cheilion", {48}, {54}},
                                                 {"exocanthion", {36}, {45}},
                                                 {"palpebrale_inferius", {40, 41}, {46, 47}},
                                                 {"alare", {31}, {35}},
                                                 {"crista_philtri_inferior", {50}, {52}}}};
  return all;
}

// Columns of the motion whose mean is the point.
using Columns = std::vector<int>;

struct Points10 {
  std::array<std::array<Columns, 5>, 2> of;  // side (left, right), definition
  std::vector<std::string> stand_ins;
};

int ibug_column(const motion::Motion& motion, int point) {
  const std::string number = std::to_string(point);
  for (const std::string& name : {face::ibug(point), number, "p" + number}) {
    const int column = motion.index_of(name);
    if (column >= 0) return column;
  }
  return -1;
}

Points10 find_points(const motion::Motion& motion) {
  Points10 found;
  std::string missing;
  for (int side = 0; side < 2; ++side)
    for (int d = 0; d < 5; ++d) {
      const Definition& definition = definitions()[d];
      const std::string name = fmt::format("{}_{}", definition.name, side == 0 ? 'L' : 'R');
      Columns& columns = found.of[side][d];
      if (const int own = motion.index_of(name); own >= 0) {
        columns = {own};
        continue;
      }
      std::string names;
      const std::vector<int>& points = side == 0 ? definition.ibug_left : definition.ibug_right;
      for (const int point : points)
        if (const int column = ibug_column(motion, point); column >= 0) {
          columns.push_back(column);
          names += (names.empty() ? "" : " and ") + motion.names[column];
        }
      if (columns.size() == points.size()) {
        found.stand_ins.push_back(
            fmt::format("{}: {}{}", name, points.size() > 1 ? "mean of " : "", names));
      } else {
        std::vector<std::string> others;
        for (const int point : points) others.push_back(face::ibug(point));
        missing += fmt::format("{}{} (or {})", missing.empty() ? "" : ", ", name,
                               fmt::join(others, " and "));
      }
    }
  if (!missing.empty())
    motion::refuse(motion, "symmetry needs points that are not there: " + missing);
  return found;
}

std::set<int> columns_of(const Points10& points) {
  std::set<int> columns;
  for (const auto& side : points.of)
    for (const Columns& some : side) columns.insert(some.begin(), some.end());
  return columns;
}

Vec3 position(const Points& sample, const Columns& columns) {
  Vec3 sum = Vec3::Zero();
  for (const int column : columns) sum += sample.row(column).transpose();
  return sum / static_cast<double>(columns.size());
}

// The vectors from cheilion to the other four points.
std::array<Vec3, 4> rays(const Points& sample, const std::array<Columns, 5>& side) {
  const Vec3 cheilion = position(sample, side[0]);
  std::array<Vec3, 4> all;
  for (int k = 0; k < 4; ++k) all[k] = position(sample, side[k + 1]) - cheilion;
  return all;
}

std::array<std::array<Vec3, 4>, 2> rest_rays(const motion::Motion& motion, const Points10& points) {
  if (motion.positions.empty()) motion::refuse(motion, "symmetry needs at least one sample");
  std::array<std::array<Vec3, 4>, 2> rest;
  for (int side = 0; side < 2; ++side) {
    rest[side] = rays(motion.positions.front(), points.of[side]);
    for (const Vec3& ray : rest[side])
      if (!(ray.norm() > 0))
        motion::refuse(motion,
                       "symmetry needs its points measured, and apart, at the first sample");
  }
  return rest;
}

}  // namespace

bool SymmetryCurve::known() const {
  return !s.empty() && !std::isnan(s.front());
}

std::vector<double> SymmetryCurve::floors() const {
  if (noise.empty()) return mesh_noise;
  std::vector<double> larger = noise;
  for (size_t i = 0; i < mesh_noise.size(); ++i) larger[i] = std::max(larger[i], mesh_noise[i]);
  return larger;
}

bool SymmetryCurve::undecided(size_t sample) const {
  const double apart = std::abs(xi_left[sample] - xi_right[sample]);
  const auto under = [&](const std::vector<double>& floors) {
    return !floors.empty() && !(apart >= floors[sample]);
  };
  return std::isnan(apart) || under(noise) || under(mesh_noise);
}

std::vector<Stretches> stretches_of(const motion::Motion& landmarks) {
  const Points10 points = find_points(landmarks);
  const auto rest = rest_rays(landmarks, points);
  std::vector<Stretches> all;
  for (const Points& sample : landmarks.positions) {
    all.emplace_back();
    for (size_t side = 0; side < 2; ++side) {
      const auto now = rays(sample, points.of[side]);
      for (size_t k = 0; k < 4; ++k)
        all.back()[4 * side + k] = now[k].norm() / rest[side][k].norm() - 1;
    }
  }
  return all;
}

SymmetryCurve symmetry_of(const motion::Motion& landmarks, double floor, double jitter_m) {
  if (!(floor > 0) || !std::isfinite(floor))
    throw InputError(
        InputProblem{"symmetry", 0, "floor", fmt::format("{}", floor), "a number above 0"});
  SymmetryCurve curve;
  curve.floor = floor;
  curve.stand_ins = find_points(landmarks).stand_ins;
  curve.time_s = landmarks.time_s;
  for (const Stretches& q : stretches_of(landmarks)) {
    curve.xi_left.push_back(q[0] + q[1] + q[2] + q[3]);
    curve.xi_right.push_back(q[4] + q[5] + q[6] + q[7]);
    const double apart = std::abs(curve.xi_left.back() - curve.xi_right.back());
    curve.s.push_back(std::isnan(apart) ? apart : std::log(std::max(apart, floor)));
  }
  curve.s.front() = std::log(floor);
  curve.jitter_m = jitter_m;
  if (jitter_m != 0) curve.noise = symmetry_noise(landmarks, jitter_m);
  return curve;
}

SymmetryCurve symmetry_without_points(const motion::Motion& landmarks, double floor) {
  SymmetryCurve curve;
  curve.floor = floor;
  curve.time_s = landmarks.time_s;
  curve.xi_left.assign(curve.time_s.size(), std::numeric_limits<double>::quiet_NaN());
  curve.xi_right = curve.s = curve.xi_left;
  return curve;
}

std::vector<double> symmetry_noise(const motion::Motion& landmarks, double jitter_m) {
  constexpr double two_sided_95 = 1.959964;
  if (!(jitter_m > 0) || !std::isfinite(jitter_m))
    throw InputError(
        InputProblem{"symmetry", 0, "jitter", fmt::format("{}", jitter_m), "a number above 0 (m)"});
  const Points10 points = find_points(landmarks);
  const auto rest = rest_rays(landmarks, points);
  std::vector<double> noise;
  for (const Points& sample : landmarks.positions) {
    double variance = 0;
    for (int side = 0; side < 2; ++side) {
      const auto now = rays(sample, points.of[side]);
      Vec3 of_cheilion = Vec3::Zero(), of_cheilion_at_rest = Vec3::Zero();
      for (int k = 0; k < 4; ++k) {
        const double r = now[k].norm(), r0 = rest[side][k].norm();
        const double averaged = static_cast<double>(points.of[side][k + 1].size());
        of_cheilion += now[k] / (r * r0);
        of_cheilion_at_rest += r * rest[side][k] / (r0 * r0 * r0);
        variance += (1 / (r0 * r0) + r * r / std::pow(r0, 4)) / averaged;
      }
      variance += of_cheilion.squaredNorm() + of_cheilion_at_rest.squaredNorm();
    }
    noise.push_back(two_sided_95 * jitter_m * std::sqrt(variance));
  }
  return noise;
}

std::vector<int> symmetry_columns(const motion::Motion& landmarks) {
  try {
    const std::set<int> columns = columns_of(find_points(landmarks));
    return {columns.begin(), columns.end()};
  } catch (const InputError&) {  // a point is missing
    return {};
  }
}

double jitter_at_rest(const motion::Motion& landmarks, double window_s) {
  const std::set<int> columns = columns_of(find_points(landmarks));
  const auto& time = landmarks.time_s;
  double least = std::numeric_limits<double>::quiet_NaN();
  for (size_t first = 0; first < time.size(); ++first) {
    size_t end = first;
    while (end < time.size() && (end - first < 5 || time[end] - time[first] <= window_s)) ++end;
    if (end - first < 5 || (first > 0 && time.back() - time[first] < window_s)) break;
    const auto count = static_cast<double>(end - first);
    double squares = 0;
    for (const int column : columns) {
      Eigen::RowVector3d sum = Eigen::RowVector3d::Zero(), of_squares = sum;
      // Relative to the first sample, to reduce rounding errors.
      const Eigen::RowVector3d about = landmarks.positions[first].row(column);
      for (size_t k = first; k < end; ++k) {
        const Eigen::RowVector3d d = landmarks.positions[k].row(column) - about;
        sum += d;
        of_squares += d.cwiseAbs2();
      }
      squares += (of_squares - sum.cwiseAbs2() / count).sum() / (count - 1);
    }
    const double jitter = std::sqrt(squares / (3 * static_cast<double>(columns.size())));
    if (!(jitter >= least)) least = std::isnan(jitter) ? least : jitter;
  }
  return least;
}

}  // namespace hyperex::metrics
