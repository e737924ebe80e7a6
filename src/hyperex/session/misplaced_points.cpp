// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/misplaced_points.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <tuple>
#include <utility>

#include "hyperex/anatomy/lips.hpp"
#include "hyperex/core/add_rest.hpp"
#include "hyperex/core/quantile.hpp"
#include "hyperex/face/canonical_face.hpp"
#include "hyperex/face/point_words.hpp"
#include "hyperex/face/same_place.hpp"
#include "hyperex/geometry/transform.hpp"
#include "hyperex/simulate/drive/common_points.hpp"

namespace hyperex::session {
namespace {

// Measured: the greatest ratio of a point's distance (Matched::off_m) to its limit is 0.59 where
// seven recordings, two of them tracked, are laid on eight faces. It is 0.78 where such a recording
// starts in an expression, and 0.92 between the landmarks of any two of these faces.
constexpr double kOff_m = 8e-3, kOffOfVague_m = 30e-3;
constexpr double kOffOverMedian = 4;
constexpr Eigen::Index kFewestToCompare = 6, kManyToCompare = 20;
constexpr std::size_t kNeighbours = 3;
constexpr double kLeastSpreadOffLine = 0.05;
constexpr double kExact_m = 1e-4;

/// The points that both sides name, and a fit of the recording's to the scan's.
struct Matched : simulate::CommonPoints {
  Similarity scan_from_recording;
  Points residual;  // vectors from the landmarks

  Eigen::Index size() const { return motion.rows(); }
  double distance_m(Eigen::Index i) const { return residual.row(i).norm(); }
  double median_m() const {
    std::vector<double> distances;
    for (Eigen::Index i = 0; i < size(); ++i) distances.push_back(distance_m(i));
    return median(std::move(distances));
  }
  void lay(const Similarity& fit) {
    scan_from_recording = fit;
    residual = fit.apply(motion) - scan;
  }
  double off_m(Eigen::Index i) const;
};

/// The fit to all points, or to all but one, whose median distance is least.
void lay_without_the_worst(Matched& points) {
  points.lay(fit_similarity(points.motion, points.scan));
  Matched best = points;
  double least_m = best.median_m();
  for (Eigen::Index out = 0; out < points.size(); ++out) {
    std::vector<Eigen::Index> kept(std::size_t(points.size()));
    std::iota(kept.begin(), kept.end(), 0);
    kept.erase(kept.begin() + out);
    const Points scan = points.scan(kept, Eigen::all);
    if (spread_off_line(scan) < kLeastSpreadOffLine) continue;
    points.lay(fit_similarity(points.motion(kept, Eigen::all), scan));
    if (const double here_m = points.median_m(); here_m < least_m) {
      least_m = here_m;
      best = points;
    }
  }
  points = std::move(best);
}

void lay_robustly(Matched& points) {
  constexpr int rounds = 20;
  lay_without_the_worst(points);
  for (int round = 0; round < rounds; ++round) {
    const double cauchy_m = 2 * std::max(points.median_m(), kExact_m);
    const Eigen::VectorXd part = points.residual.rowwise().norm() / cauchy_m;
    const Eigen::VectorXd weights = (1 + part.array().square()).inverse();
    points.lay(fit_similarity(points.motion, points.scan, weights));
  }
}

int lip_of_either_name(const std::string& name) {
  const int lip = anatomy::lip_of(name);
  return lip != 0 ? lip : anatomy::lip_of(face::other_name(name));
}

/// The least of a point's distance from its landmark and of the same less that of its neighbours.
double Matched::off_m(Eigen::Index i) const {
  std::vector<std::pair<double, Eigen::Index>> neighbours;
  const int lip = lip_of_either_name(names[std::size_t(i)]);
  for (Eigen::Index j = 0; j < size(); ++j)
    if (j != i && lip * lip_of_either_name(names[std::size_t(j)]) >= 0)
      neighbours.emplace_back((scan.row(j) - scan.row(i)).norm(), j);
  const std::size_t near = std::min(kNeighbours, neighbours.size());
  if (near == 0) return distance_m(i);
  std::ranges::sort(neighbours);
  Vec3 usual = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> along;
    for (std::size_t k = 0; k < near; ++k) along.push_back(residual(neighbours[k].second, axis));
    usual[axis] = median(std::move(along));
  }
  return std::min(distance_m(i), (residual.row(i).transpose() - usual).norm());
}

/// Whether the place of a point differs between trackers, or by who sets it, by centimetres.
bool is_vague(const std::string& name) {
  constexpr int chin_from = 6, chin_to = 10, outline_to = 16;
  if (const auto number = face::ibug_number_of_place(name))
    return *number <= outline_to && (*number < chin_from || *number > chin_to);
  return face::canonical_face().landmarks.contains(name);
}

/// Whether a point and its mirror image lie at each other's landmarks: left and right are exchanged
/// (exchanged_warning).
bool is_exchanged(const Matched& points, Eigen::Index i, double within_m) {
  const std::string other = face::mirrored_landmark(points.names[std::size_t(i)]);
  const auto found = std::ranges::find(points.names, other);
  const Eigen::Index j = found - points.names.begin();
  if (found == points.names.end() || j == i) return false;
  const auto lies_at = [&](Eigen::Index one, Eigen::Index landmark) {
    const Vec3 laid = (points.residual.row(one) + points.scan.row(one)).transpose();
    return (laid - points.scan.row(landmark).transpose()).norm() < within_m;
  };
  return lies_at(i, j) && lies_at(j, i);
}

/// With the two axes by whose exchange the point comes nearest to its landmark, if that is within
/// `within_m`.
MisplacedPoints::Point misplaced_point(const Matched& points, Eigen::Index i, double within_m) {
  MisplacedPoints::Point point{points.names[std::size_t(i)], points.distance_m(i), "", within_m};
  for (const auto& [a, b, words] :
       {std::tuple{0, 1, "x and y"}, {0, 2, "x and z"}, {1, 2, "y and z"}}) {
    Vec3 at = points.motion.row(i).transpose();
    std::swap(at[a], at[b]);
    const double off_m =
        (points.scan_from_recording * at - Vec3(points.scan.row(i).transpose())).norm();
    if (off_m >= point.off_exchanged_m) continue;
    point.off_exchanged_m = off_m;
    point.exchanged_axes = words;
  }
  if (point.exchanged_axes.empty()) point.off_exchanged_m = 0;
  return point;
}

}  // namespace

std::string exchanged_axes_words(const MisplacedPoints::Point& point) {
  return point.exchanged_axes.empty()
             ? ""
             : fmt::format(" ({:.1f} mm with its {} exchanged)", 1e3 * point.off_exchanged_m,
                           point.exchanged_axes);
}

MisplacedPoints misplaced_points(const motion::Motion& stabilised, const io::Landmarks& landmarks) {
  MisplacedPoints out;
  Matched points{simulate::common_points(stabilised, landmarks), {}, {}};
  if (points.size() < kFewestToCompare || spread_off_line(points.scan) < kLeastSpreadOffLine)
    return out;
  lay_robustly(points);
  const double usual_m = kOffOverMedian * points.median_m();
  double squares = 0;
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    const std::string& name = points.names[std::size_t(i)];
    const bool vague = points.size() < kManyToCompare || is_vague(name);
    const double limit_m = std::max(vague ? kOffOfVague_m : kOff_m, usual_m);
    if (points.off_m(i) > limit_m && !is_exchanged(points, i, limit_m)) {
      out.points.push_back(misplaced_point(points, i, std::max(kOff_m, usual_m)));
    } else {
      squares += points.residual.row(i).squaredNorm();
      ++out.others.common;
    }
  }
  std::ranges::stable_sort(out.points, std::ranges::greater(), &MisplacedPoints::Point::off_m);
  out.others.scale = points.scan_from_recording.scale;
  if (out.others.common > 0)
    out.others.rms_mm = 1e3 * std::sqrt(squares / double(out.others.common));
  return out;
}

std::optional<Note> misplaced_warning(const MisplacedPoints& misplaced) {
  constexpr std::size_t most_named = 3;
  const std::size_t count = misplaced.points.size();
  if (count == 0) return std::nullopt;
  std::vector<std::string> named;
  for (const MisplacedPoints::Point& point : misplaced.points)
    if (named.size() < most_named)
      named.push_back(fmt::format("{} {}{:.1f} mm{}{}", face::name_in_words(point.name),
                                  named.empty() ? "lies " : "", 1e3 * point.off_m,
                                  named.empty() ? " from the scan's landmark of that name" : "",
                                  exchanged_axes_words(point)));
  add_rest(named, count);
  const bool one = count == 1;
  return make_warning(
      "recording.point_off",
      fmt::format("{} of the recording {} not fit the scan: {}; the other {} points are {:.1f} mm "
                  "rms off; correct {} in the recording or leave {} out there, or correct the "
                  "{} in scan.landmarks",
                  one ? "one point" : fmt::format("{} points", count), one ? "does" : "do",
                  fmt::join(named, ", "), misplaced.others.common, misplaced.others.rms_mm,
                  one ? "it" : "them", one ? "it" : "them", one ? "landmark" : "landmarks"));
}

}  // namespace hyperex::session
