// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Inside the room: pictures of a scan for the networks, and the way back from them to the surface.
#include <opencv2/core.hpp>

#include "hyperex/geometry/transform.hpp"
#include "hyperex/render/render.hpp"
#include "hyperex/tracking/network/landmark_tracker.hpp"

namespace hyperex::tracking {

/// A square picture of a scan, as cameras of the render room see it.
struct ScanView {
  render::Camera camera;
  cv::Mat bgr;  ///< CV_8UC3

  /// Of a place in the picture (pixels, centres at integers): a point of its ray, in the plane of
  /// the camera's target, m.
  Vec3 point_on_ray(double x_px, double y_px) const;
  /// Picture coordinates (pixels, centres at integers) of points, and their height towards the
  /// viewer in pixels, turned round: nearer is smaller, as in FacePoints.
  FacePoints seen(const Points& face_points) const;
};

class ScanViewer {
 public:
  /// Both are referred to. `colours`: one row per vertex, or none.
  ScanViewer(const TriMesh& mesh, const render::VertexColours& colours);

  ScanView look(const render::Camera& camera, int size_px, int samples) const;
  /// The camera that holds the whole scan in a square.
  render::Camera whole(const Vec3& to_viewer, const Vec3& up) const;
  /// First surface points under the face points; weight 0 where there is none or it is turned away.
  Points on_surface(const ScanView& view, const FacePoints& points_px,
                    Eigen::VectorXd& weights) const;

 private:
  render::Surface surface_;
};

/// How the canonical face lies on a scan.
struct FacePose {
  Similarity scan_from_canonical;
  double rms_m = 0;  ///< at the face points that were seen on the surface, lengths of the scan
  double score = 0;  ///< the network's

  /// Relative to the face's size, so that a small wrong face does not look like a good one.
  double misfit() const { return rms_m / scan_from_canonical.scale; }
  Vec3 front() const { return scan_from_canonical.rotation.col(2); }
  Vec3 up() const { return scan_from_canonical.rotation.col(1); }
};

/// Pixels of the square pictures that the landmark network is shown: it sees a face in 192.
inline constexpr int scan_picture_px = 384;

/// A camera on a face, turned about it: `yaw_rad` to the subject's left, `pitch_rad` upwards.
render::Camera face_camera(const FacePose& pose, double yaw_rad, double pitch_rad);

}  // namespace hyperex::tracking
