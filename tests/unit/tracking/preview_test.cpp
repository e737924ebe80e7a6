// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/output/preview.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "hyperex/capture/video.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/tracking/output/preview_movie.hpp"
#include "support/side_letters.hpp"
#include "support/video.hpp"

namespace hyperex::tracking {
namespace {

constexpr capture::Intrinsics kCamera{250, 250, 159.5, 119.5, 320, 240};
constexpr int kScale = 3;  // 960 / 320

/// The canonical face at 0.5 m, facing the camera.
TrackedFrame face_frame(double time_s = 0) {
  const expression::FaceModel& model = expression::canonical_model();
  TrackedFrame frame;
  frame.time_s = time_s;
  frame.valid = true;
  frame.camera_from_head.linear() = Vec3(1, -1, -1).asDiagonal();
  frame.camera_from_head.translation() = Vec3(0, 0, 0.5);
  frame.weights = Eigen::VectorXd::Zero(Eigen::Index(model.animation_units.size()));
  frame.vertices_m = model.mesh.points;
  return frame;
}

TrackedFrame faulty_frame(double time_s = 0) {
  TrackedFrame frame;
  frame.time_s = time_s;
  frame.fault = "no face found";
  return frame;
}

cv::Mat grey(int level = 120) {
  return cv::Mat(kCamera.height_px, kCamera.width_px, CV_8UC3, cv::Scalar::all(level));
}

/// The number of pixels in a part of a drawn picture that differ from the recording's grey.
int drawn_on(const cv::Mat& picture, cv::Rect part, int level = 120) {
  int count = 0;
  for (int y = part.y; y < part.br().y; ++y)
    for (int x = part.x; x < part.br().x; ++x)
      count += cv::norm(picture.at<cv::Vec3b>(y, x), cv::Vec3b::all(uchar(level))) > 12;
  return count;
}

bool is_red(const cv::Vec3b& bgr) {
  return bgr[2] > 150 && bgr[0] < 80 && bgr[1] < 80;
}

TEST(Preview, DrawsTheMeshWhereTheFaceIsAndNowhereElse) {
  PreviewPainter painter(expression::canonical_model(), kCamera);
  const cv::Mat picture = painter.draw(face_frame(), grey());
  ASSERT_EQ(picture.cols, painter.width_px());
  ASSERT_EQ(picture.rows, painter.height_px());
  EXPECT_EQ(picture.cols % 16, 0);
  EXPECT_EQ(picture.rows % 16, 0);
  // 15.5 x 17.7 cm at about 0.45 m: some 86 x 98 px of the camera's picture.
  const cv::Rect face(kScale * 110, kScale * 60, kScale * 100, kScale * 120);
  EXPECT_GT(drawn_on(picture, face), 5000);
  EXPECT_EQ(drawn_on(picture, {0, 0, kScale * 90, 720}), 0);
  EXPECT_EQ(drawn_on(picture, {kScale * 240, 0, kScale * 80, 720}), 0);
  EXPECT_FALSE(is_red(picture.at<cv::Vec3b>(4, 4)));
}

TEST(Preview, TheSubjectsLeftIsWhereTheAxisSaysSo) {
  PreviewPainter painter(expression::canonical_model(), kCamera);
  const cv::Mat picture = painter.draw(face_frame(), grey());
  // Facing the camera, the subject's left is to the right in the picture: the x axis runs there, 9
  // cm or 45 px from the middle.
  const auto red_at = [&](double x_px) {
    const int x = int(kScale * (159.5 + x_px + 0.5)), y = int(kScale * 120);
    for (int dy = -2; dy <= 2; ++dy) {
      const auto c = picture.at<cv::Vec3b>(y + dy, x);
      if (c[2] > 200 && c[1] < 110 && c[0] < 110) return true;
    }
    return false;
  };
  EXPECT_TRUE(red_at(10));
  EXPECT_TRUE(red_at(40));
  EXPECT_FALSE(red_at(-10));
}

/// How often the letter is drawn in the picture's columns [from_x, to_x).
int letters_between(const cv::Mat& picture, int from_x, int to_x, const std::string& letter) {
  cv::Mat green;
  cv::extractChannel(picture.colRange(from_x, to_x), green, 1);
  return test::letters_in(green, letter);
}

TEST(Preview, LettersBesideTheFaceNameTheSubjectsSides) {
  PreviewPainter painter(expression::canonical_model(), kCamera);
  const int middle = 480;
  const cv::Mat front = painter.draw(face_frame(), grey());
  EXPECT_EQ(letters_between(front, 0, middle, "R"), 1);
  EXPECT_EQ(letters_between(front, middle, 960, "L"), 1);
  EXPECT_EQ(letters_between(front, 0, middle, "L"), 0);
  EXPECT_EQ(letters_between(front, middle, 960, "R"), 0);
  // Seen from behind, the subject's left is at the picture's left.
  TrackedFrame behind = face_frame();
  behind.camera_from_head.linear() = Vec3(-1, -1, 1).asDiagonal();
  const cv::Mat back = painter.draw(behind, grey());
  EXPECT_EQ(letters_between(back, 0, middle, "L"), 1);
  EXPECT_EQ(letters_between(back, middle, 960, "R"), 1);
  // A frame without a face has none.
  const cv::Mat none = painter.draw(faulty_frame(), grey());
  EXPECT_EQ(letters_between(none, 0, 960, "R") + letters_between(none, 0, 960, "L"), 0);
}

TEST(Preview, LettersOfAFaceAtTheEdgeStayInThePicture) {
  PreviewPainter painter(expression::canonical_model(), kCamera);
  TrackedFrame aside = face_frame();
  aside.camera_from_head.translation() = Vec3(-0.25, -0.1, 0.5);
  const cv::Mat picture = painter.draw(aside, grey());
  int light = 0;  // of the patch of 17 x 17 pixels under the R
  for (int y = 0; y < 720; ++y)
    for (int x = 0; x < 17; ++x) {
      const auto c = picture.at<cv::Vec3b>(y, x);
      light += c[0] > 230 && c[1] > 230 && c[2] > 230;
    }
  EXPECT_GT(light, 120);
  EXPECT_LE(light, 17 * 17);
}

TEST(Preview, WiresOfHiddenPartsAreLeftOut) {
  // Seen from behind no triangle faces the camera: landmarks and axes alone are drawn.
  PreviewPainter painter(expression::canonical_model(), kCamera);
  TrackedFrame behind = face_frame();
  behind.camera_from_head.linear() = Vec3(-1, -1, 1).asDiagonal();
  const cv::Rect all(0, 0, 960, 720);
  EXPECT_LT(drawn_on(painter.draw(behind, grey()), all),
            drawn_on(painter.draw(face_frame(), grey()), all) / 3);
}

TEST(Preview, AFrameThatIsNotValidHasARedBannerAndNoFace) {
  PreviewPainter painter(expression::canonical_model(), kCamera);
  const cv::Mat picture = painter.draw(faulty_frame(), grey());
  EXPECT_TRUE(is_red(picture.at<cv::Vec3b>(4, 4)));
  EXPECT_EQ(drawn_on(picture, {0, 60, 960, 660}), 0);
  // Without a picture too, and with words longer than the picture is wide.
  TrackedFrame torn = faulty_frame();
  torn.fault = std::string(500, 'x');
  EXPECT_TRUE(is_red(painter.draw(torn, {}).at<cv::Vec3b>(4, 4)));
}

TEST(Preview, BarsAreAsLongAsUnitsAreStrong) {
  PreviewPainter painter(expression::canonical_model(), kCamera);
  const auto orange = [&](double weight) {
    TrackedFrame frame = face_frame();
    frame.weights[expression::canonical_model().jaw_drop] = weight;
    const cv::Mat picture = painter.draw(frame, grey());
    int count = 0;
    for (int y = 0; y < 720; ++y)
      for (int x = 960; x < picture.cols; ++x) {
        const auto c = picture.at<cv::Vec3b>(y, x);
        count += c[2] > 230 && c[1] > 140 && c[1] < 200 && c[0] < 80;
      }
    return count;
  };
  EXPECT_EQ(orange(0), 0);
  EXPECT_NEAR(orange(0.8), 2 * orange(0.4), 12);
}

TEST(FrameRate, IsTheMiddleStepOfTimesThatRise) {
  EXPECT_EQ(frame_rate_hz({}), 30);
  EXPECT_EQ(frame_rate_hz({1, 1, 1}), 30);
  EXPECT_EQ(frame_rate_hz({0, 0.0333332, 0.066667, 0.1}), 30);
  EXPECT_EQ(frame_rate_hz({0, 0.04, 0.08, 0.5, 0.54, 0.4, 0.44}), 25);
  EXPECT_EQ(frame_rate_hz({0, 1e-6, 2e-6}), 120);
}

TEST(PreviewMovie, KeepsTheRecordingsTime) {
  SKIP_WITHOUT_VIDEO();
  const auto file = std::filesystem::path(::testing::TempDir()) / "preview.mp4";
  PreviewMovie movie(file, expression::canonical_model(), kCamera);
  // At 10 Hz, with 5 frames missing after 0.9 s and one whose time stands still.
  for (int k = 0; k < 10; ++k) movie.add(face_frame(0.1 * k), grey());
  for (int k = 15; k < 20; ++k) movie.add(face_frame(0.1 * k), grey(200));
  movie.add(faulty_frame(1.9), grey(200));
  movie.finish();
  const auto source = capture::open_video(file, {});
  EXPECT_EQ(source->frame_count(), 21u);
  std::vector<double> level;
  while (const auto frame = source->next()) {
    EXPECT_NEAR(frame->time_s, 0.1 * double(level.size()), 1e-3);
    level.push_back(cv::mean(frame->colour(cv::Rect(10, 400, 200, 200)))[1]);
  }
  ASSERT_EQ(level.size(), 21u);
  for (std::size_t k = 0; k < level.size(); ++k) EXPECT_NEAR(level[k], k < 15 ? 120 : 200, 4) << k;
}

TEST(PreviewMovie, AShortRecordingIsWrittenTooAndNoneWithoutFrames) {
  SKIP_WITHOUT_VIDEO();
  const auto folder = std::filesystem::path(::testing::TempDir());
  PreviewMovie movie(folder / "short.mp4", expression::canonical_model(), kCamera);
  movie.add(face_frame(), grey());
  movie.finish();
  EXPECT_EQ(capture::open_video(folder / "short.mp4", {})->frame_count(), 1u);
  PreviewMovie none(folder / "none.mp4", expression::canonical_model(), kCamera);
  none.finish();
  EXPECT_FALSE(std::filesystem::exists(folder / "none.mp4"));
  EXPECT_THROW(PreviewMovie(folder / "x.avi", expression::canonical_model(), kCamera), InputError);
}

}  // namespace
}  // namespace hyperex::tracking
