// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/scan/find_front.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hyperex/core/progress.hpp"
#include "hyperex/face/canonical_face.hpp"

namespace hyperex::tracking {
namespace {

/// A face that the detector found in a view from one direction.
struct Candidate {
  double score = 0;
  Vec3 to_viewer, up;
};

/// The vertices of an icosahedron and the midpoints of its edges. No direction is more than 21
/// degrees from one of these 42.
std::vector<Vec3> sides() {
  constexpr double g = std::numbers::phi;
  std::vector<Vec3> corners, sides;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-g, g})
      for (int turn = 0; turn < 3; ++turn) {
        Vec3 corner;
        corner[turn] = 0, corner[(turn + 1) % 3] = a, corner[(turn + 2) % 3] = b;
        corners.push_back(corner);
      }
  sides = corners;
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if ((corners[i] - corners[j]).norm() < 2.1) sides.push_back(corners[i] + corners[j]);
  for (Vec3& side : sides) side.normalize();
  return sides;
}

/// For each direction in which the detector finds a face, the best one; highest score first.
std::vector<Candidate> look_from_all_sides(const ScanViewer& viewer) {
  constexpr int size_px = 256, turns = 8;
  FaceFinder finder({.least_score = 0.35});
  std::vector<Candidate> candidates;
  const auto directions = sides();
  Progress progress("looking for the face", long(directions.size()));
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Vec3& side = directions[i];
    const ScanView view = viewer.look(viewer.whole(side, side.unitOrthogonal()), size_px, 1);
    const Eigen::Matrix3d axes = view.camera.axes();
    Candidate best;
    for (int turn = 0; turn < turns; ++turn) {
      const double angle = 2 * std::numbers::pi * turn / turns;
      for (const FoundFace& face :
           finder.find_in(view.bgr, {(size_px - 1) / 2.0, (size_px - 1) / 2.0, size_px, angle})) {
        if (face.score <= best.score) continue;
        const double upright = face.region().angle_rad;
        best = {face.score, side,
                axes.row(0).transpose() * std::sin(upright) +
                    axes.row(1).transpose() * std::cos(upright)};
      }
    }
    if (best.score > 0) candidates.push_back(best);
    progress.update(long(i) + 1);
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  return candidates;
}

/// Fits the canonical face to the points of one view. Outliers are excluded in the second round.
std::optional<FacePose> pose_of(const ScanViewer& viewer, const ScanView& view,
                                const FaceLandmarks& seen) {
  Eigen::VectorXd weights;
  const Points points = viewer.on_surface(view, seen.points_px, weights);
  const Points& canonical = face::canonical_face().mesh.points;
  FacePose pose;
  pose.score = seen.score;
  for (int round = 0; round < 2; ++round) {
    if ((weights.array() > 0).count() < face_point_count / 4) return std::nullopt;
    pose.scan_from_canonical = fit_similarity(canonical, points, weights);
    const Points laid = pose.scan_from_canonical.apply(canonical);
    pose.rms_m = rms_distance(laid, points, weights);
    for (int i = 0; i < face_point_count; ++i)
      if ((laid.row(i) - points.row(i)).norm() > 2.5 * pose.rms_m) weights[i] = 0;
  }
  return pose;
}

/// Views the face from its own front repeatedly, until this direction no longer changes.
std::optional<FacePose> refine(const ScanViewer& viewer, LandmarkTracker& tracker,
                               const FaceRegion& first, const ScanView& first_view) {
  constexpr int rounds = 4;
  constexpr double least_score = 0.5, same_front = 0.9994;  // 2 degrees
  FaceLandmarks seen = tracker.settle(first_view.bgr, first);
  std::optional<FacePose> pose = pose_of(viewer, first_view, seen);
  for (int round = 0; round < rounds && pose && pose->score >= least_score; ++round) {
    const ScanView view = viewer.look(face_camera(*pose, 0, 0), scan_picture_px, 2);
    seen = tracker.settle(
        view.bgr,
        region_of(view.seen(pose->scan_from_canonical.apply(face::canonical_face().mesh.points))));
    const Vec3 front = pose->front(), up = pose->up();
    pose = pose_of(viewer, view, seen);
    if (pose && pose->front().dot(front) > same_front && pose->up().dot(up) > same_front) break;
  }
  if (pose && pose->score < least_score) pose.reset();
  return pose;
}

/// Whether a pose can be that of a face. The canonical face is that of an adult. Its rms distance
/// is 4 mm from a face at rest and 6.5 mm from one with a wide open mouth. It is 10.5 mm from a
/// sphere, in which the network also finds a face.
bool plausible(const FacePose& pose) {
  constexpr double smallest = 0.5, largest = 1.8, worst_misfit_m = 0.009;
  const double scale = pose.scan_from_canonical.scale;
  return scale > smallest && scale < largest && pose.misfit() < worst_misfit_m;
}

}  // namespace

std::optional<FacePose> find_front(const ScanViewer& viewer, LandmarkTracker& tracker) {
  constexpr std::size_t most_candidates = 8;
  std::vector<Candidate> candidates = look_from_all_sides(viewer);
  if (candidates.size() > most_candidates) candidates.resize(most_candidates);
  FaceFinder finder({.least_score = 0.3});
  std::optional<FacePose> best;
  for (const Candidate& candidate : candidates) {
    const ScanView view =
        viewer.look(viewer.whole(candidate.to_viewer, candidate.up), scan_picture_px, 2);
    const auto& faces = finder.find(view.bgr);
    if (faces.empty()) continue;
    const auto pose = refine(viewer, tracker, faces.front().region(), view);
    if (pose && plausible(*pose) && (!best || pose->misfit() < best->misfit())) best = pose;
  }
  return best;
}

std::optional<FacePose> find_front_near(const ScanViewer& viewer, LandmarkTracker& tracker,
                                        const Similarity& scan_from_canonical) {
  FacePose start;
  start.scan_from_canonical = scan_from_canonical;
  const ScanView view = viewer.look(face_camera(start, 0, 0), scan_picture_px, 2);
  const Points laid = scan_from_canonical.apply(face::canonical_face().mesh.points);
  const auto pose = refine(viewer, tracker, region_of(view.seen(laid)), view);
  return pose && plausible(*pose) ? pose : std::nullopt;
}

}  // namespace hyperex::tracking
