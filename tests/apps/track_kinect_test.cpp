// SPDX-License-Identifier: GPL-3.0-or-later
// `hyperex track --device kinect` without a Kinect: libfreenect's fakenect replaces the driver and
// replays a face as a Kinect would record it.
#include <gmock/gmock.h>

#include <cmath>
#include <sstream>

#include "apps/program.hpp"
#include "hyperex/capture/kinect_depth.hpp"
#include "hyperex/capture/tum_folder.hpp"
#include "support/fakenect_recording.hpp"

namespace hyperex {
namespace {
using testing::HasSubstr;
namespace fs = std::filesystem;

/// The raw values of the depth camera, beside the colour camera, for a depth picture registered to
/// colour.
cv::Mat raw_of(const cv::Mat& depth_m) {
  using K = capture::NominalKinect;
  constexpr double colour_f_px = 525;
  cv::Mat raw(480, 640, CV_16UC1, cv::Scalar(2047));
  for (int v = 0; v < raw.rows; ++v)
    for (int u = 0; u < raw.cols; ++u) {
      double z = 0.6;
      for (int i = 0; i < 5 && z > 0; ++i) {  // where the ray meets the surface
        const long x =
            std::lround(colour_f_px * ((u - 319.5) / K::depth_f_px + K::baseline_m / z) + 319.5);
        const long y = std::lround(colour_f_px * (v - 239.5) / K::depth_f_px + 239.5);
        const bool inside = x >= 0 && x < 640 && y >= 0 && y < 480;
        z = inside ? depth_m.at<float>(int(y), int(x)) : 0;
      }
      if (z <= 0) continue;
      int low = 0, high = 1090;  // raw values rise with the distance
      while (low < high) {
        const int middle = (low + high) / 2;
        if (capture::kinect_depth_m(middle) < z)
          low = middle + 1;
        else
          high = middle;
      }
      raw.at<ushort>(v, u) = static_cast<ushort>(low);
    }
  return raw;
}

/// The distance of the head (T23) in each row of a .pose.csv.
std::vector<double> distances_m(const fs::path& pose) {
  std::vector<double> distances;
  std::istringstream text(read_file(pose));
  std::string line;
  std::getline(text, line);
  while (std::getline(text, line)) {
    std::istringstream cells(line);
    std::string cell;
    for (int c = 0; c < 14; ++c) std::getline(cells, cell, ',');  // time_s, valid, T00 ... T23
    distances.push_back(std::stod(cell));
  }
  return distances;
}

class TrackKinect : public ProgramTest {};

TEST_F(TrackKinect, IsFollowedLive) {
  const fs::path folder = fs::path(HYPEREX_SHARED_DIR) / "data/rgbd/subject_A_still";
  if (!fs::exists(folder)) GTEST_SKIP() << "no " << folder;
  {
    test::FakenectRecording recording(in("kinect"));
    const auto source = capture::open_tum_folder(folder);
    while (const auto frame = source->next()) {
      const auto ticks = static_cast<std::uint32_t>(std::lround(60e6 * frame->time_s));
      recording.add_tilt(100 + frame->time_s, ticks);
      recording.add_colour(100 + frame->time_s + 0.001, ticks, frame->colour);
      recording.add_depth(100 + frame->time_s + 0.002, ticks, raw_of(frame->depth_m));
    }
  }
  const Outcome live =
      call("track --device kinect --seconds 1.2 --out live.csv",
           "export LD_LIBRARY_PATH=" FAKENECT_FOLDER " FAKENECT_PATH=kinect FAKENECT_LOOP=0");
  ASSERT_EQ(live.status, 0) << live.err;
  EXPECT_THAT(live.err, testing::AllOf(HasSubstr("live: "), HasSubstr("nominal calibration")));
  const Outcome recorded = call("track " + folder.string() + " --out recorded.csv");
  ASSERT_EQ(recorded.status, 0) << recorded.err;
  const auto seen = distances_m(in("live.pose.csv")), truth = distances_m(in("recorded.pose.csv"));
  ASSERT_GT(seen.size(), 5u);
  for (const double distance_m : seen) EXPECT_NEAR(distance_m, truth[0], 0.01);
}

}  // namespace
}  // namespace hyperex
