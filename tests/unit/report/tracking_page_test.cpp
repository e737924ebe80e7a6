// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/tracking_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/report/tracking_channels.hpp"
#include "support/test_file.hpp"
#include "unit/report/made_up_tracking.hpp"
#include "unit/report/page_reader.hpp"

namespace hyperex::report {
namespace {

using expression::canonical_model;
using nlohmann::json;
using testing::made_up_tracking;
using tracking::TrackedFrame;

constexpr double kRadians = std::numbers::pi / 180;

std::string written(const tracking::Tracking& tracking, const std::string& recording = "r") {
  const auto file = test_file("tracking_page_test.html");
  write_tracking_page(file, {canonical_model(), tracking, recording, 92, {"a note"}});
  return read_file(file);
}

/// A page's data, by channel; NaN where there is no number.
struct PageData {
  json manifest;
  std::vector<std::uint8_t> bytes;

  explicit PageData(const std::string& page)
      : manifest(json::parse(testing::element(page, "hyperex-manifest"))),
        bytes(testing::from_base64(testing::element(page, "hyperex-binary"))) {}

  bool has(const std::string& group, const std::string& name) const {
    return find(group, name) != nullptr;
  }
  double at(const std::string& group, const std::string& name, std::size_t frame) const {
    const json* channel = find(group, name);
    if (!channel) throw std::logic_error("no channel " + group + " " + name);
    const auto raw = testing::stretch<std::int16_t>(bytes, channel->at("values")).at(frame);
    return raw == INT16_MIN ? NAN : raw * channel->at("step").get<double>();
  }

 private:
  const json* find(const std::string& group, const std::string& name) const {
    for (const json& channel : manifest.at("channels"))
      if (channel.at("group") == group && channel.at("name") == name) return &channel;
    return nullptr;
  }
};

Eigen::Isometry3d pose_shown(const PageData& page, std::size_t k) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = (Eigen::AngleAxisd(page.at("turn", "yaw", k) * kRadians, Vec3::UnitY()) *
                   Eigen::AngleAxisd(-page.at("turn", "pitch", k) * kRadians, Vec3::UnitX()) *
                   Eigen::AngleAxisd(-page.at("turn", "roll", k) * kRadians, Vec3::UnitZ()))
                      .toRotationMatrix();
  pose.translation() = 1e-3 * Vec3(page.at("shift", "left", k), page.at("shift", "up", k),
                                   page.at("shift", "forward", k));
  return pose;
}

TEST(TrackingPage, ShowsPoseUnitsAndResidualsOfTheTracking) {
  const auto tracking = made_up_tracking(90);
  const PageData page(written(tracking));
  ASSERT_EQ(page.manifest.at("time_s").size(), 90u);
  const auto& units = canonical_model().animation_units;
  const Eigen::Isometry3d first = tracking.frames[0].camera_from_head;
  for (std::size_t k = 0; k < 90; ++k) {
    const TrackedFrame& frame = tracking.frames[k];
    EXPECT_NEAR(page.manifest["time_s"][k].get<double>(), frame.time_s - 5, 6e-7);
    if (!frame.valid) {
      for (const json& channel : page.manifest["channels"])
        EXPECT_TRUE(std::isnan(page.at(channel["group"], channel["name"], k)));
      continue;
    }
    const Eigen::Isometry3d off = (first * pose_shown(page, k)).inverse() * frame.camera_from_head;
    EXPECT_LT(Eigen::AngleAxisd(off.linear()).angle(), 0.01 * kRadians);
    EXPECT_LT(off.translation().norm(), 1e-5);
    for (std::size_t u = 0; u < units.size(); ++u)
      EXPECT_NEAR(page.at("unit", units[u].name, k), frame.weights[Eigen::Index(u)], 5.01e-4);
    EXPECT_NEAR(page.at("residual", "network", k), frame.report.network_rms_px, 5.01e-3);
    EXPECT_NEAR(page.at("residual", "depth", k), 1e3 * frame.report.depth_rms_m, 5.01e-3);
    EXPECT_NEAR(page.at("residual", "depth seen", k), 100 * frame.report.depth_share, 0.0501);
  }
}

TEST(TrackingPage, MeasuresDistancesOnTheFaceInItsFrame) {
  const auto tracking = made_up_tracking(90);
  const PageData page(written(tracking));
  // Vertices of the canonical face: lips 13, 14; corners 61 (R), 291 (L); lids by pairs.
  const Points& rest = canonical_model().mesh.points;
  for (const std::size_t k : {0u, 20u, 36u, 75u}) {
    const Points& p = tracking.frames[k].vertices_m;
    const auto mm = [&](int a, int b) { return 1e3 * (p.row(a) - p.row(b)).norm(); };
    EXPECT_NEAR(page.at("distance", "mouth opening", k), mm(13, 14), 5.01e-3);
    EXPECT_NEAR(page.at("distance", "mouth width", k), mm(61, 291), 5.01e-3);
    EXPECT_NEAR(page.at("distance", "mouth corner's travel L", k),
                1e3 * (p.row(291) - rest.row(291)).norm(), 5.01e-3);
    EXPECT_NEAR(page.at("distance", "mouth corner's travel R", k),
                1e3 * (p.row(61) - rest.row(61)).norm(), 5.01e-3);
    EXPECT_NEAR(page.at("distance", "eye opening R", k), (mm(160, 144) + mm(158, 153)) / 2,
                5.01e-3);
    EXPECT_NEAR(page.at("distance", "eye opening L", k), (mm(385, 380) + mm(387, 373)) / 2,
                5.01e-3);
  }
  EXPECT_GT(page.at("distance", "mouth opening", 36), 15);
  EXPECT_GT(page.at("distance", "mouth corner's travel L", 75),
            page.at("distance", "mouth corner's travel R", 75) + 1);
}

TEST(TrackingPage, SignsAreTheSubjectsOwn) {
  const auto turned = [](double deg, const Vec3& axis) {
    return head_turn(Eigen::AngleAxisd(deg * kRadians, axis).toRotationMatrix());
  };
  // Where the face looks (+z) and where its top (+y) goes.
  const Eigen::AngleAxisd to_left(10 * kRadians, Vec3::UnitY());
  ASSERT_GT((to_left * Vec3::UnitZ()).x(), 0);
  EXPECT_NEAR(turned(10, Vec3::UnitY()).yaw_deg, 10, 1e-9);
  const Eigen::AngleAxisd up(-10 * kRadians, Vec3::UnitX());
  ASSERT_GT((up * Vec3::UnitZ()).y(), 0);
  EXPECT_NEAR(turned(-10, Vec3::UnitX()).pitch_deg, 10, 1e-9);
  const Eigen::AngleAxisd tilt(-10 * kRadians, Vec3::UnitZ());
  ASSERT_GT((tilt * Vec3::UnitY()).x(), 0);
  EXPECT_NEAR(turned(-10, Vec3::UnitZ()).roll_deg, 10, 1e-9);
  EXPECT_NEAR(turned(170, Vec3::UnitY()).yaw_deg, 170, 1e-9);
}

TEST(TrackingPage, TellsWhichFramesAreNotValidAndWhy) {
  const PageData page(written(made_up_tracking(90)));
  const json& faults = page.manifest.at("faults");
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_EQ(faults[0], json({{"first", 40}, {"last", 49}, {"fault", "no face found"}}));
  EXPECT_EQ(faults[1], json({{"first", 60}, {"last", 60}, {"fault", "rgb/60.jpg: torn"}}));
  EXPECT_EQ(page.manifest.at("valid"), 79);
  EXPECT_EQ(page.manifest.at("reference"), 0);
}

TEST(TrackingPage, LeavesOutFramesWhoseTimeDoesNotRise) {
  auto tracking = made_up_tracking(60);
  tracking.frames[10].time_s = tracking.frames[9].time_s;
  tracking.frames[44].time_s = 1000;  // not valid, and ahead of all that follow
  const TrackingCurves curves = tracking_curves(canonical_model(), tracking);
  EXPECT_THAT(curves.frames, ::testing::SizeIs(58));
  EXPECT_THAT(curves.frames, ::testing::Not(::testing::Contains(10u)));
  EXPECT_THAT(curves.frames, ::testing::Not(::testing::Contains(44u)));
  EXPECT_TRUE(std::is_sorted(curves.time_s.begin(), curves.time_s.end(), std::less_equal<>()));
  const PageData page(written(tracking));
  EXPECT_EQ(page.manifest.at("frames"), 60);
  EXPECT_NEAR(page.at("residual", "network", 10), tracking.frames[11].report.network_rms_px,
              5.01e-3);
}

TEST(TrackingPage, SaysWhatLengthsRestOn) {
  const PageData metric(written(made_up_tracking(70), "recordings/talk/"));
  EXPECT_EQ(metric.manifest.at("metric"), true);
  EXPECT_EQ(metric.manifest.at("recording"), "talk");
  const PageData scaled(written(made_up_tracking(70, false)));
  EXPECT_EQ(scaled.manifest.at("metric"), false);
  EXPECT_EQ(scaled.manifest.at("eye_distance_mm"), 92);
  EXPECT_TRUE(std::isnan(scaled.at("residual", "depth", 5)));
  EXPECT_TRUE(std::isnan(scaled.at("residual", "skin matched", 0)));
  EXPECT_FALSE(std::isnan(scaled.at("residual", "network", 5)));
}

TEST(TrackingPage, LargeNumbersCoarsenTheirOwnCurveAlone) {
  auto tracking = made_up_tracking(30);
  tracking.frames[29].camera_from_head.translation().z() += 2;  // metres
  const PageData page(written(tracking));
  const Eigen::Isometry3d moved =
      tracking.frames[0].camera_from_head.inverse() * tracking.frames[29].camera_from_head;
  EXPECT_NEAR(page.at("shift", "forward", 29), 1e3 * moved.translation().z(), 0.0501);
  EXPECT_NEAR(page.at("residual", "network", 7), tracking.frames[7].report.network_rms_px, 5.01e-3);
}

TEST(TrackingPage, AMinuteStaysUnderAMegabyteAndAHalf) {
  EXPECT_LT(written(made_up_tracking(1800)).size(), 1'500'000u);
}

TEST(TrackingPage, WithoutAValidFrameThereIsStillAPage) {
  auto tracking = made_up_tracking(60);
  for (auto& frame : tracking.frames) frame.valid = false;
  const PageData page(written(tracking));
  EXPECT_EQ(page.manifest.at("reference"), -1);
  EXPECT_TRUE(std::isnan(page.at("turn", "yaw", 0)));
}

TEST(TrackingPage, RefusesWhatDoesNotBelongTogetherAndUnwritablePlaces) {
  auto tracking = made_up_tracking(5);
  EXPECT_THROW(write_tracking_page("/nowhere/t.html", {canonical_model(), tracking, "r", 92, {}}),
               InputError);
  tracking.frames[2].weights.resize(3);
  EXPECT_THROW(written(tracking), std::invalid_argument);
  tracking = made_up_tracking(5);
  tracking.neutral.reset();
  EXPECT_THROW(written(tracking), std::invalid_argument);
}

TEST(TrackingPage, TextOfTheRecordingCannotEndTheElement) {
  auto tracking = made_up_tracking(60);
  tracking.frames[45].fault = "</script><b>";
  const std::string page = written(tracking, "x</script><b>y");
  EXPECT_EQ(page.find("</script><b>"), std::string::npos);
  EXPECT_EQ(PageData(page).manifest.at("faults")[1].at("fault"), "</script><b>");
}

}  // namespace
}  // namespace hyperex::report
