// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/landmark_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "hyperex/face/optional_landmarks.hpp"
#include "hyperex/face/same_place.hpp"
#include "hyperex/geometry/closest_point.hpp"

namespace hyperex::anatomy {
namespace {

// Measured on true landmarks (subject A 90, Spacetime 92, AnimFace's fit 92, embedded face 92,
// humface 7; also their 68 iBUG points, seven and five of them alone): two names of one place are 0
// mm apart; no landmark is more than 0.5 mm off the surface, none more than 3.0 standard deviations
// from where the others put it (the largest distances: 8 mm on the outline of the jaw, 10 mm where
// only five are given, 5 mm on lips, eyes and nose of a full set).
constexpr double kSamePlace_m = 5e-3, kOffSurface_m = 5e-3;
constexpr double kSurprise_m = 7e-3, kDeviations = 3.5;
// With few landmarks, each is predicted less well, and fewer can be outliers by chance: correct
// ones were at most 2.0 standard deviations off.
constexpr double kDeviationsOfFew = 2.75;
constexpr std::size_t kFew = 20;
/// If a larger share is doubtful, the whole set is.
constexpr double kManyShare = 1.0 / 3;

constexpr const char* kRemedy =
    "correct it, or remove it from the landmarks: the program then places it";
constexpr const char* kRemedyOfFold =
    "correct it, or remove it from the landmarks: a rule then leads the fold";

struct Doubt {
  double weight = 0;  ///< for the order, mm
  std::vector<std::string> reasons;
};
using Doubts = std::map<std::string, Doubt>;

Note doubtful(std::string text) {
  return make_warning("landmarks.doubtful", std::move(text));
}

void add(Doubts& doubts, const std::string& name, double distance_m, const std::string& reason) {
  Doubt& doubt = doubts[name];
  doubt.weight = std::max(doubt.weight, 1e3 * distance_m);
  doubt.reasons.push_back(reason);
}

std::map<std::string, LandmarkSurprise> by_name(const std::vector<LandmarkSurprise>& surprises) {
  std::map<std::string, LandmarkSurprise> table;
  for (const auto& surprise : surprises) table[surprise.name] = surprise;
  return table;
}

/// If two names of one place are apart, the one that is farther from its predicted place is
/// doubtful.
void doubt_pairs(const io::Landmarks& given, Doubts& doubts) {
  const auto surprises = by_name(landmark_surprises(given));
  for (const auto& [name, position] : given) {
    const std::string other = face::other_name(name);
    if (other < name || !given.contains(other)) continue;  // each pair once
    const double apart = (position - given.at(other)).norm();
    if (apart <= kSamePlace_m) continue;
    const bool known = surprises.contains(name);
    const bool first = !known || surprises.at(name).deviations >= surprises.at(other).deviations;
    add(doubts, first ? name : other, apart,
        fmt::format("{:.1f} mm from {}, which names the same place{}", 1e3 * apart,
                    first ? other : name,
                    known ? "" : " (one of the two is wrong; too few others to say which)"));
  }
}

/// The most surprising one, if any is beyond the bounds.
const LandmarkSurprise* worst_of(const std::vector<LandmarkSurprise>& surprises, double most) {
  const LandmarkSurprise* worst = nullptr;
  for (const auto& surprise : surprises)
    if (surprise.distance_m > kSurprise_m && surprise.deviations > most &&
        (worst == nullptr || surprise.deviations > worst->deviations))
      worst = &surprise;
  return worst;
}

/// The worst is left out before the next is judged: it would draw its neighbours along.
void doubt_surprises(io::Landmarks given, Doubts& doubts) {
  for (;;) {
    const auto surprises = landmark_surprises(given);
    const LandmarkSurprise* worst =
        worst_of(surprises, surprises.size() <= kFew ? kDeviationsOfFew : kDeviations);
    if (worst == nullptr) return;
    add(doubts, worst->name, worst->distance_m,
        fmt::format("{:.1f} mm from where the other landmarks put it", 1e3 * worst->distance_m));
    given.erase(worst->name);
  }
}

void doubt_surface(const io::Landmarks& given, const TriMesh& scan, Doubts& doubts) {
  const SurfaceTree tree(scan);
  for (const auto& [name, position] : given) {
    const double off = std::sqrt(tree.query(position).squared_distance);
    if (off > kOffSurface_m)
      add(doubts, name, off, fmt::format("{:.1f} mm off the scan's surface", 1e3 * off));
  }
}

Doubts doubts_of(const io::Landmarks& given, const TriMesh& scan) {
  Doubts doubts;
  doubt_pairs(given, doubts);
  doubt_surprises(given, doubts);
  doubt_surface(given, scan, doubts);
  return doubts;
}

}  // namespace

std::vector<std::string> doubtful_landmarks(const io::Landmarks& given, const TriMesh& scan) {
  std::vector<std::string> names;
  for (const auto& [name, doubt] : doubts_of(given, scan)) names.push_back(name);
  return names;
}

std::vector<Note> landmark_doubts(const io::Landmarks& given, const io::Landmarks& found) {
  std::vector<Note> notes;
  io::Landmarks left = given;
  for (;;) {
    const auto surprises = landmark_surprises(left, found);
    const LandmarkSurprise* worst = worst_of(surprises, kDeviations);
    if (worst == nullptr) return notes;
    notes.push_back(doubtful(fmt::format(
        "landmark {} is {:.1f} mm from where the landmarks found on the scan put it: {}",
        worst->name, 1e3 * worst->distance_m, kRemedy)));
    left.erase(worst->name);
  }
}

std::vector<Note> landmark_doubts(const io::Landmarks& given, const TriMesh& scan) {
  const Doubts doubts = doubts_of(given, scan);
  std::vector<std::pair<std::string, Doubt>> order(doubts.begin(), doubts.end());
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.second.weight > b.second.weight; });
  std::vector<Note> notes;
  if (order.size() > 3 && double(order.size()) > kManyShare * double(given.size())) {
    notes.push_back(make_warning(
        "landmarks.many_doubtful",
        fmt::format(
            "{} of {} landmarks are not where the others or the scan put them (the farthest, {}, "
            "by {:.1f} mm): do they belong to this scan and this person at rest?",
            order.size(), given.size(), order.front().first, order.front().second.weight)));
    return notes;
  }
  for (const auto& [name, doubt] : order)
    notes.push_back(
        doubtful(fmt::format("landmark {} is {}: {}", name, fmt::join(doubt.reasons, ", and "),
                             face::is_optional_landmark(name) ? kRemedyOfFold : kRemedy)));
  return notes;
}

}  // namespace hyperex::anatomy
