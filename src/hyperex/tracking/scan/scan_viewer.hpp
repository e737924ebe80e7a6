// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Private to this library: renders a scan for the networks, and maps points of the pictures back to
// the surface.
#include <opencv2/core.hpp>

#include "hyperex/geometry/transform.hpp"
#include "hyperex/render/render.hpp"
#include "hyperex/tracking/network/landmark_tracker.hpp"

namespace hyperex::tracking {

/// A square picture of a scan, with its camera (src/hyperex/render).
struct ScanView {
  render::Camera camera;
  cv::Mat bgr;  ///< CV_8UC3

  /// For a place in the picture (pixels, centres at integers), the point of its viewing ray in the
  /// plane of the camera's target, m.
  Vec3 point_on_ray(double x_px, double y_px) const;
  /// Picture coordinates (pixels, centres at integers) of points. The third coordinate is the depth
  /// in pixels; nearer is smaller, as in FacePoints.
  FacePoints seen(const Points& face_points) const;
};

class ScanViewer {
 public:
  /// Both arguments must outlive this object. `colours`: one row per vertex, or none.
  ScanViewer(const TriMesh& mesh, const render::VertexColours& colours);

  ScanView look(const render::Camera& camera, int size_px, int samples) const;
  /// A camera that shows the whole scan in a square picture.
  render::Camera whole(const Vec3& to_viewer, const Vec3& up) const;
  /// The first surface points under the face points. The weight is the cosine of the surface's
  /// inclination to the view; it is 0 if there is no point, if the inclination exceeds 75 degrees,
  /// or if the surface faces away.
  Points on_surface(const ScanView& view, const FacePoints& points_px,
                    Eigen::VectorXd& weights) const;

 private:
  render::Surface surface_;
};

/// The pose of the canonical face on a scan.
struct FacePose {
  Similarity scan_from_canonical;
  /// Root mean square distance at the visible face points, in the unit of the scan.
  double rms_m = 0;
  double score = 0;  ///< of the network, 0 to 1

  /// Relative to the size of the face, so that a small wrong face is not mistaken for a good fit.
  double misfit() const { return rms_m / scan_from_canonical.scale; }
  Vec3 front() const { return scan_from_canonical.rotation.col(2); }
  Vec3 up() const { return scan_from_canonical.rotation.col(1); }
};

/// Side in pixels of the square pictures rendered for the landmark network, whose own input has
/// 192.
inline constexpr int scan_picture_px = 384;

/// A camera aimed at a face and rotated about it: `yaw_rad` to the subject's left, `pitch_rad`
/// upwards.
render::Camera face_camera(const FacePose& pose, double yaw_rad, double pitch_rad);

}  // namespace hyperex::tracking
