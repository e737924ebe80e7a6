// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/fit/photometric.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hyperex/tracking/fit/depth_view.hpp"

namespace hyperex::tracking {
namespace {

constexpr double kDistance_m = 0.6;
const capture::Intrinsics kSmallCamera{500, 500, 160, 120, 320, 240};
const cv::Rect kAll(0, 0, 320, 240);

/// A square of 12 cm that faces the camera. As for a face, the head frame is the camera frame
/// rotated about x by half a turn.
TriMesh sheet() {
  TriMesh mesh;
  mesh.points.resize(4, 3);
  mesh.points << -0.06, -0.06, 0, 0.06, -0.06, 0, 0.06, 0.06, 0, -0.06, 0.06, 0;
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 1, 2, 0, 2, 3;
  return mesh;
}

Eigen::Isometry3d in_front() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()).toRotationMatrix();
  pose.translation().z() = kDistance_m;
  return pose;
}

/// Waves shifted by `shift` pixels to the right and down from their place in the first picture;
/// with `contrast` 1, of 50 levels. Red and green have opposite signs.
cv::Mat waves(const Eigen::Vector2d& shift, double contrast, double level = 128,
              double length_px = 20) {
  cv::Mat picture(kAll.size(), CV_8UC3);
  const double k = 2 * std::numbers::pi / length_px;
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x) {
      const double u = x - shift.x(), v = y - shift.y();
      const double wave = contrast * 25 * (std::sin(k * u + 0.3) + std::cos(k * v + 0.4 * k * u));
      picture.at<cv::Vec3b>(y, x) =
          cv::Vec3b(cv::saturate_cast<uchar>(level), cv::saturate_cast<uchar>(level + 0.4 * wave),
                    cv::saturate_cast<uchar>(level + 1.6 * wave));
    }
  return picture;
}

PhotometricOptions all_of(Channel channel) {
  PhotometricOptions options;
  options.channel = channel;
  options.least_gradient = 0;
  return options;
}

/// The shift of the sheet between two pictures, in pixels, by the Gauss-Newton method for a shift
/// in its own plane.
Eigen::Vector2d found_shift(const cv::Mat& before, const cv::Mat& now, Channel channel) {
  const TriMesh mesh = sheet();
  const Eigen::Isometry3d start = in_front();
  const double sigma_px = 1;
  const Template skin(fine_picture(before, kAll, channel, sigma_px), kSmallCamera, start,
                      mesh.points, mesh.triangles, {true, true}, all_of(channel));
  EXPECT_GT(skin.size(), 5000u);
  const FinePicture picture = fine_picture(now, kAll, channel, sigma_px);
  VertexSystem::RowMatrix together = VertexSystem::RowMatrix::Zero(12, 2);
  for (int v = 0; v < 4; ++v) together.block<2, 2>(3 * v, 0).setIdentity();
  Eigen::Isometry3d pose = start;
  for (int iteration = 0; iteration < 8; ++iteration) {
    VertexSystem system(mesh);
    skin.add_to(system, picture, kSmallCamera, pose, mesh.points, 1);
    const Eigen::Matrix2d hessian = together.transpose() * system.times(together);
    const Eigen::Vector2d step = -hessian.ldlt().solve(together.transpose() * system.gradient());
    pose.translate(Vec3(step.x(), step.y(), 0));
  }
  return project(kSmallCamera, pose * Vec3::Zero()) - project(kSmallCamera, start * Vec3::Zero());
}

TEST(Photometric, AShiftOfAPartOfAPixelIsFound) {
  for (const Channel channel : {Channel::grey, Channel::chroma})
    for (const Eigen::Vector2d& shift : {Eigen::Vector2d(0.3, -0.4), Eigen::Vector2d(-2.2, 1.7)}) {
      const Eigen::Vector2d found = found_shift(waves({0, 0}, 1), waves(shift, 1), channel);
      EXPECT_LT((found - shift).norm(), 0.03) << int(channel) << ": " << found.transpose();
    }
}

TEST(Photometric, BrightnessAndContrastMakeNoShift) {
  const Eigen::Vector2d shift(0.6, 0.25);
  for (const auto& [contrast, level] : {std::pair{0.5, 64.0}, {1.0, 60.0}, {0.7, 190.0}}) {
    const Eigen::Vector2d found =
        found_shift(waves({0, 0}, 1), waves(shift, contrast, level), Channel::grey);
    EXPECT_LT((found - shift).norm(), 0.05) << contrast << ": " << found.transpose();
  }
}

TEST(Photometric, TheSamePictureAgreesAndAnotherDoesNot) {
  const TriMesh mesh = sheet();
  const auto picture = [](const cv::Mat& bgr) { return fine_picture(bgr, kAll, Channel::grey, 1); };
  const Template skin(picture(waves({0, 0}, 1)), kSmallCamera, in_front(), mesh.points,
                      mesh.triangles, {true, true}, all_of(Channel::grey));
  VertexSystem system(mesh);
  const auto share = [&](const cv::Mat& bgr) {
    return skin.add_to(system, picture(bgr), kSmallCamera, in_front(), mesh.points, 1);
  };
  EXPECT_GT(share(waves({0, 0}, 1)), 0.999);
  const double at_rest = system.gradient().norm();
  system.clear();
  EXPECT_LT(share(waves({10, 10}, 1)), 0.5);
  EXPECT_LT(at_rest, 1e-4 * system.gradient().norm());
}

TEST(Photometric, TrianglesLeftOutBackFacesAndFlatSkinGiveNothing) {
  TriMesh mesh = sheet();
  const FinePicture picture = fine_picture(waves({0, 0}, 1), kAll, Channel::grey, 1);
  const auto size = [&](const std::vector<bool>& compared, const PhotometricOptions& options) {
    return Template(picture, kSmallCamera, in_front(), mesh.points, mesh.triangles, compared,
                    options)
        .size();
  };
  PhotometricOptions options = all_of(Channel::grey);
  const std::size_t both = size({true, true}, options);
  EXPECT_NEAR(double(size({true, false}, options)), 0.5 * double(both), 0.05 * double(both));
  EXPECT_EQ(size({false, false}, options), 0u);
  options.outline_px = 20;
  EXPECT_LT(size({true, true}, options), both);
  options = all_of(Channel::grey);
  options.least_gradient = 1000;
  EXPECT_EQ(size({true, true}, options), 0u);
  mesh.triangles.col(1).swap(mesh.triangles.col(2));
  EXPECT_EQ(size({true, true}, all_of(Channel::grey)), 0u);
}

double bilinear(const cv::Mat& picture, const Eigen::Vector2d& at) {
  const int x = int(at.x()), y = int(at.y());
  const double a = at.x() - x, b = at.y() - y;
  const auto value = [&](int dx, int dy) { return double(picture.at<float>(y + dy, x + dx)); };
  return (1 - b) * ((1 - a) * value(0, 0) + a * value(1, 0)) +
         b * ((1 - a) * value(0, 1) + a * value(1, 1));
}

/// The cost, written independently: over all pixels of the sheet. The waves fade towards the
/// sheet's edges, so that it does not matter which of the outermost pixels count.
TEST(Photometric, GradientAgreesWithFiniteDifferencesOfTheCost) {
  const auto fading = [](const Eigen::Vector2d& shift) {
    cv::Mat picture = waves(shift, 2, 128, 40);
    for (int y = 0; y < picture.rows; ++y)
      for (int x = 0; x < picture.cols; ++x) {
        const double near = std::max(std::abs(x - 160.0), std::abs(y - 120.0)) / 50;  // 1: edge
        const double keep =
            near < 0.9 ? std::pow(std::cos(std::numbers::pi / 2 * near / 0.9), 2) : 0;
        for (int c = 0; c < 3; ++c) {
          uchar& level = picture.at<cv::Vec3b>(y, x)[c];
          level = cv::saturate_cast<uchar>(128 + keep * (level - 128));
        }
      }
    return picture;
  };
  const TriMesh mesh = sheet();
  PhotometricOptions options = all_of(Channel::chroma);
  options.outline_px = 0.5;
  options.pixels_as_one = 7;
  options.noise = 2;
  const FinePicture before = fine_picture(fading({0, 0}), kAll, Channel::chroma, 1.5),
                    now = fine_picture(fading({1.5, -1}), kAll, Channel::chroma, 1.5);
  const double weight = 1.7;
  VertexSystem system(mesh);
  Template(before, kSmallCamera, in_front(), mesh.points, mesh.triangles, {true, true}, options)
      .add_to(system, now, kSmallCamera, in_front(), mesh.points, weight);
  // Corners of the sheet in the picture, in the order of its vertices, as given.
  const auto cost = [&](const Points& points) {
    Eigen::Vector2d px[4], was[4];
    for (int v = 0; v < 4; ++v) {
      px[v] = project(kSmallCamera, in_front() * Vec3(points.row(v).transpose()));
      was[v] = project(kSmallCamera, in_front() * Vec3(mesh.points.row(v).transpose()));
    }
    double sum = 0;
    for (int y = 71; y < 170; ++y)
      for (int x = 111; x < 210; ++x) {
        const bool first = x - was[0].x() > was[0].y() - y;  // below the diagonal from 0 to 2
        const int t = first ? 0 : 1, a = mesh.triangles(t, 0), b = mesh.triangles(t, 1),
                  c = mesh.triangles(t, 2);
        Eigen::Matrix2d edges;
        edges << was[b] - was[a], was[c] - was[a];
        const Eigen::Vector2d w = edges.inverse() * (Eigen::Vector2d(x, y) - was[a]);
        const Eigen::Vector2d at = px[a] + w[0] * (px[b] - px[a]) + w[1] * (px[c] - px[a]);
        const double error = bilinear(now.value, at) - double(before.value.at<float>(y, x));
        const double relative = error / options.robust;
        sum += 0.5 * weight / (options.noise * options.noise * options.pixels_as_one) * error *
               error / (1 + relative * relative);  // Geman and McClure
      }
    return sum;
  };
  for (int k = 0; k < 12; ++k) {
    Points plus = mesh.points, minus = mesh.points;
    const double step_m = 2e-4;  // a sixth of a pixel: over the kinks of the interpolation
    plus.data()[k] += step_m;
    minus.data()[k] -= step_m;
    const double numeric = (cost(plus) - cost(minus)) / (2 * step_m);
    EXPECT_NEAR(system.gradient()[k], numeric, 0.06 * system.gradient().cwiseAbs().maxCoeff()) << k;
    if (k % 3 == 0) {
      EXPECT_GT(std::abs(numeric), 10) << k;
    }
  }
}

}  // namespace
}  // namespace hyperex::tracking
