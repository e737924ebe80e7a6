// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hyperex/capture/decode.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/render/contact_sheet.hpp"
#include "hyperex/tracking/scan/scan_landmarks.hpp"

namespace hyperex::tracking {
namespace {

/// A vertex on a seam of the texture has several texture coordinates; the last one is used.
render::VertexColours texture_at_vertices(const io::Scan& scan) {
  const cv::Mat bgr = capture::decode_colour(scan.texture->bytes, "texture").picture;
  if (bgr.empty()) return {};
  render::VertexColours colours = render::VertexColours::Constant(scan.mesh.points.rows(), 3, 200);
  const auto pixel = [](float share, int count) {
    return std::clamp(int(std::floor((share - std::floor(share)) * float(count))), 0, count - 1);
  };
  for (Eigen::Index corner = 0; corner < scan.corner_uv.rows(); ++corner) {
    const auto uv = scan.corner_uv.row(corner);
    if (!uv.allFinite()) continue;
    const auto& colour = bgr.at<cv::Vec3b>(pixel(uv[1], bgr.rows), pixel(uv[0], bgr.cols));
    colours.row(scan.mesh.triangles(corner / 3, corner % 3)) << colour[2], colour[1], colour[0];
  }
  return colours;
}

}  // namespace

render::VertexColours picture_colours(const io::Scan& scan) {
  if (scan.vertex_colour.rows() > 0) return scan.vertex_colour.leftCols<3>();
  if (scan.texture && scan.corner_uv.rows() > 0) return texture_at_vertices(scan);
  return {};
}

Points pictured_points(const TriMesh& scan, const ScanLandmarks& found) {
  constexpr double above_m = 0.06;
  const Eigen::Matrix3d& scan_from_face = found.scan_from_canonical.rotation;
  const Points face = found.face_points * scan_from_face, all = scan.points * scan_from_face;
  const Eigen::Array3d low = face.colwise().minCoeff().transpose().array(),
                       high = face.colwise().maxCoeff().transpose().array();
  const Eigen::Array3d most = high + Eigen::Array3d(0, above_m, 0);
  std::vector<Eigen::Index> forehead;
  for (Eigen::Index v = 0; v < all.rows(); ++v) {
    const Eigen::Array3d at = all.row(v).transpose().array();
    if (at.y() > high.y() && (at >= low).all() && (at <= most).all()) forehead.push_back(v);
  }
  Points out(found.face_points.rows() + Eigen::Index(forehead.size()), 3);
  out << found.face_points, scan.points(forehead, Eigen::all);
  return out;
}

render::Image draw_scan_landmarks(const TriMesh& scan, const render::VertexColours& colours,
                                  const ScanLandmarks& found, const std::string& title) {
  std::vector<render::Marker> markers;
  for (const auto& [name, at] : found.landmarks)
    markers.push_back({at,
                       face::ibug_number(name) ? render::palette::held : render::palette::driven,
                       face::ibug_number(name) ? 3.0 : 2.0});
  const Eigen::Matrix3d scan_from_face = found.scan_from_canonical.rotation;
  const render::RenderOptions size{.width_px = 520, .height_px = 640};
  render::ContactSheet sheet{
      .title = title,
      .note =
          "blue: the 68 iBUG points; red: anatomical landmarks; hollow: up to 5 mm behind the "
          "surface",
      .columns = 3};
  const Points pictured = pictured_points(scan, found);
  constexpr double turn = 0.75;
  for (const auto& [yaw, caption] :
       {std::pair{-turn, "from the subject's right"}, std::pair{0.0, "front"},
        std::pair{turn, "from the subject's left"}}) {
    const Vec3 side(std::sin(yaw), 0, std::cos(yaw));
    const render::Camera camera =
        render::framing(pictured, scan_from_face * side, double(size.width_px) / size.height_px,
                        scan_from_face.col(1), 0.1);
    sheet.pictures.push_back(
        {render::render({{.mesh = scan, .colours = colours}}, camera, size, markers), caption,
         render::side_marks(camera, scan_from_face.col(0))});
  }
  return render::contact_sheet(sheet);
}

}  // namespace hyperex::tracking
