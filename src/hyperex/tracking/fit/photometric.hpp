// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <vector>

#include "hyperex/capture/frame.hpp"
#include "hyperex/tracking/fit/vertex_system.hpp"

namespace hyperex::tracking {

/// The quantity of a picture that is compared.
enum class Channel {
  grey,   ///< grey levels (0 to 255) minus their local mean, which removes most of the shading
  chroma  ///< 100 ln((R + 16) / (G + 16)): distinguishes lips from skin, independent of shading
};

/// One channel of a picture around a face, with its gradient.
struct FinePicture {
  cv::Mat value, gradient_x, gradient_y;  ///< CV_32F; levels, and levels per pixel
  cv::Point origin;                       ///< position of these pictures in the whole picture
};
/// `region` is clipped to the picture. `bgr`: CV_8UC3. `sigma_px`: finer detail is removed by
/// smoothing.
FinePicture fine_picture(const cv::Mat& bgr, cv::Rect region, Channel channel, double sigma_px);

struct PhotometricOptions {
  Channel channel = Channel::grey;
  double noise = 3;    ///< standard deviation of one pixel, levels
  double robust = 20;  ///< levels: pixels that differ more have little weight (Geman-McClure)
  /// Levels per pixel; where the gradient is smaller, it shows lighting rather than skin texture.
  double least_gradient = 6;
  double outline_px = 5;      ///< pixels closer than this to the outline of the face are not used
  double least_cosine = 0.5;  ///< between the skin's normal and the line of sight
  /// Pixels closer than this to the openings of eyes and mouth are not used.
  double border_px = 1.5;
  /// Errors of neighbouring pixels are correlated: this many count as one.
  double pixels_as_one = 8;
};

/// Positions in a picture; each row is u, v.
using Pixels = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// The appearance of the face in one frame, pixel by pixel on the mesh. Later frames are compared
/// with it to find the motion of the skin. There is no drift, because all frames are compared with
/// the same template.
class Template {
 public:
  Template() = default;
  /// `head_points`: the vertices of the mesh in that frame, head frame. `compared`: for each
  /// triangle, false if it is excluded.
  Template(const FinePicture& picture, const capture::Intrinsics& camera,
           const Eigen::Isometry3d& camera_from_head, const Points& head_points,
           const Triangles& triangles, const std::vector<bool>& compared,
           const PhotometricOptions& options);

  bool empty() const { return samples_.empty(); }
  std::size_t size() const { return samples_.size(); }

  /// Adds the measurements of another picture to `system`, linearised at the vertices given by
  /// `camera_from_head` and `head_points` (Gauss-Newton with the robust loss of Geman and McClure).
  /// Returns the share (0 to 1) of pixels that agree to within three times the noise.
  double add_to(VertexSystem& system, const FinePicture& picture, const capture::Intrinsics& camera,
                const Eigen::Isometry3d& camera_from_head, const Points& head_points,
                double weight) const;

 private:
  struct Sample {
    int triangle;
    float weights[3];
    float value;
  };
  struct Seen {
    double u, v, value;  // negative u: outside the picture
  };
  std::vector<Seen> seen_in(const FinePicture& picture, const Pixels& vertices, double& gain) const;

  std::vector<Sample> samples_;  // sorted by triangle
  Triangles triangles_;
  PhotometricOptions options_;
};

}  // namespace hyperex::tracking
