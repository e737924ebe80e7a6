// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/expression/blend_shapes.hpp"
#include "hyperex/io/csv.hpp"
#include "hyperex/tracking/output/live_link.hpp"
#include "hyperex/tracking/output/tracking_outputs.hpp"

namespace hyperex::tracking {
namespace {

/// The second of three frames is not valid; the last has no depth.
Tracking three_frames() {
  const expression::FaceModel& model = expression::canonical_model();
  Tracking tracking;
  tracking.neutral = Neutral{model.mesh.points, 1, {}, true};
  for (int k = 0; k < 3; ++k) {
    TrackedFrame frame;
    frame.index = std::size_t(2 * k);
    frame.time_s = 0.1 * k;
    frame.faces_in_view = k;
    frame.valid = k != 1;
    frame.fault = k == 1 ? "rgb/1.jpg: torn, \"half\"" : "";
    if (frame.valid) {
      frame.camera_from_head.translation() = Vec3(0.01, 0.02, 0.6);
      frame.weights = Eigen::VectorXd::Constant(Eigen::Index(model.animation_units.size()), 0.25);
      frame.vertices_m = model.mesh.points;
      frame.report = {.network_rms_px = 1.5,
                      .depth_rms_m = k == 0 ? 0.002 : 0,
                      .depth_share = k == 0 ? 0.9 : 0,
                      .photometric_share = 0.7};
    }
    tracking.frames.push_back(frame);
  }
  return tracking;
}

std::filesystem::path scratch(const std::string& name) {
  return std::filesystem::path(::testing::TempDir()) / name;
}

io::CsvTable read_with_faults(const std::filesystem::path& file) {
  return io::read_csv(file, [](const std::string& name, std::string_view) -> std::optional<double> {
    if (name == "fault") return 1;
    return std::nullopt;
  });
}

TEST(TrackingOutputs, PoseSaysWhatIsValidWhyNotAndHowWellItWasMet) {
  const auto file = scratch("m.pose.csv");
  write_pose_csv(file, three_frames());
  const io::CsvTable table = read_with_faults(file);
  ASSERT_EQ(table.values.rows(), 3);
  const auto cell = [&](int row, const char* name) {
    return table.values(row, table.column(name));
  };
  EXPECT_EQ(cell(0, "valid"), 1);
  EXPECT_EQ(cell(1, "valid"), 0);
  EXPECT_EQ(cell(0, "T23"), 0.6);
  EXPECT_EQ(cell(0, "T00"), 1);
  EXPECT_EQ(cell(0, "network_rms_px"), 1.5);
  EXPECT_DOUBLE_EQ(cell(0, "depth_rms_mm"), 2);
  EXPECT_TRUE(std::isnan(cell(2, "depth_rms_mm"))) << "no depth is not a perfect fit";
  EXPECT_EQ(cell(2, "depth_share"), 0);
  for (const char* name : {"T00", "network_rms_px", "depth_rms_mm", "network_score"})
    EXPECT_TRUE(std::isnan(cell(1, name))) << name;
  EXPECT_EQ(cell(1, "time_s"), 0.1);
  EXPECT_EQ(cell(1, "frame"), 2);
  EXPECT_EQ(cell(1, "faces_in_view"), 1);
  EXPECT_EQ(cell(1, "metric"), 1);
  EXPECT_EQ(cell(1, "fault"), 1);
  EXPECT_TRUE(std::isnan(cell(0, "fault")));
  EXPECT_THAT(read_file(file), testing::HasSubstr("rgb/1.jpg: torn; 'half'\n"));
}

TEST(TrackingOutputs, PoseSaysWhereLengthsRestOnAStatedDistance) {
  Tracking tracking = three_frames();
  tracking.neutral->metric = false;
  const auto file = scratch("n.pose.csv");
  write_pose_csv(file, tracking);
  const io::CsvTable table = read_with_faults(file);
  for (int row = 0; row < 3; ++row) EXPECT_EQ(table.values(row, table.column("metric")), 0);
}

TEST(TrackingOutputs, UnitsHaveTheirFacsNamesAndValidity) {
  const auto file = scratch("m.units.csv");
  write_units_csv(file, expression::canonical_model(), three_frames());
  const io::CsvTable table = io::read_csv(file);
  EXPECT_EQ(table.values(0, table.column("jawOpen [AU26+AU27]")), 0.25);
  EXPECT_EQ(table.values(0, table.column("mouthSmile_L [AU12]")), 0.25);
  EXPECT_TRUE(std::isnan(table.values(1, table.column("mouthSmile_L [AU12]"))));
  EXPECT_EQ(table.values(0, table.column("valid")), 1);
  EXPECT_EQ(table.values(1, table.column("valid")), 0);
}

/// Frames over `seconds` at 30 Hz; the weights of frame 5 are unknown.
Tracking talking(double seconds) {
  const expression::FaceModel& model = expression::canonical_model();
  Tracking tracking = three_frames();
  const TrackedFrame first = tracking.frames[0];
  tracking.frames.clear();
  for (int k = 0; k < int(30 * seconds); ++k) {
    TrackedFrame frame = first;
    frame.time_s = 12.5 + k / 30.0;
    frame.valid = k != 5;
    for (Eigen::Index u = 0; u < frame.weights.size(); ++u)
      frame.weights[u] =
          0.4 * std::sin(0.2 * k + double(u)) / model.animation_units[std::size_t(u)].arkit_scale;
    tracking.frames.push_back(frame);
  }
  return tracking;
}

TEST(LiveLink, IsReadBackAsTheWeightsThatWereTracked) {
  const expression::FaceModel& model = expression::canonical_model();
  const Tracking tracking = talking(3);
  const auto file = scratch("live.csv"), plain = scratch("live.arkit.csv");
  write_live_link_csv(file, model, tracking);
  write_arkit_csv(plain, model, tracking);
  const expression::BlendShapes read = expression::read_arkit(file);
  ASSERT_EQ(read.time_s.size(), tracking.frames.size() - 1) << "no row for a frame without a face";
  const io::CsvTable truth = io::read_csv(plain);
  ASSERT_EQ(read.names.size(), 52u);
  for (std::size_t k = 0; k < read.time_s.size(); ++k) {
    const auto row = Eigen::Index(k < 5 ? k : k + 1);
    EXPECT_NEAR(read.time_s[k], truth.values(row, 0) - 12.5, 1e-5);
    for (std::size_t c = 0; c < read.names.size(); ++c) {
      const auto column = truth.find(read.names[c]);
      EXPECT_NEAR(read.weights(Eigen::Index(k), Eigen::Index(c)),
                  column ? truth.values(row, *column) : 0, 1e-9)
          << read.names[c];
    }
  }
  EXPECT_GT(read.weights.maxCoeff(), 0.35);
}

TEST(LiveLink, CountsTimeAsTheAppDoes) {
  const auto file = scratch("codes.csv");
  Tracking tracking = talking(3);
  tracking.frames[1].time_s += 1e-3;
  tracking.frames.back().time_s = 12.5 + 3661 + 59.5 / 60;
  write_live_link_csv(file, expression::canonical_model(), tracking);
  const std::string text = read_file(file);
  EXPECT_THAT(text, testing::HasSubstr("\n00:00:00:00.000,61,"));
  EXPECT_THAT(text, testing::HasSubstr("\n00:00:00:02.060,61,"));
  EXPECT_THAT(text, testing::HasSubstr("\n01:01:01:59.500,61,"));
}

TEST(LiveLink, HasTheColumnsOfARealRecording) {
  const std::filesystem::path real =
      std::filesystem::path(HYPEREX_SHARED_DIR) / "data/real/livelink/range_of_motion.csv";
  if (!std::filesystem::exists(real)) GTEST_SKIP() << "no " << real;
  const std::string text = read_file(real);
  std::string header;
  for (const std::string& name : live_link_columns()) header += (header.empty() ? "" : ",") + name;
  EXPECT_EQ(text.substr(0, text.find_first_of("\r\n")), header);
  const expression::BlendShapes shapes = expression::read_arkit(real);
  EXPECT_EQ(shapes.names.size(), 52u);
  EXPECT_EQ(shapes.time_s.size(), 4030u);
  // Rows come at 30 Hz, the timecode counts 60ths.
  EXPECT_NEAR(shapes.time_s.back() / 4029, 1 / 30.0, 1e-3);
}

TEST(LiveLink, RefusesARecordingWithoutAFace) {
  Tracking tracking = talking(1);
  for (TrackedFrame& frame : tracking.frames) frame.valid = false;
  EXPECT_THROW(write_live_link_csv(scratch("none.csv"), expression::canonical_model(), tracking),
               InputError);
}

}  // namespace
}  // namespace hyperex::tracking
