// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/io/trc.hpp"

#include <cmath>
#include <limits>

#include "unit/io/io_testing.hpp"

namespace hyperex::io {
namespace {
using testing::expect_refused;
using Trc = testing::FileTest;

TrcFile recording() {
  TrcFile trc;
  trc.data_rate_hz = 120;
  trc.names = {"lip upper", "chin"};
  for (int f = 0; f < 4; ++f) {
    trc.time_s.push_back(f / 120.);
    Points points(2, 3);
    points << 0.01 * f, 1.0 / 3, -0.2, 1e-6 * f, 0, 1.5;
    if (f == 2) points.row(1).setConstant(std::numeric_limits<double>::quiet_NaN());
    trc.positions.push_back(points);
  }
  return trc;
}

TEST_F(Trc, RoundTripInEachUnit) {
  TrcFile trc = recording();
  for (const LengthUnit unit :
       {LengthUnit::millimetre, LengthUnit::centimetre, LengthUnit::metre}) {
    trc.unit = unit;
    write_trc(path("m.trc"), trc);
    const TrcFile read = read_trc(path("m.trc"));
    EXPECT_EQ(read.unit, unit);
    EXPECT_EQ(read.names, trc.names);
    EXPECT_EQ(read.data_rate_hz, 120);
    ASSERT_EQ(read.time_s.size(), 4u);
    for (int f = 0; f < 4; ++f) {
      EXPECT_NEAR(read.time_s[f], trc.time_s[f], 1e-10);
      for (int m = 0; m < 2; ++m) {
        if (f == 2 && m == 1) {
          EXPECT_TRUE(read.positions[f].row(m).array().isNaN().all());
        } else {
          EXPECT_LT((read.positions[f].row(m) - trc.positions[f].row(m)).norm(), 1e-9);
        }
      }
    }
  }
}

TEST_F(Trc, APdfIsNamed) {
  const auto file = write("m.trc", "%PDF-1.4\n");
  expect_refused(file, "is a PDF, not a table of text", [&] { read_trc(file); });
}

const std::string head =
    "PathFileType\t4\t(X/Y/Z)\tface.trc\r\n"
    "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\t"
    "OrigNumFrames\r\n60\t60\t2\t2\tmm\t60\t1\t2\r\n"
    "Frame#\tTime\tA\t\t\tB\t\t\t\r\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\t\r\n\r\n";

TEST_F(Trc, EmptyCellsAndThoseCutOffALineAreLostMarkers) {
  const TrcFile read =
      read_trc(write("m.trc", head + "1\t0.0\t\t\t\t4\t5\t6\t\r\n2\t0.0167\t1\t2\t3\r\n"));
  EXPECT_TRUE(read.positions[0].row(0).array().isNaN().all());
  EXPECT_NEAR(read.positions[0](1, 2), 0.006, 1e-15);
  EXPECT_NEAR(read.positions[1](0, 0), 0.001, 1e-15);
  EXPECT_TRUE(read.positions[1].row(1).array().isNaN().all());
}

TEST_F(Trc, RefusesEachFaultWithOneLine) {
  const std::string one = "1\t0\t1\t2\t3\t4\t5\t6\n", two = "2\t0.5\t1\t2\t3\t4\t5\t6\n";
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = head + one + two;
    return text.replace(text.find(from), from.size(), to);
  };
  const std::vector<std::pair<std::string, std::string>> faults = {
      {"", "is torn"},
      {"hello\n", "as a TRC file begins"},
      {with("60\t60\t2\t2\tmm", "60\t60\t2\t2\tinch"), "Units = inch: expected mm, cm or m"},
      {with("60\t60\t2\t2\tmm", "0\t60\t2\t2\tmm"), "DataRate = 0: expected a number above 0"},
      {with("60\t60\t2\t2\tmm", "60\t60\t-2\t2\tmm"), "NumFrames = -2"},
      {with("60\t60\t2\t2\tmm", "60\t60\t2\t3\tmm"), "NumMarkers = 3: expected 2"},
      {with("60\t60\t2\t2\tmm", "60\t60\t1000000000000\t2\tmm"), "NumFrames is 1000000000000"},
      {with("CameraRate\tNumFrames", "CameraRate\tFrames"), "NumFrames: expected this key"},
      {with("\tB\t", "\tA\t"), "each marker's name once"},
      {head + one, "NumFrames is 2, but 1 frames follow"},
      {head + one + two + "3\t1\t1\t2\t3\t4\t5\t6\n", "NumFrames is 2, but 3 frames follow"},
      {head + one + "2\t0.5\t1\t2\t3\t4", "6 cells: expected 8"},
      {head + one + "2\t0.5\t1\t2\t3", "5 cells: expected 8"},
      {head + one + "2\t0.5\t1\t2\t3\t4\t5\tsix\n", "B = six: expected a finite number"},
      {head + one + "2\t0.5\t1\t2\t3\t4\t\t6\n", "B: expected all three coordinates or none"},
      {head + one + "2\t0\t1\t2\t3\t4\t5\t6\n", "more than 0 s"},
      {head + one + "2\t\t1\t2\t3\t4\t5\t6\n", "Time: expected a number"},
  };
  for (const auto& [text, part] : faults) {
    const auto file = write("bad.trc", text);
    expect_refused(file, part, [&] { read_trc(file); });
  }
}

TEST_F(Trc, WriterRefusesOurOwnMistakes) {
  TrcFile trc = recording();
  trc.positions.pop_back();
  EXPECT_THROW(write_trc(path("x.trc"), trc), std::invalid_argument);
}

}  // namespace
}  // namespace hyperex::io
