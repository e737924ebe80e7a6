// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/scan/scan_viewer.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "hyperex/face/canonical_face.hpp"

namespace hyperex::tracking {

Vec3 ScanView::point_on_ray(double x_px, double y_px) const {
  const double m_per_px = camera.height_m / bgr.rows;
  const Eigen::Matrix3d axes = camera.axes();
  return camera.target + axes.row(0).transpose() * ((x_px + 0.5 - bgr.cols / 2.0) * m_per_px) +
         axes.row(1).transpose() * ((bgr.rows / 2.0 - y_px - 0.5) * m_per_px);
}

FacePoints ScanView::seen(const Points& face_points) const {
  FacePoints seen;
  for (int i = 0; i < face_point_count; ++i) {
    const auto p = render::project(camera, bgr.cols, bgr.rows, face_points.row(i).transpose());
    seen.row(i) << p.x - 0.5, p.y - 0.5, -p.towards_viewer_m * bgr.rows / camera.height_m;
  }
  return seen;
}

ScanViewer::ScanViewer(const TriMesh& mesh, const render::VertexColours& colours)
    : surface_{.mesh = mesh, .colours = colours} {}

ScanView ScanViewer::look(const render::Camera& camera, int size_px, int samples) const {
  render::Image image = render::render({surface_}, camera,
                                       {.width_px = size_px,
                                        .height_px = size_px,
                                        .samples = samples,
                                        .background = {0.45, 0.47, 0.50},
                                        .hide_backs = true});
  ScanView view{camera, {}};
  cv::cvtColor(cv::Mat(size_px, size_px, CV_8UC3, image.rgb.data()), view.bgr, cv::COLOR_RGB2BGR);
  return view;
}

render::Camera ScanViewer::whole(const Vec3& to_viewer, const Vec3& up) const {
  return render::framing(surface_.mesh.points, to_viewer, 1, up);
}

Points ScanViewer::on_surface(const ScanView& view, const FacePoints& points_px,
                              Eigen::VectorXd& weights) const {
  // Beyond 75 degrees of inclination, the error of a ray is amplified fourfold.
  constexpr double least_facing = 0.25;
  const Eigen::MatrixX2d places = points_px.leftCols<2>().array() + 0.5;
  const auto picked = render::pick({surface_}, view.camera, view.bgr.cols, view.bgr.rows, places);
  Points points = Points::Zero(face_point_count, 3);
  weights.setZero(face_point_count);
  for (int i = 0; i < face_point_count; ++i) {
    const auto& hit = picked[std::size_t(i)];
    if (!hit || hit->facing < least_facing) continue;
    points.row(i) = hit->point.transpose();
    weights[i] = hit->facing;
  }
  return points;
}

render::Camera face_camera(const FacePose& pose, double yaw_rad, double pitch_rad) {
  // Factor on the height of the canonical face; the network needs some space around the face.
  constexpr double margin = 1.7;
  const Points& canonical = face::canonical_face().mesh.points;
  const Vec3 low = canonical.colwise().minCoeff(), high = canonical.colwise().maxCoeff();
  const Similarity& scan_from_face = pose.scan_from_canonical;
  const Vec3 side(std::sin(yaw_rad) * std::cos(pitch_rad), std::sin(pitch_rad),
                  std::cos(yaw_rad) * std::cos(pitch_rad));
  return {.target = scan_from_face * ((low + high) / 2),
          .to_viewer = scan_from_face.rotation * side,
          .up = pose.up(),
          .height_m = margin * (high - low).y() * scan_from_face.scale};
}

}  // namespace hyperex::tracking
