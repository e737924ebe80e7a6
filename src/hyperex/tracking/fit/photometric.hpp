// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <vector>

#include "hyperex/capture/frame.hpp"
#include "hyperex/tracking/fit/vertex_system.hpp"

namespace hyperex::tracking {

/// What of a picture is compared.
enum class Channel {
  grey,   ///< grey levels (0 to 255) less their local mean, which takes out most of the shading
  chroma  ///< 100 ln((R + 16) / (G + 16)): lips against skin, whatever the shading
};

/// One channel of a picture around a face, with its gradient.
struct FinePicture {
  cv::Mat value, gradient_x, gradient_y;  ///< CV_32F, levels and levels per pixel
  cv::Point origin;                       ///< of these pictures in the whole one
};
/// `region` is clipped to the picture. `bgr`: CV_8UC3. `sigma_px`: what is finer is smoothed away.
FinePicture fine_picture(const cv::Mat& bgr, cv::Rect region, Channel channel, double sigma_px);

struct PhotometricOptions {
  Channel channel = Channel::grey;
  double noise = 3;           ///< levels, of one pixel
  double robust = 20;         ///< levels: pixels that differ more hardly count (Geman-McClure)
  double least_gradient = 6;  ///< levels per pixel: smoother skin shows light, not skin
  double outline_px = 5;      ///< pixels nearer to the face's outline are not used
  double least_cosine = 0.5;  ///< between the skin's normal and the line of sight
  double border_px = 1.5;     ///< nor those nearer to the openings of eyes and mouth
  double pixels_as_one = 8;   ///< neighbouring pixels err alike: so many count as one
};

/// Places in a picture, u and v in a row.
using Pixels = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// How the face looked in one frame, pixel for pixel on the mesh. Later frames are compared with it
/// to find where the skin went; there is no drift, as the picture compared with is always the same.
class Template {
 public:
  Template() = default;
  /// `head_points`: the mesh's vertices in that frame, head frame. `compared`: per triangle, false
  /// where it is left out.
  Template(const FinePicture& picture, const capture::Intrinsics& camera,
           const Eigen::Isometry3d& camera_from_head, const Points& head_points,
           const Triangles& triangles, const std::vector<bool>& compared,
           const PhotometricOptions& options);

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
  struct Seen {
    double u, v, value;  // u below 0: outside the picture
  };
  std::vector<Seen> seen_in(const FinePicture& picture, const Pixels& vertices, double& gain) const;

  std::vector<Sample> samples_;  // by triangle
  Triangles triangles_;
  PhotometricOptions options_;
};

}  // namespace hyperex::tracking
