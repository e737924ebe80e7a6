// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/read_motion.hpp"

#include <chrono>
#include <fstream>

#include "hyperex/io/trc.hpp"
#include "support/test_file.hpp"
#include "unit/motion/motions.hpp"

namespace hyperex::motion {
namespace {
namespace fs = std::filesystem;
using io::LengthUnit;
using testing::expect_refused;
using testing::nan;

class ReadMotion : public ::testing::Test {
 protected:
  fs::path path(const std::string& name) const { return folder_ / name; }
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
    return path(name);
  }
  const TestFolder folder_;
};

TEST_F(ReadMotion, WrittenMotionComesBack) {
  Motion motion =
      testing::sampled(5, 1 / 30.0, {"ibug68_48", "cheilion_L", "far"},
                       [](double t, int p, int axis) { return 0.1 * t + 0.05 * p + axis * 0.01; });
  motion.positions[2].row(1).setConstant(nan);
  write_motion_csv(path("m.csv"), motion);
  const Motion read = read_motion(path("m.csv"));
  EXPECT_EQ(read.names, motion.names);
  EXPECT_EQ(read.time_s, motion.time_s);
  EXPECT_THAT(read.unit_note, ::testing::HasSubstr("mm (as the columns say)"));
  EXPECT_TRUE(std::isnan(read.positions[2](1, 0)));
  for (const int p : {0, 2})
    for (std::size_t k = 0; k < 5; ++k)
      EXPECT_LT((read.positions[k].row(p) - motion.positions[k].row(p)).norm(), 1e-15);
}

TEST_F(ReadMotion, UnitOfColumnsThenStatedThenFileNameThenGuess) {
  const std::string two = ",a_x,a_y,a_z,b_x,b_y,b_z\n0,0,0,0,150,0,0\n";
  EXPECT_NEAR(read_motion(write("m.csv", "time_s" + two)).positions[0](1, 0), 0.15, 1e-12);
  EXPECT_THAT(read_motion(path("m.csv")).unit_note, ::testing::HasSubstr("mm (guessed"));
  EXPECT_NEAR(read_motion(path("m.csv"), LengthUnit::centimetre).positions[0](1, 0), 1.5, 1e-12);
  EXPECT_NEAR(read_motion(write("m_cm.csv", "time" + two)).positions[0](1, 0), 1.5, 1e-12);
  EXPECT_NEAR(read_motion(path("m_cm.csv"), LengthUnit::millimetre).positions[0](1, 0), 0.15,
              1e-12);
  const fs::path own = write("own_m.csv",
                             "timestamp,a_x_cm,a_y_cm,a_z_cm,b_x_mm,b_y_mm,b_z_mm\n"
                             "0,1,2,3,150,0,0\n");
  EXPECT_NEAR(read_motion(own).positions[0](0, 2), 0.03, 1e-12);
  EXPECT_NEAR(read_motion(own).positions[0](1, 0), 0.15, 1e-12);
  expect_refused([&] { read_motion(own, LengthUnit::metre); }, {"point a", "in cm", "be m"});
  for (const double metres : {0.15, 15.0, 150.0}) {
    const fs::path file = write(
        "g.csv", "time_s,a_x,a_y,a_z,b_x,b_y,b_z\n0,0,0,0," + std::to_string(metres) + ",0,0\n");
    EXPECT_NEAR(read_motion(file).positions[0](1, 0), 0.15, 1e-9);
  }
  expect_refused(
      [&] { read_motion(write("g.csv", "time_s,a_x,a_y,a_z,b_x,b_y,b_z\n0,0,0,0,1.5,0,0\n")); },
      {"cannot be guessed", "1.5"});
}

TEST_F(ReadMotion, AnImplausibleSpanIsRefused) {
  const std::string three = "time_s,a_x,a_y,a_z,b_x,b_y,b_z,c_x,c_y,c_z\n0,0,0,0,150,0,0,0,90,0\n";
  expect_refused([&] { read_motion(write("t.csv", three), LengthUnit::metre); },
                 {"large", "as stated"});
  expect_refused([&] { read_motion(write("t_m.csv", three)); }, {"large", "file's name"});
}

TEST_F(ReadMotion, NumberedColumnsAreTheUsualAnnotationWhenThereAre68) {
  std::string header = "frame,time_s", row = "0,0.5";
  for (int p = 0; p < 68; ++p)
    for (const char axis : {'x', 'y', 'z'}) {
      header += "," + std::string(1, axis) + std::to_string(p);
      row += "," + std::to_string(p * 2 + (axis - 'x'));
    }
  const Motion motion = read_motion(write("f_mm.csv", header + "\n" + row + "\n"));
  EXPECT_EQ(motion.names.front(), "ibug68_0");
  EXPECT_EQ(motion.names.back(), "ibug68_67");
  EXPECT_NEAR(motion.positions[0](67, 2), 0.136, 1e-12);
  EXPECT_EQ(read_motion(write("two.csv", "time_s,x0,y0,z0,x1,y1,z1\n0,0,0,0,100,0,0\n")).names,
            (std::vector<std::string>{"point_0", "point_1"}));
}

TEST_F(ReadMotion, FaultsAreNamedInOneLine) {
  const std::string head = "time_s,a_x_mm,a_y_mm,a_z_mm\n";
  expect_refused([&] { read_motion(write("f.csv", head)); }, {"f.csv", "no samples"});
  expect_refused([&] { read_motion(write("f.csv", head + "0,1,1,1\n0.1,1,1,1\n0.1,1,1,1\n")); },
                 {"f.csv:4", "time_s = 0.1", "after"});
  expect_refused([&] { read_motion(write("f.csv", head + "nan,1,1,1\n")); }, {"f.csv:2", "time_s"});
  expect_refused([&] { read_motion(write("f.csv", "time_s,a_x,a_y\n0,1,1\n")); }, {"point a", "z"});
  expect_refused([&] { read_motion(write("f.csv", "time_s,a_x,a_x_mm,a_y\n0,1,1,1\n")); },
                 {"a_x_mm"});
  expect_refused([&] { read_motion(write("f.csv", "time_s,a_x_mm,a_y_cm,a_z_mm\n0,1,1,1\n")); },
                 {"a_y_cm", "one unit"});
  expect_refused([&] { read_motion(write("f.csv", "time_s\n0\n")); }, {"no points"});
  expect_refused([&] { read_motion(write("f.csv", "a_x,a_y,a_z\n0,1,2\n")); }, {"column of time"});
  // Tables of results, with words and of numbers.
  expect_refused([&] { read_motion(write("f.csv", "point,excursion_L_mm\nalare,1\n")); },
                 {"this is no recording: it has no column of time"});
  expect_refused([&] { read_motion(write("f.csv", "xi_L,xi_R\n1,1\n")); },
                 {"this is no recording: it has no column of time"});
  expect_refused([&] { read_motion(write("f.csv", "time_s,time,a_x,a_y,a_z\n0,0,0,1,2\n")); },
                 {"one column of time"});
  expect_refused([&] { read_motion(write("f.csv", "time_s,smile\n0,1\n")); }, {"smile"});
  expect_refused([&] { read_motion(write("f.bvh", "HIERARCHY")); }, {".bvh"});
  expect_refused([&] { read_motion(path("none.csv")); }, {"none.csv"});
  expect_refused([&] { read_motion(path("Walk.C3D")); }, {"Walk.C3D", "export", "TRC"});
}

TEST_F(ReadMotion, ReadsTrc) {
  io::TrcFile recording;
  recording.data_rate_hz = 30;
  recording.names = {"chin", "nose"};
  recording.time_s = {0, 1 / 30.0};
  Points sample(2, 3);
  sample << 0, -0.08, 0.1, 0, 0, 0.13;
  recording.positions = {sample, sample};
  io::write_trc(path("r.trc"), recording);
  const Motion motion = read_motion(path("r.trc"));
  EXPECT_EQ(motion.names, recording.names);
  EXPECT_LT((motion.positions[1] - sample).norm(), 1e-9);
  EXPECT_THAT(motion.unit_note, ::testing::HasSubstr("mm (as the file says)"));
  expect_refused([&] { read_motion(path("r.trc"), LengthUnit::metre); }, {"mm", "stated"});
}

TEST_F(ReadMotion, ReadsTheRecordings) {
  const auto folder = testing::recording("subject_A_mouth_open");
  if (folder.empty()) GTEST_SKIP() << "the shared recordings are not here";
  const Motion motion = read_motion(folder / "truth_landmarks68_camera_m.csv");
  EXPECT_EQ(motion.names.size(), 68u);
  EXPECT_EQ(motion.time_s.size(), 81u);
  EXPECT_NEAR(motion.positions[0](0, 0), -0.06984792, 1e-9);
  EXPECT_THAT(motion.unit_note, ::testing::HasSubstr("m (as the file's name ends)"));
}

TEST_F(ReadMotion, TakesTimeInProportionToItsColumns) {
  constexpr int points = 100000;
  std::string names = "time_s", rest = "0", end = "1";
  for (int p = 0; p < points; ++p)
    for (const char* axis : {"_x_mm", "_y_mm", "_z_mm"}) {
      names += ",p" + std::to_string(p) + axis;
      rest += "," + std::to_string(p % 100);
      end += "," + std::to_string(p % 100);
    }
  const auto file = write("wide.csv", names + "\n" + rest + "\n" + end + "\n");
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(read_motion(file).names.size(), std::size_t(points));
  // Comparing each name with every other takes more than a minute; this, half a second.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

}  // namespace
}  // namespace hyperex::motion
