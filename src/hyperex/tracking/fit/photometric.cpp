// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/fit/photometric.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "hyperex/expression/mesh_border.hpp"
#include "hyperex/tracking/fit/depth_view.hpp"

namespace hyperex::tracking {

namespace {

constexpr double kLocalMeanSigma_px = 6;

double bilinear(const cv::Mat& picture, double u, double v) {
  const int x = int(u), y = int(v);
  const double a = u - x, b = v - y;
  const float *top = picture.ptr<float>(y) + x, *below = picture.ptr<float>(y + 1) + x;
  return (1 - b) * ((1 - a) * double(top[0]) + a * double(top[1])) +
         b * ((1 - a) * double(below[0]) + a * double(below[1]));
}

bool inside(const cv::Mat& picture, double u, double v) {
  return u >= 0 && v >= 0 && u < picture.cols - 1 && v < picture.rows - 1;
}

Pixels project_all(const capture::Intrinsics& camera, const Eigen::Isometry3d& camera_from_head,
                   const Points& points) {
  Pixels pixels(points.rows(), 2);
  for (Eigen::Index v = 0; v < points.rows(); ++v)
    pixels.row(v) = project(camera, camera_from_head * Vec3(points.row(v).transpose())).transpose();
  return pixels;
}

/// Non-zero for pixels too close to a border edge of the mesh. On the outline of the face, such an
/// edge slides over the skin as the head rotates; other border edges belong to an opening.
cv::Mat border_mask(const Pixels& px, const TriMesh& mesh, const FinePicture& picture,
                    const PhotometricOptions& options) {
  const expression::BorderEdges border = expression::border_edges(mesh);
  constexpr int kShift = 4;
  const auto at = [&](int v) {
    return cv::Point(int(std::lround((px(v, 0) - picture.origin.x) * (1 << kShift))),
                     int(std::lround((px(v, 1) - picture.origin.y) * (1 << kShift))));
  };
  const auto near = [&](const std::vector<std::pair<int, int>>& edges, double width_px) -> cv::Mat {
    cv::Mat free(picture.value.size(), CV_8U, cv::Scalar(255)), distance;
    for (const auto& [a, b] : edges) cv::line(free, at(a), at(b), 0, 1, cv::LINE_8, kShift);
    cv::distanceTransform(free, distance, cv::DIST_L2, cv::DIST_MASK_5);
    return distance <= width_px;
  };
  return near(border.outline, options.outline_px) | near(border.openings, options.border_px);
}

}  // namespace

FinePicture fine_picture(const cv::Mat& bgr, cv::Rect region, Channel channel, double sigma_px) {
  region &= cv::Rect(0, 0, bgr.cols, bgr.rows);
  FinePicture fine;
  fine.origin = region.tl();
  if (region.width < 8 || region.height < 8) return fine;
  if (channel == Channel::grey) {
    cv::Mat grey, mean;
    cv::cvtColor(bgr(region), grey, cv::COLOR_BGR2GRAY);
    grey.convertTo(grey, CV_32F);
    cv::GaussianBlur(grey, fine.value, {}, sigma_px);
    // Two box filters approximate a Gaussian at a cost independent of its width.
    const int side = int(std::lround(kLocalMeanSigma_px * 2)) | 1;
    cv::blur(grey, mean, {side, side});
    cv::blur(mean, mean, {side, side});
    fine.value -= mean;
  } else {
    static const std::array<float, 256> logarithm = [] {
      std::array<float, 256> table;
      for (int i = 0; i < 256; ++i) table[std::size_t(i)] = 100 * std::log(float(i) + 16);
      return table;
    }();
    cv::Mat ratio(region.size(), CV_32F);
    for (int y = 0; y < region.height; ++y) {
      const cv::Vec3b* from = bgr.ptr<cv::Vec3b>(region.y + y) + region.x;
      float* to = ratio.ptr<float>(y);
      for (int x = 0; x < region.width; ++x) to[x] = logarithm[from[x][2]] - logarithm[from[x][1]];
    }
    cv::GaussianBlur(ratio, fine.value, {}, sigma_px);
  }
  cv::Sobel(fine.value, fine.gradient_x, CV_32F, 1, 0, 3, 1.0 / 8);
  cv::Sobel(fine.value, fine.gradient_y, CV_32F, 0, 1, 3, 1.0 / 8);
  return fine;
}

Template::Template(const FinePicture& picture, const capture::Intrinsics& camera,
                   const Eigen::Isometry3d& camera_from_head, const Points& head_points,
                   const Triangles& triangles, const std::vector<bool>& compared,
                   const PhotometricOptions& options)
    : triangles_(triangles), options_(options) {
  if (picture.value.empty()) return;
  const Pixels px = project_all(camera, camera_from_head, head_points);
  const cv::Mat border = border_mask(px, {head_points, triangles}, picture, options);
  const auto facing = [&](int t) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k)
      corners.col(k) = camera_from_head * Vec3(head_points.row(triangles(t, k)).transpose());
    const Vec3 normal = (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0));
    return -normal.normalized().dot(corners.rowwise().mean().normalized());
  };
  for (int t = 0; t < triangles.rows(); ++t) {
    if (!compared[std::size_t(t)]) continue;
    const Eigen::Vector2d origin(picture.origin.x, picture.origin.y);
    const Eigen::Vector2d a = px.row(triangles(t, 0)).transpose() - origin,
                          b = px.row(triangles(t, 1)).transpose() - origin,
                          c = px.row(triangles(t, 2)).transpose() - origin;
    const Eigen::Vector2d e = b - a, f = c - a;
    const double area = e.x() * f.y() - e.y() * f.x();
    // A triangle that is counter-clockwise seen from outside has negative area here, as y points
    // down.
    if (area > -0.5 || facing(t) < options.least_cosine) continue;
    const int x0 = std::max(1, int(std::ceil(std::min({a.x(), b.x(), c.x()})))),
              x1 = std::min(picture.value.cols - 2,
                            int(std::floor(std::max({a.x(), b.x(), c.x()})))),
              y0 = std::max(1, int(std::ceil(std::min({a.y(), b.y(), c.y()})))),
              y1 = std::min(picture.value.rows - 2,
                            int(std::floor(std::max({a.y(), b.y(), c.y()}))));
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const Eigen::Vector2d d = Eigen::Vector2d(x, y) - a;
        const double wb = (d.x() * f.y() - d.y() * f.x()) / area,
                     wc = (e.x() * d.y() - e.y() * d.x()) / area;
        if (wb < 0 || wc < 0 || wb + wc > 1 || border.at<uchar>(y, x)) continue;
        if (std::hypot(picture.gradient_x.at<float>(y, x), picture.gradient_y.at<float>(y, x)) <
            options.least_gradient)
          continue;
        samples_.push_back(
            {t, {float(1 - wb - wc), float(wb), float(wc)}, picture.value.at<float>(y, x)});
      }
  }
}

/// The samples in another picture, with the mesh's vertices at the given positions. `gain`: the
/// brightness there relative to that of the samples; 0 if none is visible.
std::vector<Template::Seen> Template::seen_in(const FinePicture& picture, const Pixels& vertices,
                                              double& gain) const {
  std::vector<Seen> seen(samples_.size());
  double product = 0, square = 0;
  for (std::size_t s = 0; s < samples_.size(); ++s) {
    const Sample& sample = samples_[s];
    Eigen::RowVector2d at(-picture.origin.x, -picture.origin.y);
    for (int k = 0; k < 3; ++k)
      at += double(sample.weights[k]) * vertices.row(triangles_(sample.triangle, k));
    if (!inside(picture.value, at.x(), at.y())) {
      seen[s] = {-1, -1, 0};
      continue;
    }
    seen[s] = {at.x(), at.y(), bilinear(picture.value, at.x(), at.y())};
    product += double(sample.value) * seen[s].value;
    square += double(sample.value) * double(sample.value);
  }
  gain = 0;
  if (square <= 0) return seen;
  // The contrast is proportional to the brightness of the scene.
  gain = options_.channel == Channel::grey ? std::clamp(product / square, 0.2, 3.0) : 1;
  return seen;
}

double Template::add_to(VertexSystem& system, const FinePicture& picture,
                        const capture::Intrinsics& camera,
                        const Eigen::Isometry3d& camera_from_head, const Points& head_points,
                        double weight) const {
  if (samples_.empty() || picture.value.empty()) return 0;
  const Pixels px = project_all(camera, camera_from_head, head_points);
  double gain = 0;
  const std::vector<Seen> seen = seen_in(picture, px, gain);
  if (gain == 0) return 0;
  const double noise = options_.noise * std::max(gain, 0.4);
  const double scale = weight / (noise * noise * options_.pixels_as_one);
  const Eigen::Matrix3d turn = camera_from_head.linear();
  std::size_t agreeing = 0;
  for (std::size_t s = 0; s < samples_.size();) {
    const int t = samples_[s].triangle;
    Eigen::Matrix<double, 2, 9> jacobian_of_corners;
    for (int k = 0; k < 3; ++k)
      jacobian_of_corners.middleCols<3>(3 * k) =
          project_jacobian(camera,
                           camera_from_head * Vec3(head_points.row(triangles_(t, k)).transpose())) *
          turn;
    // In the picture plane: six coordinates, which are then transformed to nine.
    Eigen::Matrix<double, 6, 6> h = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 1> g = Eigen::Matrix<double, 6, 1>::Zero();
    for (; s < samples_.size() && samples_[s].triangle == t; ++s) {
      if (seen[s].u < 0) continue;
      const double error = seen[s].value - gain * double(samples_[s].value);
      const double relative = error / (options_.robust * std::max(gain, 0.4));
      if (std::abs(error) < 3 * noise) ++agreeing;
      const double robust = 1 / ((1 + relative * relative) * (1 + relative * relative));
      const double gx = bilinear(picture.gradient_x, seen[s].u, seen[s].v),
                   gy = bilinear(picture.gradient_y, seen[s].u, seen[s].v);
      Eigen::Matrix<double, 6, 1> j;
      for (int k = 0; k < 3; ++k) {
        j[2 * k] = double(samples_[s].weights[k]) * gx;
        j[2 * k + 1] = double(samples_[s].weights[k]) * gy;
      }
      h.noalias() += (scale * robust) * j * j.transpose();
      g += (scale * robust * error) * j;
    }
    Eigen::Matrix<double, 6, 9> wide = Eigen::Matrix<double, 6, 9>::Zero();
    for (int k = 0; k < 3; ++k)
      wide.block<2, 3>(2 * k, 3 * k) = jacobian_of_corners.middleCols<3>(3 * k);
    system.add_triangle(t, wide.transpose() * h * wide, wide.transpose() * g);
  }
  return double(agreeing) / double(samples_.size());
}

}  // namespace hyperex::tracking
