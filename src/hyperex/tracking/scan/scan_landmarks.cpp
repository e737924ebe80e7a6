// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/scan/scan_landmarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "hyperex/core/error.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/core/quantile.hpp"
#include "hyperex/face/canonical_face.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/turned_triangles.hpp"
#include "hyperex/tracking/scan/find_front.hpp"
#include "hyperex/tracking/scan/lid_edges.hpp"

namespace hyperex::tracking {
namespace {

/// The rays of one picture, each given by a point in the plane of the camera's target.
struct PictureRays {
  Vec3 to_viewer;
  Points on_rays;  // 468 x 3
  double score = 0;
};

/// Converts the points of a mirrored picture to those of the original.
FacePoints unmirrored(const FacePoints& points, int width_px, const std::vector<int>& mirror) {
  FacePoints back;
  for (int i = 0; i < face_point_count; ++i) {
    const auto p = points.row(mirror[std::size_t(i)]);
    back.row(i) << width_px - 1 - p.x(), p.y(), p.z();
  }
  return back;
}

PictureRays observe(const ScanView& view, const FacePoints& points_px, double score) {
  PictureRays o{view.camera.to_viewer.normalized(), Points(face_point_count, 3), score};
  for (int i = 0; i < face_point_count; ++i)
    o.on_rays.row(i) = view.point_on_ray(points_px(i, 0), points_px(i, 1)).transpose();
  return o;
}

/// The mirror image of the scan at x = 0.
TriMesh mirrored(const TriMesh& mesh) {
  TriMesh image = mesh;
  image.points.col(0) *= -1;
  image.triangles.col(1).swap(image.triangles.col(2));
  return image;
}

render::Camera mirrored(render::Camera camera) {
  for (Vec3* v : {&camera.target, &camera.to_viewer, &camera.up}) v->x() *= -1;
  return camera;
}

/// Renders two pictures per view, one of the scan and one of its mirror image, with the same
/// lighting. Left-right errors of the network and effects of the lighting then cancel.
std::vector<PictureRays> look_from_views(const TriMesh& scan, const render::VertexColours& colours,
                                         LandmarkTracker& tracker, const FacePose& pose,
                                         const ScanLandmarkOptions& options) {
  constexpr double least_score = 0.5, rad = std::numbers::pi / 180;
  const std::vector<int>& mirror = face::mirrored_vertices();
  const Points laid = pose.scan_from_canonical.apply(face::canonical_face().mesh.points);
  const TriMesh image = mirrored(scan);
  const ScanViewer viewer(scan, colours), image_viewer(image, colours);
  std::vector<PictureRays> seen;
  Progress progress("finding landmarks", long(options.views_deg.size()));
  for (std::size_t v = 0; v < options.views_deg.size(); ++v) {
    const auto [yaw, pitch] = options.views_deg[v];
    const render::Camera camera = face_camera(pose, yaw * rad, pitch * rad);
    const ScanView view = viewer.look(camera, scan_picture_px, 2);
    const FacePoints expected = view.seen(laid);
    const FaceLandmarks plain = tracker.settle(view.bgr, region_of(expected));
    if (plain.score >= least_score) seen.push_back(observe(view, plain.points_px, plain.score));
    const ScanView image_view = image_viewer.look(mirrored(camera), scan_picture_px, 2);
    const FaceLandmarks turned =
        tracker.settle(image_view.bgr, region_of(unmirrored(expected, scan_picture_px, mirror)));
    if (turned.score >= least_score)
      seen.push_back(
          observe(view, unmirrored(turned.points_px, scan_picture_px, mirror), turned.score));
    progress.update(long(v) + 1);
  }
  return seen;
}

Vec3 normal_of(const TriMesh& mesh, int triangle) {
  const auto corner = [&](int k) -> Vec3 {
    return mesh.points.row(mesh.triangles(triangle, k)).transpose();
  };
  return (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
}

/// Distance of a point from the ray of a view.
double distance(const PictureRays& o, int i, const Vec3& point) {
  const Vec3 away = point - o.on_rays.row(i).transpose();
  return (away - o.to_viewer * o.to_viewer.dot(away)).norm();
}

/// The point that is closest to all rays of one face point, in the weighted least-squares sense.
Vec3 agreed(const std::vector<PictureRays>& seen, int i, Vec3 point, const Vec3& normal,
            double tolerance_m) {
  constexpr int rounds = 10;
  constexpr double depth_prior = 1e-3;  // determines the depth if only one view shows the point
  for (int round = 0; round < rounds; ++round) {
    Eigen::Matrix3d sum = depth_prior * Eigen::Matrix3d::Identity();
    Vec3 right = depth_prior * point;
    for (const PictureRays& o : seen) {
      const double facing = std::max(0.05, normal.dot(o.to_viewer));
      const double off = distance(o, i, point) / tolerance_m;
      const double weight = o.score * facing * facing / (1 + off * off);
      const Eigen::Matrix3d across =
          weight * (Eigen::Matrix3d::Identity() - o.to_viewer * o.to_viewer.transpose());
      sum += across;
      right += across * o.on_rays.row(i).transpose();
    }
    const Vec3 next = sum.ldlt().solve(right);
    const double moved = (next - point).norm();
    point = next;
    if (moved < 1e-6) break;
  }
  return point;
}

[[noreturn]] void refuse_no_face(const TriMesh& scan, bool coloured, const std::string& source) {
  const std::string turned = turned_triangles_doubt(scan);
  throw InputError(
      source, std::string("no face was found in this scan from any side") +
                  (coloured ? ", with its colours or without: " : ": ") +
                  (turned.empty() ? "expected a face, its triangles running counter-clockwise as "
                                    "seen from outside; give its landmarks by hand "
                                    "(docs/landmarks.md)"
                                  : turned));
}

/// The face and what the pictures of it show; no pictures where no face is found.
struct SeenFace {
  std::optional<FacePose> pose;
  std::vector<PictureRays> pictures;
};

SeenFace look_for_face(const TriMesh& scan, const render::VertexColours& colours,
                       LandmarkTracker& tracker, const ScanLandmarkOptions& options) {
  const ScanViewer viewer(scan, colours);
  SeenFace face;
  if (options.scan_from_canonical)
    face.pose = find_front_near(viewer, tracker, *options.scan_from_canonical);
  if (!face.pose) face.pose = find_front(viewer, tracker);
  if (face.pose) face.pictures = look_from_views(scan, colours, tracker, *face.pose, options);
  return face;
}

}  // namespace

ScanLandmarks find_scan_landmarks(const TriMesh& scan, const render::VertexColours& colours,
                                  const std::string& source, const ScanLandmarkOptions& options) {
  LandmarkTracker tracker;
  ScanLandmarks found;
  SeenFace face = look_for_face(scan, colours, tracker, options);
  found.without_colours = face.pictures.empty() && colours.rows() > 0;
  // A pattern on the scan, such as a checkerboard, can hide its face.
  if (found.without_colours) face = look_for_face(scan, {}, tracker, options);
  const auto& [pose, seen] = face;
  if (!pose) refuse_no_face(scan, colours.rows() > 0, source);
  if (seen.empty())
    throw InputError(source, "a face was found but not recognised again from its front");

  const face::CanonicalFace& canonical = face::canonical_face();
  const SurfaceTree surface(scan);
  const Points laid = pose->scan_from_canonical.apply(canonical.mesh.points);
  Points points(face_point_count, 3);
  std::vector<double> off;
  for (int i = 0; i < face_point_count; ++i) {
    const Vec3 normal = normal_of(scan, surface.query(laid.row(i).transpose()).triangle);
    const Vec3 point = agreed(seen, i, laid.row(i).transpose(), normal, options.tolerance_m);
    for (const PictureRays& o : seen) off.push_back(distance(o, i, point));
    points.row(i) = point.transpose();
  }
  for (const auto& entry : canonical.landmarks)
    found.landmarks[entry.first] = surface.query(canonical.landmark(entry.first, points)).point;
  found.face_points.resize(face_point_count, 3);
  for (int i = 0; i < face_point_count; ++i)
    found.face_points.row(i) = surface.query(points.row(i).transpose()).point.transpose();
  found.scan_from_canonical = fit_similarity(canonical.mesh.points, points);
  lids_to_edges(found.landmarks, scan, found.scan_from_canonical.rotation);
  found.views = int(seen.size());
  for (const PictureRays& o : seen) found.score += o.score / double(seen.size());
  found.spread_m = off.empty() ? 0 : median(off);
  return found;
}

}  // namespace hyperex::tracking
