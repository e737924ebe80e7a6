// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/landmarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/anatomy/fold_landmarks.hpp"
#include "hyperex/anatomy/known_landmarks.hpp"
#include "hyperex/anatomy/negated_axes.hpp"
#include "hyperex/anatomy/register_face.hpp"
#include "hyperex/anatomy/scan_doubts.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/lower_case.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/face/optional_landmarks.hpp"
#include "hyperex/face/same_place.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/rbf.hpp"
#include "hyperex/geometry/transform.hpp"

namespace hyperex::anatomy {

namespace {

constexpr double kLargestOffset_m = kOffScan_m;
// Eye corners alone spread by 0.07 about their line; less leaves the face's tilt to chance.
constexpr double kLeastSpread = 0.04;
// Faces differ from the canonical one by up to 17 mm at the jaw (subject A); a mistake is larger.
constexpr double kLargestSurprise_m = 0.04;
// A pair is exchanged if exchanging it back removes at least this share of the misfit.
constexpr double kExchangedShare = 0.5, kExchangedRms_m = 0.006;

/// Begins as the name of a known landmark does.
bool resembles_a_known_one(const std::string& name) {
  constexpr std::size_t kAlike = 3;  // letters
  const std::string start = lower_case(name.substr(0, kAlike));
  return std::ranges::any_of(canonical_face().landmarks, [&](const auto& known) {
    return lower_case(known.first.substr(0, kAlike)) == start;
  });
}

/// At most 20 names, first those that were probably meant to be known, then how many more.
std::string listed(std::vector<std::string> names) {
  constexpr std::size_t most = 20;
  std::ranges::stable_partition(names, resembles_a_known_one);
  const auto last = names.begin() + std::ptrdiff_t(std::min(most, names.size()));
  return fmt::format("{}{}", fmt::join(names.begin(), last, ", "),
                     names.size() > most ? fmt::format(" and {} more", names.size() - most) : "");
}

double misfit(const Points& canonical, const Points& given) {
  return rms_distance(fit_similarity(canonical, given).apply(canonical), given);
}

[[noreturn]] void refuse_all(const std::string& source, const std::vector<std::string>& problems) {
  std::string text = problems.front();
  for (std::size_t i = 1; i < problems.size(); ++i) text += "\n" + source + ": " + problems[i];
  throw InputError(source, text);
}

double extent(const Points& points) {
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
}

/// One sentence where most landmarks float off the scan: they are of another scan, or in another
/// unit of length.
std::string misplaced_as_a_whole(const io::Landmarks& given, std::size_t off, double least_m,
                                 double most_m, const TriMesh& scan) {
  Points points(Eigen::Index(given.size()), 3);
  Eigen::Index row = 0;
  for (const auto& entry : given) points.row(row++) = entry.second;
  std::string text = fmt::format(
      "{} of {} landmarks are {:.0f} to {:.0f} mm from the scan's surface: expected at most {:.0f} "
      "mm",
      off, given.size(), least_m * 1e3, most_m * 1e3, kLargestOffset_m * 1e3);
  const double ratio = extent(points) / extent(scan.points);
  return text + (ratio < 0.15 || ratio > 6
                     ? fmt::format("; they span {:.4g} mm and the scan {:.4g} mm: is their unit of "
                                   "length right?",
                                   extent(points) * 1e3, extent(scan.points) * 1e3)
                     : std::string("; are they this scan's, in its axes?"));
}

/// Landmarks that float off the scan.
std::vector<std::string> offset_problems(const io::Landmarks& given, const TriMesh& scan,
                                         const SurfaceTree& tree) {
  std::map<std::string, double> off_m;
  for (const auto& [name, position] : given)
    off_m[name] = std::sqrt(tree.query(position).squared_distance);
  std::vector<std::string> problems;
  double least_m = 1e9, most_m = 0;
  for (const auto& [name, distance] : off_m) {
    if (distance <= kLargestOffset_m) continue;
    least_m = std::min(least_m, distance);
    most_m = std::max(most_m, distance);
    problems.push_back(
        fmt::format("landmark {} is {:.1f} mm from the scan's surface: expected "
                    "at most {:.0f} mm",
                    name, distance * 1e3, kLargestOffset_m * 1e3));
  }
  if (problems.size() <= 3) return problems;
  if (const auto half = half_missing_problem(off_m)) return {*half};
  if (2 * problems.size() > given.size())
    return {misplaced_as_a_whole(given, problems.size(), least_m, most_m, scan)};
  return problems;
}

/// Whether points i and j are exchanged: with them turned round, they come far closer to where all
/// the others put them; where there are few others, all come far closer to one another.
bool pair_is_exchanged(const KnownLandmarks& known, Eigen::Index i, Eigen::Index j) {
  const Eigen::Index count = known.given.rows();
  if (count < 8) {
    Points turned = known.given;
    turned.row(i).swap(turned.row(j));
    const double before = misfit(known.canonical, known.given);
    return before > kExchangedRms_m && misfit(known.canonical, turned) < kExchangedShare * before;
  }
  Points canonical(count - 2, 3), given(count - 2, 3);
  for (Eigen::Index k = 0, row = 0; k < count; ++k)
    if (k != i && k != j) {
      canonical.row(row) = known.canonical.row(k);
      given.row(row++) = known.given.row(k);
    }
  if (spread_off_line(canonical) < kLeastSpread) return false;
  const Similarity fit = fit_similarity(canonical, given);
  const Vec3 at_i = fit * Vec3(known.canonical.row(i)), at_j = fit * Vec3(known.canonical.row(j));
  const Vec3 given_i = known.given.row(i), given_j = known.given.row(j);
  const auto rms = [](const Vec3& a, const Vec3& b) {
    return std::sqrt((a.squaredNorm() + b.squaredNorm()) / 2);
  };
  const double before = rms(given_i - at_i, given_j - at_j);
  return before > kExchangedRms_m && rms(given_j - at_i, given_i - at_j) < kExchangedShare * before;
}

/// Pairs with left and right exchanged.
std::vector<std::string> exchange_problems(const KnownLandmarks& known) {
  std::vector<std::string> problems;
  const double before = misfit(known.canonical, known.given);
  Points all_turned = known.given;
  for (std::size_t i = 0; i < known.names.size(); ++i) {
    const auto other =
        std::find(known.names.begin(), known.names.end(), mirrored_landmark(known.names[i]));
    if (other != known.names.end())
      all_turned.row(Eigen::Index(i)) = known.given.row(other - known.names.begin());
  }
  if (before > kExchangedRms_m && misfit(known.canonical, all_turned) < kExchangedShare * before)
    return {"left and right are exchanged in all landmarks: L and R are the subject's own sides"};
  for (std::size_t i = 0; i < known.names.size(); ++i) {
    const auto other =
        std::find(known.names.begin(), known.names.end(), mirrored_landmark(known.names[i]));
    if (other == known.names.end() || std::size_t(other - known.names.begin()) <= i) continue;
    if (pair_is_exchanged(known, Eigen::Index(i), other - known.names.begin()))
      problems.push_back(
          fmt::format("landmarks {} and {} are exchanged: L and R are the "
                      "subject's own sides",
                      known.names[i], *other));
  }
  return problems;
}

/// Whether the landmark is the nose's tip or a corner of the plane that its depth is measured from.
bool measures_depth(const std::string& name) {
  constexpr std::array kPlaces = {30, 36, 45, 48, 54};  // of iBUG
  const std::optional<int> place = face::ibug_number_of_place(name);
  return place && std::ranges::find(kPlaces, *place) != kPlaces.end();
}

/// Landmarks far from where the others put them. On a scan without depth many are: the nose shows
/// that, unless it or a corner of its plane is the one that slipped.
std::vector<std::string> slip_problems(const KnownLandmarks& known, const io::Landmarks& given) {
  std::vector<std::string> problems;
  const Eigen::Index count = known.given.rows();
  if (count < 5) return problems;
  std::string worst;
  double largest = kLargestSurprise_m;
  for (Eigen::Index i = 0; i < count; ++i) {
    Points a(count - 1, 3), b(count - 1, 3);
    for (Eigen::Index j = 0, row = 0; j < count; ++j)
      if (j != i) {
        a.row(row) = known.canonical.row(j);
        b.row(row++) = known.given.row(j);
      }
    if (spread_off_line(a) < kLeastSpread) continue;
    // If the set does not fit without this landmark either, the mistake is elsewhere.
    const Similarity fit = fit_similarity(a, b);
    if (rms_distance(fit.apply(a), b) > kLargestSurprise_m / 2) continue;
    const Vec3 expected = fit * Vec3(known.canonical.row(i));
    const double surprise = (expected - known.given.row(i).transpose()).norm();
    if (surprise > largest) {
      largest = surprise;
      worst = known.names[std::size_t(i)];
    }
  }
  if (const auto flat = flat_problem(given); flat && !worst.empty() && !measures_depth(worst))
    return {*flat};
  if (!worst.empty())
    problems.push_back(
        fmt::format("landmark {} is {:.0f} mm from where the others put it: "
                    "expected less than {:.0f} mm",
                    worst, largest * 1e3, kLargestSurprise_m * 1e3));
  return problems;
}

/// Whether the face, placed by the landmarks, faces the outer side of the scan's surface.
bool looks_outwards(const KnownLandmarks& known, const TriMesh& scan, const SurfaceTree& tree) {
  const Similarity scan_from_canonical = fit_similarity(known.canonical, known.given);
  const Vec3 forward = scan_from_canonical.rotation * Vec3::UnitZ();
  double sum = 0;
  for (Eigen::Index i = 0; i < known.given.rows(); ++i) {
    const ClosestPoint hit = tree.query(known.given.row(i));
    const auto corner = [&](int c) -> Vec3 {
      return scan.points.row(scan.triangles(hit.triangle, c));
    };
    sum += (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized().dot(forward);
  }
  return sum > 0;
}

/// The canonical face, registered to the scan and to the known landmarks, gives the missing ones.
void place_missing(const std::set<std::string>& missing, const io::Landmarks& given,
                   const KnownLandmarks& known, const TriMesh& scan, const SurfaceTree& tree,
                   io::Landmarks& landmarks) {
  const CanonicalFace& face = canonical_face();
  const RegisteredFace registered = register_canonical_face(given, scan);
  Points registered_known = known.given;
  for (std::size_t i = 0; i < known.names.size(); ++i)
    registered_known.row(Eigen::Index(i)) = face.landmark(known.names[i], registered.points);
  const Rbf correction(registered_known, known.given - registered_known);
  for (const auto& name : missing) {
    const Vec3 fitted = face.landmark(name, registered.points);
    landmarks[name] = tree.query(fitted + correction.at(fitted)).point;
  }
}

/// Those of the fold can be judged only where all others are known.
std::vector<std::string> problems_at_the_fold(const io::Landmarks& landmarks) {
  const bool complete = std::ranges::all_of(
      face::all_ibug(), [&](const std::string& name) { return landmarks.contains(name); });
  return complete ? fold_landmark_problems(landmarks) : std::vector<std::string>();
}

}  // namespace

CompletedLandmarks complete_landmarks(const io::Landmarks& given, const TriMesh& scan,
                                      const std::string& source) {
  std::vector<std::string> names;
  for (const auto& entry : canonical_face().landmarks) names.push_back(entry.first);
  return complete_landmarks(given, names, scan, source);
}

std::vector<std::string> unknown_landmarks(const io::Landmarks& given) {
  std::vector<std::string> names;
  for (const auto& entry : given)
    if (!face::is_known_landmark(entry.first)) names.push_back(entry.first);
  return names;
}

Note unknown_landmarks_note(const std::vector<std::string>& names) {
  return make_note(
      "landmarks.unknown",
      fmt::format("{} not known and ignored: {}; docs/landmarks.md lists the names",
                  names.size() == 1 ? "one landmark's name is"
                                    : fmt::format("the names of {} landmarks are", names.size()),
                  listed(names)));
}

CompletedLandmarks complete_landmarks(const io::Landmarks& given,
                                      const std::vector<std::string>& needed, const TriMesh& scan,
                                      const std::string& source) {
  const SurfaceTree tree(scan);
  std::vector<std::string> problems = offset_problems(given, scan, tree);
  std::set<std::string> missing;
  for (const auto& name : needed)
    if (!given.contains(name)) missing.insert(name);
  for (const auto& name : missing)
    if (!canonical_face().landmarks.contains(name))
      problems.push_back("landmark " + name +
                         " is needed and missing, and cannot be placed: its name is unknown");
  const KnownLandmarks known = known_landmarks(given);
  const bool enough = known.names.size() >= 3 && spread_off_line(known.given) >= kLeastSpread;
  if (!enough && !missing.empty()) {
    const auto unknown = unknown_landmarks(given);
    problems.push_back(
        fmt::format("{} needed landmarks are missing (the first is {}); to place "
                    "them takes three known ones that are not on one line, and "
                    "{} of those given are known{}",
                    missing.size(), *missing.begin(), known.names.size(),
                    unknown.empty() ? "" : " (not known: " + listed(unknown) + ")"));
  }
  // Axes other than the scan's explain all landmarks far off it.
  if (enough)
    if (const auto axes =
            negated_axes_problem(known.canonical, known.given, tree, kLargestOffset_m))
      problems = {*axes};
  if (enough && problems.empty()) {
    problems = exchange_problems(known);
    if (problems.empty() && !looks_outwards(known, scan, tree))
      problems.push_back(
          "by these landmarks the face looks into the scan: left and right are "
          "exchanged (L and R are the subject's own sides), or the scan's "
          "triangles are inside out");
    if (problems.empty()) problems = slip_problems(known, given);
  }
  if (!problems.empty()) refuse_all(source, problems);

  CompletedLandmarks completed{given, {missing.begin(), missing.end()}};
  if (!missing.empty()) place_missing(missing, given, known, scan, tree, completed.landmarks);
  problems = problems_at_the_fold(completed.landmarks);
  if (!problems.empty()) refuse_all(source, problems);
  return completed;
}

}  // namespace hyperex::anatomy
