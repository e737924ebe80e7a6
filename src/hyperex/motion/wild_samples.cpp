// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/wild_samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hyperex/core/error.hpp"
#include "hyperex/core/quantile.hpp"
#include "hyperex/motion/brief_stays.hpp"
#include "hyperex/motion/end_stays.hpp"
#include "hyperex/motion/point_steps.hpp"

namespace hyperex::motion {
namespace {

constexpr std::ptrdiff_t kHalfWindow = 2;

/// The median of each coordinate; NaN where there are no rows.
Eigen::RowVector3d median_row(const std::vector<Eigen::RowVector3d>& rows) {
  Eigen::RowVector3d out;
  out.setConstant(std::numeric_limits<double>::quiet_NaN());
  if (rows.empty()) return out;
  std::vector<double> values(rows.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::ranges::transform(rows, values.begin(),
                           [axis](const Eigen::RowVector3d& row) { return row[axis]; });
    out[axis] = median(values);
  }
  return out;
}

/// A point minus the median of its readings around sample k; NaN where fewer than three of them are
/// measured.
Eigen::RowVector3d off_its_neighbours(const Motion& m, std::size_t k, Eigen::Index point) {
  const auto count = std::ptrdiff_t(m.positions.size());
  // At the ends the window is shifted, not shortened: the first sample has four others in its
  // window.
  const std::ptrdiff_t first =
      std::clamp(std::ptrdiff_t(k) - kHalfWindow, std::ptrdiff_t(0), count - 2 * kHalfWindow - 1);
  std::vector<Eigen::RowVector3d> near;
  for (std::ptrdiff_t i = first; i <= first + 2 * kHalfWindow; ++i)
    if (const auto row = m.positions[std::size_t(i)].row(point); row.allFinite())
      near.emplace_back(row);
  if (near.size() < 3) near.clear();
  return m.positions[k].row(point) - median_row(near);
}

/// Interpolates one wild reading from the readings of `sound` around it. In `sound` all wild
/// readings are NaN.
void interpolate(const Motion& sound, const WildSample& wild, Motion& to) {
  const Eigen::Index row = sound.index_of(wild.point);
  const auto measured = [&](std::size_t k) { return sound.positions[k].row(row).allFinite(); };
  std::size_t before = wild.sample, after = wild.sample;
  while (before > 0 && !measured(before)) --before;
  while (after + 1 < sound.positions.size() && !measured(after)) ++after;
  if (!measured(before)) before = after;
  if (!measured(after)) after = before;
  const double span = sound.time_s[after] - sound.time_s[before];
  const double share = span > 0 ? (sound.time_s[wild.sample] - sound.time_s[before]) / span : 0;
  to.positions[wild.sample].row(row) =
      (1 - share) * sound.positions[before].row(row) + share * sound.positions[after].row(row);
}

void mend(const std::vector<WildSample>& wild, Motion& motion) {
  if (wild.empty()) return;
  Motion sound = motion;
  for (const WildSample& one : wild)
    sound.positions[one.sample]
        .row(sound.index_of(one.point))
        .setConstant(std::numeric_limits<double>::quiet_NaN());
  for (const WildSample& one : wild) interpolate(sound, one, motion);
}

std::vector<WildSample> far_off_their_median(const Motion& motion, double least_m) {
  std::vector<WildSample> wild;
  const auto points = Eigen::Index(motion.names.size());
  Points off(points, 3);
  std::vector<Eigen::RowVector3d> measured;
  for (std::size_t k = 0; k < motion.positions.size(); ++k) {
    measured.clear();
    for (Eigen::Index p = 0; p < points; ++p) {
      off.row(p) = off_its_neighbours(motion, k, p);
      if (off.row(p).allFinite()) measured.emplace_back(off.row(p));
    }
    const Eigen::RowVector3d of_head = median_row(measured);
    for (Eigen::Index p = 0; p < points; ++p)
      if (const double off_m = (off.row(p) - of_head).norm(); off_m > least_m)
        wild.push_back({motion.names[std::size_t(p)], k, off_m});
  }
  return wild;
}

/// The positions, each sample less the median displacement of its points since the first sample.
std::vector<Points> without_shift(const Motion& m) {
  std::vector<Points> out = m.positions;
  for (Points& sample : out) {
    std::vector<Eigen::RowVector3d> moved;
    for (Eigen::Index p = 0; p < sample.rows(); ++p) {
      const Eigen::RowVector3d since = sample.row(p) - m.positions.front().row(p);
      if (since.allFinite()) moved.push_back(since);
    }
    sample.rowwise() -= median_row(moved);
  }
  return out;
}

/// Takes readings of exactly (0, 0, 0) as missing where all others of the point are far from there.
std::vector<WildSample> without_zeros(Motion& m) {
  std::vector<WildSample> zeros;
  for (Eigen::Index p = 0; p < Eigen::Index(m.names.size()); ++p) {
    double nearest_m = std::numeric_limits<double>::infinity();
    std::vector<std::size_t> at;
    for (std::size_t k = 0; k < m.positions.size(); ++k) {
      const auto row = m.positions[k].row(p);
      if ((row.array() == 0).all())
        at.push_back(k);
      else if (row.allFinite())
        nearest_m = std::min(nearest_m, row.norm());
    }
    if (nearest_m < kWildJump_m || !std::isfinite(nearest_m)) continue;
    for (const std::size_t k : at) {
      zeros.push_back({m.names[std::size_t(p)], k, nearest_m});
      m.positions[k].row(p).setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  }
  return zeros;
}

bool goes_and_returns(const std::vector<Points>& at, std::size_t k, Eigen::Index p,
                      double least_m) {
  const double jump_m = std::min(way_m(at, k - 1, k, p), way_m(at, k, k + 1, p));
  if (!(jump_m > least_m)) return false;
  double around_m = way_m(at, k - 1, k + 1, p);
  // fmax() passes over what is missing.
  if (k >= 2) around_m = std::fmax(around_m, way_m(at, k - 2, k - 1, p));
  if (k + 2 < at.size()) around_m = std::fmax(around_m, way_m(at, k + 1, k + 2, p));
  return jump_m > 3 * around_m;
}

/// Whether one of the four points beside this one does a third of the same.
bool is_joined(const std::vector<Points>& at, std::size_t k, Eigen::Index p) {
  return std::ranges::any_of(
      points_beside(at[k - 1], p),
      [&, bend = bend_m(at, k, p)](Eigen::Index other) { return bend_m(at, k, other) > bend / 3; });
}

/// `at`: the positions of the motion without the shift of the head.
std::vector<WildSample> lone_readings(const Motion& m, const std::vector<Points>& at,
                                      double least_m) {
  std::vector<WildSample> lone;
  for (std::size_t k = 1; k + 1 < at.size(); ++k)
    for (Eigen::Index p = 0; p < at[k].rows(); ++p)
      if (goes_and_returns(at, k, p, least_m) && !is_joined(at, k, p) &&
          bend_m(at, k, p) > 8 * usual_bend_without_m(at, k, p))
        lone.push_back({m.names[std::size_t(p)], k, bend_m(at, k, p)});
  return lone;
}

/// The least distance within `step_s` that no face moves.
double implausible_m(double step_s) {
  return std::max(kWildJump_m, kWildSpeed_m_s * step_s);
}

std::vector<WildSample> jumps_of(const Motion& m) {
  std::vector<WildSample> jumps;
  const std::vector<Points> at = without_shift(m);
  std::vector<std::size_t> before(m.names.size(), at.size());  // of each point's last reading
  for (std::size_t k = 0; k < at.size(); ++k)
    for (std::size_t p = 0; p < m.names.size(); ++p) {
      const auto row = Eigen::Index(p);
      if (!at[k].row(row).allFinite()) continue;
      const std::size_t last = std::exchange(before[p], k);
      if (last == at.size()) continue;
      const double far_m = (at[k].row(row) - at[last].row(row)).norm();
      if (far_m > implausible_m(m.time_s[k] - m.time_s[last]))
        jumps.push_back({m.names[p], k, far_m});
    }
  return jumps;
}

/// Mends lone readings and brief stays, for recordings of at least 24 samples a second. The ways
/// there and back of stays that are too long for it are returned.
std::vector<WildSample> mend_lone_and_stays(MendedMotion& out) {
  const Motion& m = out.motion;
  const std::vector<Points> at = without_shift(m);
  std::vector<WildSample> found = lone_readings(m, at, kLoneJump_m), kept;
  for (const auto& [p, stay] : brief_stays(at, m.time_s, m.names)) {
    const std::string& name = m.names[std::size_t(p)];
    if (!is_mended(stay, m.time_s))
      for (const std::size_t k : {stay.before + 1, stay.after})
        kept.push_back({name, k, way_m(at, k - 1, k, p)});
    else
      for (std::size_t k = stay.before + 1; k < stay.after; ++k)
        found.push_back({name, k, off_line(path_of(at, p), m.time_s, stay, k)});
  }
  mend(found, out.motion);
  out.wild.insert(out.wild.end(), found.begin(), found.end());
  std::ranges::stable_sort(out.wild, {}, &WildSample::sample);
  return kept;
}

/// Mends or names what is away at the ends of a recording. `kept`: the ways there and back of stays
/// that are kept; a way back is none away.
void settle_ends(double step_s, const std::vector<WildSample>& kept, MendedMotion& out) {
  const Motion& m = out.motion;
  const bool slow = step_s > kSlowStep_s;
  const EndRule rule = slow ? EndRule{kWildJump_m, std::numeric_limits<double>::infinity(), 0}
                            : EndRule{kLoneJump_m, kSlowStep_s, kLongestEnd_s};
  std::vector<WildSample> found;
  for (const EndStay& stay : end_stays(without_shift(m), m.time_s, m.names, rule)) {
    const std::string& name = m.names[std::size_t(stay.point)];
    if (std::ranges::any_of(kept, [&](const WildSample& way) {
          return way.sample == stay.jump && way.point == name;
        }))
      continue;
    const bool mended = !slow && stay.speed_m_s > kFastest_m_s &&
                        stay.lasts_s <= kLongestMendedEnd_s + kStaySlack_s;
    // Those that are faster than any face are among the jumps.
    if (!mended && (stay.step_m <= kNamedEnd_m || stay.step_m > implausible_m(step_s))) continue;
    for (const std::size_t k : stay.samples)
      (mended ? found : out.ends).push_back({name, k, stay.step_m});
  }
  mend(found, out.motion);
  out.wild.insert(out.wild.end(), found.begin(), found.end());
  for (auto* readings : {&out.wild, &out.ends})
    std::ranges::stable_sort(*readings, {}, &WildSample::sample);
}

/// Adds those that are not among the jumps already.
void add_jumps(const std::vector<WildSample>& more, std::vector<WildSample>& jumps) {
  for (const WildSample& one : more)
    if (std::ranges::none_of(jumps, [&](const WildSample& jump) {
          return jump.sample == one.sample && jump.point == one.point;
        }))
      jumps.push_back(one);
  std::ranges::stable_sort(jumps, {}, &WildSample::sample);
}

/// Whether a motion that no file states the unit of spans more than a face in metres can.
bool large_for_metres(const Motion& motion, const Points& at) {
  constexpr double largest_face_m = 2;
  if (!motion.unit_note.empty()) return false;
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const auto& point : at.rowwise()) {
    if (!point.allFinite()) continue;
    low = low.cwiseMin(point.transpose());
    high = high.cwiseMax(point.transpose());
  }
  return (high - low).maxCoeff() > largest_face_m;
}

/// `at`: the positions of the motion that are evaluated.
void check_reach(const Motion& motion, const std::vector<Points>& at, double farthest_m) {
  std::vector<std::size_t> first(motion.names.size(), at.size());  // sample of the first reading
  for (std::size_t k = 0; k < at.size(); ++k)
    for (std::size_t p = 0; p < motion.names.size(); ++p) {
      const auto row = Eigen::Index(p);
      if (!at[k].row(row).allFinite()) continue;
      if (first[p] == at.size()) first[p] = k;
      const double far_m = (at[k].row(row) - at[first[p]].row(row)).norm();
      if (far_m > farthest_m)
        throw InputError(fmt::format(
            "{}: {:.4g} mm from its first place: expected at most {:g} mm, as no point of a face "
            "moves farther; {}",
            place_of(motion, motion.names[p], k), 1e3 * far_m, 1e3 * farthest_m,
            large_for_metres(motion, at[k])
                ? "a motion in memory is in metres, and these positions seem to be in millimetres"
                : "correct the reading or leave its cells empty"));
    }
}

}  // namespace

std::string place_of(const Motion& motion, const std::string& point, std::size_t sample) {
  std::string at = named(motion);
  if (sample < motion.lines.size()) at += fmt::format(":{}", motion.lines[sample]);
  return fmt::format("{}, point {} at {:.3f} s", at, point, motion.time_s[sample]);
}

MendedMotion without_wild_samples(const Motion& motion) {
  MendedMotion out;
  out.motion = motion;
  if (motion.names.size() < 3) return out;
  out.zeros = without_zeros(out.motion);
  out.held = held_readings(out.motion);
  if (motion.positions.size() < 2 * kHalfWindow + 1) {
    out.jumps = jumps_of(out.motion);
    return out;
  }
  const double step_s = median_step(motion.time_s);
  out.wild = far_off_their_median(out.motion, implausible_m(step_s));
  mend(out.wild, out.motion);
  std::vector<WildSample> kept;
  if (step_s <= kSlowStep_s)
    kept = mend_lone_and_stays(out);
  else
    out.lone = lone_readings(out.motion, without_shift(out.motion), kWildJump_m);
  settle_ends(step_s, kept, out);
  out.jumps = jumps_of(out.motion);
  add_jumps(kept, out.jumps);
  return out;
}

void check_reach(const Motion& steady) {
  check_reach(steady, steady.positions, kFarthest_m);
}

void check_reach_beside_head(const Motion& motion) {
  check_reach(motion, without_shift(motion), kFarthestBesideHead_m);
}

}  // namespace hyperex::motion
