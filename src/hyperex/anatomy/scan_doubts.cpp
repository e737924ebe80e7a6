// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/scan_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/anatomy/known_landmarks.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/optional_landmarks.hpp"
#include "hyperex/face/same_place.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/transform.hpp"

namespace hyperex::anatomy {
namespace {

enum class HalfFace { right, left };
constexpr std::array kHalves = {HalfFace::right, HalfFace::left};

constexpr const char* word_of_half(HalfFace half) {
  return half == HalfFace::right ? "right" : "left";
}
constexpr HalfFace other_half(HalfFace half) {
  return half == HalfFace::right ? HalfFace::left : HalfFace::right;
}

// Of the places of the other half, and of the own: those off the scan.
constexpr double kMissingShare = 0.6, kStrayShare = 0.1;
constexpr std::size_t kFewestPlaces = 4, kFewestOfHalf = 2;
// Fewer places or nearer to a line lay the face on the scan too loosely to judge its other half.
constexpr double kLeastSpreadOfHalf = 0.3;
// Half a face fitted to a shallower scan turns about the vertical axis, so that the other half
// leaves it.
constexpr double kLeastNoseOfHalves = 0.3;

/// Nothing: in the midline, or not known.
std::optional<HalfFace> half_of(const std::string& name) {
  if (face::is_optional_landmark(name))
    return name.ends_with("_L") ? HalfFace::left : HalfFace::right;
  const CanonicalFace& face = canonical_face();
  if (!face.landmarks.contains(name) || mirrored_landmark(name) == name) return std::nullopt;
  return face.landmark(name, face.mesh.points).x() > 0 ? HalfFace::left : HalfFace::right;
}

/// The canonical face laid on the scan by the landmarks of one half and of the midline; nothing
/// where these are too few.
std::optional<Similarity> laid_by(HalfFace half, const io::Landmarks& given) {
  io::Landmarks some;
  std::set<std::string> places, of_half;
  for (const auto& [name, position] : given) {
    const std::optional<HalfFace> there = half_of(name);
    if (there == other_half(half) || !canonical_face().landmarks.contains(name)) continue;
    some[name] = position;
    places.insert(face::place_name(name));
    if (there) of_half.insert(face::place_name(name));
  }
  const KnownLandmarks known = known_landmarks(some);
  if (places.size() < kFewestPlaces || of_half.size() < kFewestOfHalf ||
      spread_off_line(known.canonical) < kLeastSpreadOfHalf)
    return std::nullopt;
  return fit_similarity(known.canonical, known.given);
}

struct OffScan {
  std::size_t named = 0, off = 0;
  double share() const { return double(off) / double(named); }
};

/// The named places of one half of the laid face.
OffScan off_scan(HalfFace half, const Similarity& scan_from_canonical, const SurfaceTree& scan) {
  const CanonicalFace& face = canonical_face();
  OffScan count;
  for (const auto& [name, vertices] : face.landmarks) {
    if (half_of(name) != half) continue;
    const Vec3 place = scan_from_canonical * face.landmark(name, face.mesh.points);
    ++count.named;
    if (scan.query(place).squared_distance > kOffScan_m * kOffScan_m) ++count.off;
  }
  return count;
}

/// Between the outer corners, which are known.
double between_eyes_m(const io::Landmarks& landmarks) {
  return (*face::find_place(landmarks, "exocanthion_L") -
          *face::find_place(landmarks, "exocanthion_R"))
      .norm();
}

}  // namespace

std::optional<std::string> half_missing(const io::Landmarks& given, const io::Landmarks& all,
                                        const TriMesh& scan) {
  const std::optional<double> nose = nose_before_plane(all);
  if (nose && *nose < kLeastNoseOfHalves) return std::nullopt;
  std::optional<SurfaceTree> tree;
  for (const HalfFace half : kHalves) {
    const std::optional<Similarity> laid = laid_by(half, given);
    if (!laid) continue;
    if (!tree) tree.emplace(scan);
    const HalfFace other = other_half(half);
    const OffScan missing = off_scan(other, *laid, *tree);
    if (missing.share() <= kMissingShare || off_scan(half, *laid, *tree).share() > kStrayShare)
      continue;
    return fmt::format(
        "the {0} half of the face is missing from the scan: by the landmarks of the {1} half, {2} "
        "of {3} named places of the subject's {0} side lie more than {4:.0f} mm off its surface; "
        "expected a scan of both halves",
        word_of_half(other), word_of_half(half), missing.off, missing.named, 1e3 * kOffScan_m);
  }
  return std::nullopt;
}

std::optional<double> nose_before_plane(const io::Landmarks& landmarks) {
  const std::optional<face::FaceFrame> frame = face::face_frame_of_corners(landmarks);
  const std::optional<Vec3> nose = face::find_place(landmarks, "pronasale");
  if (!frame || !nose) return std::nullopt;
  return frame->local(*nose).z() / between_eyes_m(landmarks);
}

std::optional<Note> flat_warning(const io::Landmarks& landmarks) {
  const std::optional<std::string> flat = flat_problem(landmarks);
  return flat ? std::optional(make_warning("scan.flat", *flat)) : std::nullopt;
}

std::optional<std::string> half_missing_problem(const std::map<std::string, double>& off_m) {
  std::array<OffScan, 2> halves;
  std::size_t off = 0;
  double least_m = std::numeric_limits<double>::infinity(), most_m = 0;
  for (const auto& [name, distance_m] : off_m) {
    const std::optional<HalfFace> half = half_of(name);
    if (half) ++halves[std::size_t(*half)].named;
    if (distance_m <= kOffScan_m) continue;
    if (half) ++halves[std::size_t(*half)].off;
    ++off;
    least_m = std::min(least_m, distance_m);
    most_m = std::max(most_m, distance_m);
  }
  for (const HalfFace half : kHalves) {
    const OffScan &missing = halves[std::size_t(half)],
                  &there = halves[std::size_t(other_half(half))];
    if (missing.off < kFewestOfHalf || missing.off != off || missing.share() < kMissingShare ||
        there.named < kFewestOfHalf)
      continue;
    return fmt::format(
        "the {} half of the face is missing from the scan, or its landmarks are misplaced: {} of "
        "{} landmarks of the subject's {} side are {:.0f} to {:.0f} mm from the scan's surface "
        "(expected: at most {:.0f} mm), and all others lie on it",
        word_of_half(half), missing.off, missing.named, word_of_half(half), 1e3 * least_m,
        1e3 * most_m, 1e3 * kOffScan_m);
  }
  return std::nullopt;
}

std::optional<std::string> flat_problem(const io::Landmarks& landmarks) {
  const std::optional<double> nose = nose_before_plane(landmarks);
  if (!nose || *nose >= kFlattestNose) return std::nullopt;
  const double eyes_mm = 1e3 * between_eyes_m(landmarks);
  return fmt::format(
      "the scan is too flat for a face: the tip of the nose stands {:.1f} mm before the plane of "
      "the corners of eyes and mouth (expected: at least {:.0f} mm where the eyes are {:.0f} mm "
      "wide); check the scan's depth and the landmarks",
      *nose * eyes_mm, kFlattestNose * eyes_mm, eyes_mm);
}

}  // namespace hyperex::anatomy
