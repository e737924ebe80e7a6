// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/network/landmark_tracker.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/dnn.hpp>
#include <stdexcept>

#include "hyperex/face/canonical_face.hpp"
#include "hyperex/tracking/network/face_mesh_network.hpp"

namespace hyperex::tracking {
namespace {

constexpr int right_eye_outer = 33, left_eye_outer = 263;  // vertices of the canonical face

/// Whether two squares differ so little that the points would hardly change (a tenth of a pixel of
/// 192).
bool settled(const FaceRegion& a, const FaceRegion& b) {
  constexpr double shift = 0.004, growth = 0.006, turn_rad = 0.006;
  return std::hypot(a.x - b.x, a.y - b.y) < shift * a.side_px &&
         std::abs(a.side_px - b.side_px) < growth * a.side_px &&
         std::abs(std::remainder(a.angle_rad - b.angle_rad, 2 * M_PI)) < turn_rad;
}

void check_region(const cv::Mat& bgr, const FaceRegion& region) {
  if (bgr.empty() || bgr.type() != CV_8UC3)
    throw std::invalid_argument("LandmarkTracker: a picture of type CV_8UC3 is wanted");
  if (!(region.side_px > 0))
    throw std::invalid_argument("LandmarkTracker: a square with a side above 0 is wanted");
}

}  // namespace

FaceRegion region_of(const FacePoints& points) {
  const Eigen::Vector2d along =
      (points.row(left_eye_outer) - points.row(right_eye_outer)).head<2>();
  const double angle = std::atan2(along.y(), along.x());
  const Eigen::Matrix2d picture_from_square = Eigen::Rotation2Dd(angle).toRotationMatrix();
  const Eigen::Matrix<double, face_point_count, 2> turned =
      points.leftCols<2>() * picture_from_square;
  const Eigen::Vector2d low = turned.colwise().minCoeff(), high = turned.colwise().maxCoeff();
  const Eigen::Vector2d centre = picture_from_square * (low + high) / 2;
  return {centre.x(), centre.y(), 1.5 * (high - low).maxCoeff(), angle};
}

struct LandmarkTracker::Impl {
  explicit Impl(const LandmarkOptions& o)
      : options(o), finder(o.finder), network(o.lips_again, o.eyes_again) {}

  LandmarkOptions options;
  FaceFinder finder;
  FaceMeshNetwork network;
  cv::Mat scratch, patch, mirrored, input;
  bool following = false;
  FaceRegion next;  // the region for the next picture while tracking
  int faces_in_view = 0, since_look_around = 0;

  /// `points`: the points of `patch`, in its pixels.
  void take_mean_with_mirrored(FacePoints& points, int size_px) {
    cv::flip(patch, mirrored, 1);
    cv::dnn::blobFromImage(mirrored, input, 1 / 255.0, {}, {}, true);
    FacePoints other;
    network.look(input, 0, other);
    const std::vector<int>& opposite = face::mirrored_vertices();
    for (int i = 0; i < face_point_count; ++i) {
      const auto there = other.row(opposite[std::size_t(i)]);
      points.row(i) += Eigen::RowVector3d(size_px - there.x(), there.y(), there.z());
    }
    points /= 2;
  }

  FaceLandmarks look_at(const cv::Mat& bgr, const FaceRegion& region) {
    const int size_px = network.size_px();
    cut_out(bgr, region, size_px, false, scratch, patch);
    cv::dnn::blobFromImage(patch, input, 1 / 255.0, {}, {}, true);
    FaceLandmarks found;
    found.score = network.look(input, options.least_score, found.points_px);
    if (options.mirrored_too && found.score >= options.least_score)
      take_mean_with_mirrored(found.points_px, size_px);
    found.region = region;
    found.faces_in_view = std::max(1, faces_in_view);
    for (int i = 0; i < face_point_count; ++i) {
      auto point = found.points_px.row(i);
      const cv::Point2d p = region.picture_from_square(point.x() / size_px, point.y() / size_px);
      point << p.x, p.y, point.z() * region.side_px / size_px;
    }
    return found;
  }

  FaceLandmarks settle(const cv::Mat& bgr, const FaceRegion& first) {
    FaceLandmarks found = look_at(bgr, first);
    for (int round = 0; round < options.settling_rounds; ++round) {
      const FaceRegion region = region_of(found.points_px);
      if (found.score < options.least_score || settled(region, found.region)) break;
      found = look_at(bgr, region);
    }
    return found;
  }

  std::optional<FaceLandmarks> follow(const cv::Mat& bgr) {
    if (options.look_around_every > 0 && ++since_look_around >= options.look_around_every) {
      since_look_around = 0;
      faces_in_view = std::max(1, int(finder.find(bgr).size()));
    }
    FaceLandmarks found = look_at(bgr, next);
    if (found.score < options.least_score) return std::nullopt;
    return found;
  }

  std::optional<FaceLandmarks> find(const cv::Mat& bgr) {
    const auto& faces = finder.find(bgr);
    faces_in_view = int(faces.size());
    since_look_around = 0;
    for (const FoundFace& face : faces) {
      FaceLandmarks found = settle(bgr, face.region());
      found.found_anew = true;
      if (found.score >= options.least_score) return found;
    }
    return std::nullopt;
  }
};

LandmarkTracker::LandmarkTracker(const LandmarkOptions& options)
    : impl_(std::make_unique<Impl>(options)) {}
LandmarkTracker::~LandmarkTracker() = default;
LandmarkTracker::LandmarkTracker(LandmarkTracker&&) noexcept = default;
LandmarkTracker& LandmarkTracker::operator=(LandmarkTracker&&) noexcept = default;

std::optional<FaceLandmarks> LandmarkTracker::track(const cv::Mat& bgr) {
  check_region(bgr, {0, 0, 1, 0});
  Impl& my = *impl_;
  std::optional<FaceLandmarks> found;
  if (my.following) found = my.follow(bgr);
  if (!found) found = my.find(bgr);
  my.following = found.has_value();
  if (found) my.next = region_of(found->points_px);
  return found;
}

FaceLandmarks LandmarkTracker::look_at(const cv::Mat& bgr, const FaceRegion& region) {
  check_region(bgr, region);
  return impl_->look_at(bgr, region);
}

FaceLandmarks LandmarkTracker::settle(const cv::Mat& bgr, const FaceRegion& first) {
  check_region(bgr, first);
  return impl_->settle(bgr, first);
}

void LandmarkTracker::reset() {
  impl_->following = false;
}

}  // namespace hyperex::tracking
