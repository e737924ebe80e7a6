// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/network/landmark_tracker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "face_pictures.hpp"

namespace hyperex::tracking {
namespace {

constexpr int size_px = 400;
constexpr double height_m = 0.32;  // the face fills about half of it
constexpr double px_per_mm = size_px / 320.0;

TEST(FaceRegion, CutsOutWhatItSays) {
  cv::Mat picture(60, 80, CV_8UC3);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x)
      picture.at<cv::Vec3b>(y, x) = cv::Vec3b(uchar(3 * x), uchar(4 * y), 0);
  cv::Mat scratch, patch;
  const FaceRegion region{41.5, 28.5, 20, 0};
  cut_out(picture, region, 20, false, scratch, patch);
  EXPECT_EQ(patch.at<cv::Vec3b>(0, 0), picture.at<cv::Vec3b>(19, 32));
  EXPECT_EQ(patch.at<cv::Vec3b>(19, 19), picture.at<cv::Vec3b>(38, 51));
  // A quarter turn: the square's x axis runs down the picture.
  cut_out(picture, {41.5, 28.5, 20, M_PI / 2}, 20, false, scratch, patch);
  EXPECT_EQ(patch.at<cv::Vec3b>(0, 0), picture.at<cv::Vec3b>(19, 51));
  EXPECT_EQ(patch.at<cv::Vec3b>(0, 19), picture.at<cv::Vec3b>(38, 51));
  // Three pixels a pixel: their mean.
  cut_out(picture, {30, 30, 30, 0}, 10, false, scratch, patch);
  EXPECT_NEAR(patch.at<cv::Vec3b>(4, 4)[0], 3 * (30 - 15 + 4.5 * 3), 2);
  cut_out(picture, {-100, -100, 20, 0}, 10, true, scratch, patch);
  EXPECT_EQ(cv::countNonZero(patch.reshape(1)), 0);
}

TEST(FaceRegion, CornersOfATurnedSquare) {
  const FaceRegion region{10, 20, 8, M_PI / 2};
  const auto p = region.picture_from_square(0, 0);
  EXPECT_NEAR(p.x, 14, 1e-12);
  EXPECT_NEAR(p.y, 16, 1e-12);
}

TEST(LandmarkTracker, FindsTheEmbeddedFaceWithinMillimetres) {
  for (const double yaw : {0.0, 0.35, -0.35}) {
    const FacePicture picture = face_picture(size_px, height_m, yaw);
    LandmarkTracker tracker;
    const auto found = tracker.track(picture.bgr);
    ASSERT_TRUE(found) << yaw;
    EXPECT_TRUE(found->found_anew);
    EXPECT_EQ(found->faces_in_view, 1);
    EXPECT_GT(found->score, 0.9);
    const auto errors = errors_px(found->points_px, picture);
    EXPECT_LT(errors[errors.size() / 2], 3.5 * px_per_mm) << yaw;
    EXPECT_LT(errors[errors.size() * 9 / 10], 8 * px_per_mm) << yaw;
  }
}

TEST(LandmarkTracker, AMirroredPictureGivesMirroredPoints) {
  const FacePicture picture = face_picture(size_px, height_m, 0.2);
  cv::Mat mirrored;
  cv::flip(picture.bgr, mirrored, 1);
  LandmarkTracker tracker;
  const auto found = tracker.track(picture.bgr);
  tracker.reset();
  const auto turned = tracker.track(mirrored);
  ASSERT_TRUE(found && turned);
  for (const auto& [name, other] : {std::pair{33, 263}, {61, 291}, {4, 4}, {152, 152}}) {
    EXPECT_NEAR(found->points_px(name, 0), size_px - 1 - turned->points_px(other, 0), 5) << name;
    EXPECT_NEAR(found->points_px(name, 1), turned->points_px(other, 1), 5) << name;
  }
  // The nose is nearer than the eyes.
  EXPECT_LT(found->points_px(4, 2), found->points_px(33, 2) - 10);
}

TEST(LandmarkTracker, TheSecondLookMovesWhatItLooksAtAlone) {
  const FacePicture picture = face_picture(size_px, height_m, 0.2, 0.3);
  LandmarkTracker once({.lips_again = false}), lips, both({.eyes_again = true});
  const auto found = lips.track(picture.bgr);
  ASSERT_TRUE(found);
  const FacePoints a = once.look_at(picture.bgr, found->region).points_px,
                   b = lips.look_at(picture.bgr, found->region).points_px,
                   c = both.look_at(picture.bgr, found->region).points_px;
  for (const int nose_or_chin : {4, 1, 152, 234}) {
    EXPECT_EQ((a - b).row(nose_or_chin).norm(), 0) << nose_or_chin;
    EXPECT_EQ((a - c).row(nose_or_chin).norm(), 0) << nose_or_chin;
  }
  for (const int lip : {13, 14, 61, 291, 0, 17}) {
    EXPECT_GT((a - b).row(lip).norm(), 0) << lip;
    EXPECT_LT((a - b).row(lip).norm(), 5 * px_per_mm) << lip;
    EXPECT_EQ((b - c).row(lip).norm(), 0) << lip;
  }
  for (const int eye : {33, 133, 362, 263, 159, 386}) {
    EXPECT_EQ((a - b).row(eye).norm(), 0) << eye;
    EXPECT_GT((a - c).row(eye).norm(), 0) << eye;
    EXPECT_LT((a - c).row(eye).norm(), 5 * px_per_mm) << eye;
  }
}

TEST(LandmarkTracker, FollowsATurningHead) {
  LandmarkTracker tracker;
  for (int k = 0; k <= 16; ++k) {
    const FacePicture picture = face_picture(size_px, height_m, 0.03 * k, 0.06 * k);
    const auto found = tracker.track(picture.bgr);
    ASSERT_TRUE(found) << k;
    EXPECT_EQ(found->found_anew, k == 0);
    const auto errors = errors_px(found->points_px, picture);
    EXPECT_LT(errors[errors.size() / 2], 4 * px_per_mm) << k;
  }
}

TEST(LandmarkTracker, ALostFaceIsFoundAgain) {
  const FacePicture picture = face_picture(size_px, height_m);
  const cv::Mat black = cv::Mat::zeros(size_px, size_px, CV_8UC3);
  LandmarkTracker tracker;
  const auto first = tracker.track(picture.bgr);
  ASSERT_TRUE(first);
  for (int k = 0; k < 3; ++k) EXPECT_FALSE(tracker.track(black));
  cv::Mat moved = cv::Mat::zeros(size_px, size_px + 300, CV_8UC3);
  picture.bgr.copyTo(moved(cv::Rect(300, 0, size_px, size_px)));
  const auto again = tracker.track(moved);
  ASSERT_TRUE(again);
  EXPECT_TRUE(again->found_anew);
  EXPECT_NEAR(again->points_px(4, 0), first->points_px(4, 0) + 300, 3);
}

TEST(LandmarkTracker, OfTwoFacesTheLargerAndSaysSo) {
  const FacePicture large = face_picture(300, 0.28), little = face_picture(180, 0.28);
  cv::Mat both(300, 520, CV_8UC3, cv::Scalar(128, 120, 115));
  little.bgr.copyTo(both(cv::Rect(0, 60, 180, 180)));
  large.bgr.copyTo(both(cv::Rect(220, 0, 300, 300)));
  LandmarkTracker tracker;
  const auto found = tracker.track(both);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->faces_in_view, 2);
  EXPECT_GT(found->points_px(4, 0), 300);
}

TEST(LandmarkTracker, SmallFacesInLargePicturesAreFound) {
  const FacePicture little = face_picture(170, 0.28);
  cv::Mat picture(800, 1200, CV_8UC3, cv::Scalar(128, 120, 115));
  little.bgr.copyTo(picture(cv::Rect(900, 440, 170, 170)));
  LandmarkTracker tracker;
  const auto found = tracker.track(picture);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->points_px(4, 0), 900 + 85, 12);
  LandmarkTracker hasty({.finder = {.look_closer = false}});
  EXPECT_FALSE(hasty.track(picture));
}

TEST(LandmarkTracker, RefusesWhatIsNoColourPicture) {
  LandmarkTracker tracker;
  EXPECT_THROW(tracker.track({}), std::invalid_argument);
  EXPECT_THROW(tracker.track(cv::Mat(10, 10, CV_8UC1)), std::invalid_argument);
  EXPECT_THROW(tracker.look_at(cv::Mat(10, 10, CV_8UC3), {}), std::invalid_argument);
}

/// The first frames of a rendered recording: truth in pixels by its pinhole camera.
TEST(LandmarkTracker, OnARenderedRecording) {
  const auto folder = std::filesystem::path(HYPEREX_SHARED_DIR) / "data/rgbd/subject_A_talk";
  std::ifstream list(folder / "associations.txt"), truth(folder / "truth_landmarks68_camera_m.csv");
  if (!list || !truth) GTEST_SKIP() << folder << " is not here";
  std::string line;
  std::getline(truth, line);
  LandmarkTracker tracker;
  std::vector<double> errors;
  for (int frame = 0; frame < 20 && std::getline(list, line); ++frame) {
    std::istringstream words(line);
    std::string time, file;
    words >> time >> file;
    const auto found = tracker.track(cv::imread((folder / file).string()));
    ASSERT_TRUE(found) << frame;
    std::getline(truth, line);
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream numbers(line);
    double skipped, x, y, z;
    numbers >> skipped;
    for (int k = 0; k < 68; ++k) {
      numbers >> x >> y >> z;
      const Vec3 p =
          face::canonical_face().landmark("ibug68_" + std::to_string(k), found->points_px);
      if (k >= 17)
        errors.push_back(std::hypot(p.x() - (525 * x / z + 319.5), p.y() - (525 * y / z + 239.5)));
    }
  }
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 3.5);  // 2.6 over the whole recording; a pixel is 1.2 mm
}

}  // namespace
}  // namespace hyperex::tracking
