// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/rest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hyperex/geometry/transform.hpp"

namespace hyperex::motion {
namespace {

constexpr double kAtRest_m = 1e-3;
constexpr double kStretch_s = 0.3, kStart_s = 0.1, kNearer = 0.65;
constexpr double kEnd_s = 0.1, kStill_s = 0.2, kOnItsWay = 0.3, kLeastEnd_m = 2e-3;
constexpr std::size_t kFewest = 5;
constexpr double kLeastSpread = 0.05;

/// Samples [first, last) in a stretch, at least one.
std::pair<std::size_t, std::size_t> samples_of(const Motion& motion, const RestStretch& stretch) {
  const auto& t = motion.time_s;
  const double slack = 1e-9, start = t.front();
  const auto from = std::lower_bound(t.begin(), t.end(), start + stretch.from_s - slack);
  const auto to = std::upper_bound(t.begin(), t.end(), start + stretch.to_s + slack);
  if (from < to) return {std::size_t(from - t.begin()), std::size_t(to - t.begin())};
  // No sample lies in the stretch: take the nearest.
  const double middle = start + 0.5 * (stretch.from_s + stretch.to_s);
  const auto nearest = std::min_element(t.begin(), t.end(), [&](double a, double b) {
    return std::abs(a - middle) < std::abs(b - middle);
  });
  const auto index = std::size_t(nearest - t.begin());
  return {index, index + 1};
}

/// Means of the measured rows; NaN where a point is not measured in any sample.
Points mean_of(const std::vector<Points>& positions, std::size_t first, std::size_t last) {
  Points sum = Points::Zero(positions[first].rows(), 3);
  Eigen::VectorXd count = Eigen::VectorXd::Zero(sum.rows());
  for (std::size_t k = first; k < last; ++k)
    for (Eigen::Index p = 0; p < sum.rows(); ++p)
      if (positions[k].row(p).allFinite()) {
        sum.row(p) += positions[k].row(p);
        count(p) += 1;
      }
  return count.cwiseInverse().asDiagonal() * sum;
}

double usual_step_s(const Motion& motion) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < motion.time_s.size(); ++k)
    steps.push_back(motion.time_s[k] - motion.time_s[k - 1]);
  std::nth_element(steps.begin(), steps.begin() + long(steps.size() / 2), steps.end());
  return steps[steps.size() / 2];
}

/// Puts a transition from `rest` to the first sample before the motion.
void lead_in(Motion& motion, const Points& rest) {
  const double step_s = std::min(usual_step_s(motion), rest_lead_s / 5);
  const int steps = int(std::ceil(rest_lead_s / step_s));
  const Points first = motion.positions.front();
  std::vector<double> times;
  std::vector<Points> course;
  for (int k = 0; k < steps; ++k) {
    const double u = double(k) / steps;
    times.push_back(motion.time_s.front() - rest_lead_s * (1 - u));
    course.push_back(rest + lead_course(u) * (first - rest));
  }
  motion.time_s.insert(motion.time_s.begin(), times.begin(), times.end());
  motion.positions.insert(motion.positions.begin(), course.begin(), course.end());
  if (!motion.head_pose.empty())
    motion.head_pose.insert(motion.head_pose.begin(), times.size(), motion.head_pose.front());
}

/// The common points of a motion and the face at rest.
struct Common {
  std::vector<Eigen::Index> rows;
  std::vector<std::string> names;
  Points rest;
  Points of(const Points& all) const {
    Points some(Eigen::Index(rows.size()), 3);
    for (std::size_t i = 0; i < rows.size(); ++i) some.row(Eigen::Index(i)) = all.row(rows[i]);
    return some;
  }
};

Common common_of(const Motion& motion, const io::Landmarks& at_rest) {
  Common common;
  for (std::size_t p = 0; p < motion.names.size(); ++p)
    if (at_rest.contains(motion.names[p]) &&
        std::all_of(motion.positions.begin(), motion.positions.end(), [&](const Points& sample) {
          return sample.row(Eigen::Index(p)).allFinite();
        })) {
      common.rows.push_back(Eigen::Index(p));
      common.names.push_back(motion.names[p]);
    }
  common.rest.resize(Eigen::Index(common.rows.size()), 3);
  for (std::size_t i = 0; i < common.names.size(); ++i)
    common.rest.row(Eigen::Index(i)) = at_rest.at(common.names[i]).transpose();
  return common;
}

/// The samples at and after `start_s`, counted from the first sample.
Motion from_time(const Motion& motion, double start_s) {
  const auto& t = motion.time_s;
  const auto first = std::lower_bound(t.begin(), t.end(), t.front() + start_s - 1e-9) - t.begin();
  if (std::size_t(first) + 2 > t.size())
    refuse(motion, fmt::format("the recording lasts {:.3f} s: it holds nothing from {:g} s on, "
                               "where the run is to begin (time.start_s)",
                               t.back() - t.front(), start_s));
  Motion rest_of = motion;
  rest_of.time_s.erase(rest_of.time_s.begin(), rest_of.time_s.begin() + first);
  rest_of.positions.erase(rest_of.positions.begin(), rest_of.positions.begin() + first);
  if (!rest_of.head_pose.empty())
    rest_of.head_pose.erase(rest_of.head_pose.begin(), rest_of.head_pose.begin() + first);
  return rest_of;
}

/// Mean distance of a point from its first place, over the samples of a stretch that measure it;
/// NaN where none does.
double mean_distance(const Motion& motion, Eigen::Index point, const RestStretch& stretch) {
  const auto [first, last] = samples_of(motion, stretch);
  double sum = 0;
  int count = 0;
  for (std::size_t k = first; k < last; ++k)
    if (const auto place = motion.positions[k].row(point); place.allFinite()) {
      sum += (place - motion.positions.front().row(point)).norm();
      ++count;
    }
  return sum / count;
}

Points laid_on(const Points& shape, const Points& onto) {
  return fit_similarity(shape, onto).apply(shape);
}

}  // namespace

double lead_course(double u) {
  return u * u * u * (10 + u * (-15 + 6 * u));
}

RestedMotion with_rest(const Motion& motion, const RestStretch& stretch, double start_s) {
  const double length_s = motion.time_s.back() - motion.time_s.front();
  if (stretch.from_s > length_s || stretch.to_s > length_s + 1e-9)
    refuse(motion, fmt::format("the recording lasts {:.3f} s: the rest stretch from {:g} s to {:g} "
                               "s lies outside it",
                               length_s, stretch.from_s, stretch.to_s));
  const auto [first, last] = samples_of(motion, stretch);
  const Points rest = mean_of(motion.positions, first, last);
  for (Eigen::Index p = 0; p < rest.rows(); ++p)
    if (!rest.row(p).allFinite())
      refuse(motion, fmt::format("point {} is not measured between {:g} s and {:g} s, where the "
                                 "face is said to be at rest",
                                 motion.names[std::size_t(p)], stretch.from_s, stretch.to_s));
  RestedMotion rested{start_s > 0 ? from_time(motion, start_s) : motion, 0};
  const double farthest = (rested.motion.positions.front() - rest).rowwise().norm().maxCoeff();
  if (rested.motion.time_s.size() < 2 || farthest <= kAtRest_m) {
    rested.motion.positions.front() = rest;
    return rested;
  }
  lead_in(rested.motion, rest);
  rested.lead_s = rest_lead_s;
  return rested;
}

std::optional<StartedInExpression> started_in_expression(const Motion& motion,
                                                         const io::Landmarks& at_rest,
                                                         double least_moved_m) {
  const Common common = common_of(motion, at_rest);
  const auto& t = motion.time_s;
  if (common.names.size() < kFewest || spread_off_line(common.rest) < kLeastSpread ||
      t.back() - t.front() < 2 * kStretch_s)
    return std::nullopt;
  const auto shape = [&](const RestStretch& stretch) {
    const auto [first, last] = samples_of(motion, stretch);
    return laid_on(common.of(mean_of(motion.positions, first, last)), common.rest);
  };
  const Points start = shape({0, kStart_s});
  const double step_s = std::max(kStretch_s / 3, usual_step_s(motion));
  RestStretch nearest;
  Points there = start;
  double least = (start - common.rest).squaredNorm();
  for (double from_s = 0; from_s + kStretch_s <= t.back() - t.front() + 1e-9; from_s += step_s) {
    const RestStretch stretch{from_s, from_s + kStretch_s};
    const Points here = shape(stretch);
    const double off = (here - common.rest).squaredNorm();
    if (off >= least) continue;
    least = off;
    nearest = stretch;
    there = here;
  }
  const Points moved = start - there;
  Eigen::Index point = 0;
  const double farthest = moved.rowwise().norm().maxCoeff(&point);
  if (farthest < least_moved_m) return std::nullopt;
  const double share = (start - common.rest).cwiseProduct(moved).sum() / moved.squaredNorm();
  if (share <= kNearer) return std::nullopt;
  return StartedInExpression{nearest, common.names[std::size_t(point)], farthest};
}

std::optional<EndedInExpression> ended_in_expression(const Motion& motion) {
  const auto& t = motion.time_s;
  if (t.size() < 2 || t.back() - t.front() < 2 * kStretch_s - 1e-9 ||
      usual_step_s(motion) > Motion::kSmoothUpTo_s)
    return std::nullopt;
  Eigen::Index point = 0;
  std::size_t sample = 0;
  double farthest = 0;
  for (std::size_t k = 1; k < t.size(); ++k)
    for (Eigen::Index p = 0; p < motion.positions[k].rows(); ++p)
      if (const double d = (motion.positions[k].row(p) - motion.positions.front().row(p)).norm();
          d > farthest) {  // never of NaN
        farthest = d;
        point = p;
        sample = k;
      }
  const double before_end_s = t.back() - t[sample];
  if (farthest < kLeastEnd_m || before_end_s > kEnd_s + 1e-9) return std::nullopt;
  const double lasts_s = t.back() - t.front();
  const double end = mean_distance(motion, point, {lasts_s - kEnd_s, lasts_s});
  const double before =
      mean_distance(motion, point, {lasts_s - kStill_s - kEnd_s, lasts_s - kStill_s});
  if (!(end - before > kOnItsWay * farthest)) return std::nullopt;
  return EndedInExpression{motion.names[std::size_t(point)], farthest, before_end_s};
}

}  // namespace hyperex::motion
