// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <vector>

#include "hyperex/capture/frame.hpp"
#include "hyperex/tracking/fit/vertex_system.hpp"

namespace hyperex::tracking {

/// A picture's fine structure around a face: the grey values less their local mean, which takes out
/// most of what light and shading do, and its gradient.
struct FinePicture {
  cv::Mat value, gradient_x, gradient_y;  ///< CV_32F, grey levels (0 to 255) and per pixel
  cv::Point origin;                       ///< of these pictures in the whole one
};
/// `region` is clipped to the picture. `bgr`: CV_8UC3.
FinePicture fine_picture(const cv::Mat& bgr, cv::Rect region);

struct PhotometricOptions {
  double noise = 3;           ///< grey levels, of one pixel of the fine picture
  double least_gradient = 3;  ///< grey levels per pixel: smoother skin tells nothing
  double border_px = 1.5;     ///< pixels nearer to the mesh's border are not used
  double pixels_as_one = 8;   ///< neighbouring pixels err alike: so many count as one
};

/// How the face looked in one frame, pixel for pixel on the mesh. Compared with later frames it
/// tells where the skin went, without drift, for it is always the same picture that is compared.
class Template {
 public:
  Template() = default;
  /// `head_points`: the mesh's vertices in that frame, head frame.
  Template(const FinePicture& picture, const capture::Intrinsics& camera,
           const Eigen::Isometry3d& camera_from_head, const Points& head_points,
           const Triangles& triangles, const PhotometricOptions& options);

  bool empty() const { return samples_.empty(); }
  std::size_t size() const { return samples_.size(); }

  /// What another picture says of the vertices, linearised where `camera_from_head` and
  /// `head_points` put them: Gauss-Newton with Geman and McClure's robust loss. Returns the share
  /// of the pixels that agree within three times the noise, 0 to 1.
  double add_to(VertexSystem& system, const FinePicture& picture, const capture::Intrinsics& camera,
                const Eigen::Isometry3d& camera_from_head, const Points& head_points,
                double weight) const;

 private:
  struct Sample {
    int triangle;
    float weights[3];
    float value;
  };
  std::vector<Sample> samples_;  // by triangle
  Triangles triangles_;
  PhotometricOptions options_;
};

}  // namespace hyperex::tracking
