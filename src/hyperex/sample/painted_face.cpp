// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/sample/painted_face.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "hyperex/face/ibug.hpp"
#include "hyperex/sample/noise.hpp"

namespace hyperex::sample {
namespace {

const Vec3 kSkin(214, 180, 160), kLips(180, 110, 105), kBrow(120, 88, 72);
constexpr double kBlotches = 2.5;        // levels of 255, standard deviation
constexpr double kLipBorder_m = 0.0002;  // half the width in which skin becomes lip
constexpr double kBrowHalfWidth_m = 0.0028;
constexpr std::uint32_t kSeed = 1;

cv::Point2f in_picture(const Vec3& p) {
  return {float(p.x()), float(p.y())};
}

std::vector<cv::Point2f> outline(const io::Landmarks& landmarks, int first, int end) {
  std::vector<cv::Point2f> points;
  for (int k = first; k < end; ++k) points.push_back(in_picture(landmarks.at(face::ibug(k))));
  return points;
}

double distance(const cv::Point2f& p, const std::vector<cv::Point2f>& line) {
  double least = HUGE_VAL;
  for (std::size_t k = 1; k < line.size(); ++k) {
    const cv::Point2f along = line[k] - line[k - 1];
    const double t = std::clamp((p - line[k - 1]).dot(along) / along.dot(along), 0.F, 1.F);
    least = std::min(least, cv::norm(p - line[k - 1] - cv::Point2f(float(t) * along)));
  }
  return least;
}

}  // namespace

render::VertexColours painted_face(const Points& points, const io::Landmarks& landmarks) {
  const auto lips = outline(landmarks, 48, 60), brow_r = outline(landmarks, 17, 22),
             brow_l = outline(landmarks, 22, 27);
  Noise noise(kSeed);
  render::VertexColours colours(points.rows(), 3);
  for (Eigen::Index v = 0; v < points.rows(); ++v) {
    const cv::Point2f at = in_picture(points.row(v).transpose());
    const double inside_m = cv::pointPolygonTest(lips, at, true);
    const double lip = std::clamp(0.5 + inside_m / (2 * kLipBorder_m), 0.0, 1.0);
    const double off = std::min(distance(at, brow_r), distance(at, brow_l)) / kBrowHalfWidth_m;
    const double brow = 0.8 * std::exp(-off * off);
    const Vec3 colour = brow * kBrow + (1 - brow) * (lip * kLips + (1 - lip) * kSkin).eval() +
                        Vec3::Constant(kBlotches * noise.normal());
    for (int k = 0; k < 3; ++k)
      colours(v, k) = std::uint8_t(std::lround(std::clamp(colour[k], 0.0, 255.0)));
  }
  return colours;
}

}  // namespace hyperex::sample
