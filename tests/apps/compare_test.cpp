// SPDX-License-Identifier: GPL-3.0-or-later
// `hyperex compare` as a user calls it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/good_inputs.hpp"
#include "apps/program.hpp"
#include "hyperex/io/csv.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/io/text_table.hpp"

namespace hyperex {
namespace {

namespace fs = std::filesystem;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

class Program : public ProgramTest {
 protected:
  // A flat sheet of 20 cm, moved forward by `forward_m`, with `extra` vertices appended.
  void write_sheet(const std::string& name, double forward_m, int extra = 0,
                   io::LengthUnit unit = io::LengthUnit::millimetre) const {
    constexpr int n = 41;
    TriMesh mesh{Points(n * n + extra, 3), Triangles(2 * (n - 1) * (n - 1), 3)};
    mesh.points.setZero();
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        mesh.points.row(n * i + j) << 0.005 * (j - n / 2), 0.005 * (i - n / 2), forward_m;
    int row = 0;
    for (int i = 0; i + 1 < n; ++i)
      for (int j = 0; j + 1 < n; ++j) {
        mesh.triangles.row(row++) << n * i + j, n * i + j + 1, n * (i + 1) + j + 1;
        mesh.triangles.row(row++) << n * i + j, n * (i + 1) + j + 1, n * (i + 1) + j;
      }
    io::write_ply(in(name), mesh, unit);
  }
};

TEST_F(Program, TellsItsVersionAndHelp) {
  const Outcome version = call("--version");
  EXPECT_EQ(version.status, 0);
  EXPECT_THAT(version.out, testing::MatchesRegex(
                               "hyperex [0-9]+\\.[0-9]+\\.[0-9]+( \\(commit [0-9a-f]{12}\\+?\\))?\n"
                               "Compiled by .*Eigen 3\\..*\n"
                               "Runs with CHOLMOD [0-9.]+, OpenBLAS .*Embree [0-9.]+, OpenCV .*\n"
                               "Licence: GPL-3.0-or-later.*\n"));
  for (const char* command : {"compare", "symmetry"}) {
    const Outcome help = call(std::string(command) + " --help");
    EXPECT_EQ(help.status, 0);
    EXPECT_THAT(help.out, testing::ContainsRegex(std::string("Examples?:\n  hyperex ") + command));
  }
}

TEST_F(Program, ComparesBySurfaceWithoutLandmarks) {
  write_sheet("a.ply", 0);
  write_sheet("b.ply", 0.003);
  const Outcome found = call("compare a.ply b.ply --unit mm --json");
  ASSERT_EQ(found.status, 0) << found.err;
  const auto json = nlohmann::json::parse(found.out);  // nothing but JSON
  EXPECT_EQ(json.size(), 1u);
  for (const char* key : {"mean_mm", "median_mm", "rms_mm", "p95_mm", "max_mm"})
    EXPECT_NEAR(json["surface"][key].get<double>(), 3, 1e-4) << key;
  EXPECT_FALSE(fs::exists(in("compare.png")));
}

TEST_F(Program, TellsWhichUnitItTookForEachFile) {
  write_sheet("a.ply", 0);
  write_sheet("b.ply", 0.003);
  write_sheet("c.ply", 0.003, 0, io::LengthUnit::metre);
  const Outcome alike = call("compare a.ply b.ply --json");
  ASSERT_EQ(alike.status, 0) << alike.err;
  EXPECT_EQ(alike.err,
            "a.ply: unit mm, guessed by its size: 20 cm across\n"
            "b.ply: unit mm, guessed by its size: 20 cm across\n");
  EXPECT_EQ(nlohmann::json::parse(alike.out).size(), 1u);
  const Outcome mixed = call("compare a.ply c.ply --json");
  ASSERT_EQ(mixed.status, 0) << mixed.err;
  EXPECT_THAT(mixed.err, HasSubstr("c.ply: unit m, guessed"));
  EXPECT_THAT(mixed.err, HasSubstr("warning: the units that were guessed differ"));
  EXPECT_NEAR(nlohmann::json::parse(mixed.out)["surface"]["mean_mm"].get<double>(), 3, 1e-3);
  EXPECT_THAT(call("compare a.ply b.ply --unit mm --json").err, "");
}

/// The lips of a real smile move by 9 mm, which falls off around them.
TEST_F(Program, SaysWhatErrorsOfLandmarksMakeOfARegionsMean) {
  const std::filesystem::path data =
      std::filesystem::path(HYPEREX_SHARED_DIR) / "data/real/spacetime";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "the real smile is not here";
  const std::string neutral = (data / "neutral.ply").string();
  const Outcome found = call("compare --corresponding --rest " + neutral + " " + neutral + " " +
                             (data / "smile.ply").string() + " --landmarks " +
                             (data / "landmarks.json").string() + " --json");
  ASSERT_EQ(found.status, 0) << found.err;
  const auto json = nlohmann::json::parse(found.out);
  const double lips = json["lips"]["mean_half_width_95_mm"],
               face = json["face"]["mean_half_width_95_mm"];
  EXPECT_GT(lips, 0.05);
  EXPECT_LT(lips, 0.6);
  EXPECT_LT(face, lips);
}

TEST_F(Program, ComparesByRegionsOfTheScanAtRest) {
  write_sheet("rest.ply", 0);
  write_sheet("a.ply", 0.001, 3);
  write_sheet("truth.ply", 0.005);
  io::Landmarks landmarks;
  for (int k = 0; k < 68; ++k)
    landmarks["ibug68_" + std::to_string(k)] = {0.001 * (k % 8), 0.002 * (k / 8), 0};
  io::write_landmarks(in("l.json"), landmarks, io::LengthUnit::millimetre);
  const std::string files =
      "compare a.ply truth.ply --corresponding --rest rest.ply "
      "--landmarks l.json --unit mm --json";
  const Outcome found = call(files + " --baseline --picture p.png");
  ASSERT_EQ(found.status, 0) << found.err;
  EXPECT_THAT(found.err, HasSubstr("3 vertices beyond"));
  const auto json = nlohmann::json::parse(found.out);
  EXPECT_NEAR(json["face"]["mean_mm"].get<double>(), 4, 1e-4);
  EXPECT_NEAR(json["lips"]["p95_mm"].get<double>(), 4, 1e-4);
  // Wherever the lips are, the distance is the same.
  EXPECT_NEAR(json["lips"]["mean_half_width_95_mm"].get<double>(), 0, 1e-4);
  EXPECT_FALSE(json["surface"].contains("mean_half_width_95_mm"));
  const auto& still = json["baseline"]["standing_still"]["face"];
  EXPECT_NEAR(still["mean_mm"].get<double>(), 5, 1e-4);
  EXPECT_NEAR(still["ratio_of_means"].get<double>(), 0.8, 1e-4);
  EXPECT_NEAR(json["baseline"]["warp_68"]["face"]["mean_mm"].get<double>(), 0, 1e-4);
  EXPECT_THAT(read_file(in("p.png")).substr(1, 3), "PNG");
  EXPECT_FALSE(nlohmann::json::parse(call(files).out).contains("baseline"));
}

TEST_F(Program, PrintsATableAndDrawsAPictureWhereAskedAlone) {
  write_sheet("a.ply", 0);
  write_sheet("b.ply", 0.003);
  const Outcome found = call("compare a.ply b.ply --unit mm");
  ASSERT_EQ(found.status, 0) << found.err;
  EXPECT_THAT(found.out, HasSubstr("surface       3.000    3.000"));
  const auto entries = [&] {
    return std::distance(fs::directory_iterator(in("")), fs::directory_iterator());
  };
  EXPECT_EQ(entries(), 2) << "no file that was not asked for";
  EXPECT_EQ(call("compare a.ply b.ply --unit mm --picture p.png").out, found.out);
  EXPECT_THAT(read_file(in("p.png")).substr(1, 3), "PNG");
  EXPECT_EQ(entries(), 3);
}

TEST_F(Program, RefusesInOneLine) {
  write_sheet("a.ply", 0);
  write_sheet("longer.ply", 0, 1);
  write_sheet("metres.ply", 0, 0, io::LengthUnit::metre);
  std::ofstream(in("s.stl"))
      << "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 200 0 0\n"
         "vertex 0 200 0\nendloop\nendfacet\nendsolid s\n";
  write_good_inputs(in("."));
  fs::create_directory(in("empty"));
  fs::create_directory(in("face"));
  for (const char* copy : {"face/0.ply", "face/1.ply"}) fs::copy_file(in("face.ply"), in(copy));
  std::ofstream(in("m.csv")) << "time_s,here_x,here_y,here_z\n0,0,0,0\n1,0,0,0\n";
  for (const char* arguments : {"",
                                "compare a.ply",
                                "compare a.ply nothing.ply",
                                "compare a.ply a.ply --unit inch",
                                "compare a.ply longer.ply --corresponding --unit mm",
                                "compare a.ply a.ply --corresponding --rest longer.ply --unit mm",
                                "compare a.ply a.ply --baseline --unit mm",
                                "compare a.ply a.ply --landmarks no.json",
                                "compare a.ply a.ply --unit mm --picture no/folder/p.png",
                                "symmetry nothing.csv",
                                "compare a.ply metres.ply --unit mm",
                                "compare a.ply s.stl --corresponding",
                                "compare s.stl a.ply --corresponding --rest a.ply --unit mm",
                                "symmetry m.csv --unit m",
                                "symmetry motion.csv --jitter-mm much",
                                "symmetry motion.csv --jitter-mm -1",
                                "symmetry motion.csv --repetition-mm nan",
                                "symmetry motion.csv --repetition-mm 30",
                                "symmetry motion.csv --map m.png",
                                "symmetry empty",
                                "symmetry face",
                                "symmetry face --landmarks no.json"}) {
    const Outcome found = call(arguments);
    EXPECT_EQ(found.status, 2) << arguments;
    EXPECT_THAT(found.out, "") << arguments;
    EXPECT_THAT(found.err, StartsWith("hyperex: ")) << arguments;
    EXPECT_THAT(found.err, EndsWith("\n")) << arguments;
    EXPECT_EQ(std::count(found.err.begin(), found.err.end(), '\n'), 1) << found.err;
    std::cout << "  " << found.err;
  }
}

// A face whose left corner of the mouth and surroundings move by 5 mm while the head turns, as
// surfaces and as the points of a run.
TEST_F(Program, DrawsTheSymmetryOfSurfaces) {
  const TriMesh face = good_face();
  const io::Landmarks landmarks = good_landmarks();
  fs::create_directory(in("face"));
  const Vec3 corner = landmarks.at("ibug68_54");
  for (int k = 0; k < 5; ++k) {
    TriMesh moved = face;
    for (Eigen::Index v = 0; v < moved.points.rows(); ++v) {
      const double far = (face.points.row(v).transpose() - corner).norm() / 0.02;
      moved.points(v, 1) += 0.005 * (k / 4.0) * std::exp(-far * far);
    }
    const Eigen::AngleAxisd turn(0.03 * k, Vec3::UnitY());
    moved.points = (moved.points * turn.toRotationMatrix().transpose()).eval();
    io::write_ply(in("face/" + std::to_string(k) + ".ply"), moved, io::LengthUnit::millimetre);
  }
  io::write_landmarks(in("l.json"), landmarks, io::LengthUnit::millimetre);
  const Outcome found = call(
      "symmetry face --landmarks l.json --out s.csv --excursions e.csv --picture s.png --map m.png "
      "--map-ply m.ply --jitter-mm 0.01");
  ASSERT_EQ(found.status, 0) << found.err;
  EXPECT_THAT(found.out, HasSubstr("no medical device"));
  EXPECT_THAT(read_file(in("m.ply")), HasSubstr("property float asymmetry_mm"));
  for (const char* file : {"s.png", "m.png"}) EXPECT_GT(fs::file_size(in(file)), 10000u);
  const io::CsvTable curves = io::read_csv(in("s.csv"));
  ASSERT_EQ(curves.values.rows(), 5);
  const auto at_end = [&](const char* name) { return curves.values(4, curves.column(name)); };
  EXPECT_NEAR(at_end("commissure_L_mm"), 5, 0.2);
  EXPECT_LT(at_end("commissure_R_mm"), 0.2);
  EXPECT_GT(at_end("S_ln"), at_end("S_floor"));
  EXPECT_GT(at_end("asymmetry_mouth_rms_mm"), 1);
  EXPECT_LT(at_end("asymmetry_mouth_p95_mm"), 5.2);
  // The head's pose has the floor that it has in a recording, and repetition one of its own.
  EXPECT_THAT(found.out, HasSubstr("head's pose: uncertain by up to "));
  const auto corners = [&](const char* file, const char* name) {
    const io::TextTable table = io::read_text_table(in(file));
    const auto column = std::ranges::find(table.names, name) - table.names.begin();
    for (const auto& row : table.rows)
      if (row.at(0) == "cheilion") return row.at(std::size_t(column));
    return std::string("no such row");
  };
  EXPECT_GT(std::stod(corners("e.csv", "pose_floor_mm")), 0);
  EXPECT_EQ(corners("e.csv", "decided"), "1");
  const std::string again = "symmetry face --landmarks l.json --jitter-mm 0.01 --excursions ";
  ASSERT_EQ(call(again + "r.csv --repetition-mm 9").status, 0);
  EXPECT_EQ(corners("r.csv", "decided"), "0");
  // Points of the skull that the user names hold the pose in place of all landmarks.
  ASSERT_EQ(call(again + "n.csv --rigid-points ibug68_27,ibug68_36,ibug68_45,ibug68_0").status, 0);
  EXPECT_NE(corners("n.csv", "pose_floor_mm"), corners("e.csv", "pose_floor_mm"));
  expect_refused(again + "w.csv --rigid-points ibug68_27,ibug68_36,nobody",
                 "there is no point nobody");
  const Outcome kept = call(again + "k.csv --keep-head");
  ASSERT_EQ(kept.status, 0) << kept.err;
  EXPECT_THAT(kept.out, testing::Not(HasSubstr("head's pose: ")));
  EXPECT_NE(corners("k.csv", "decided"), "1") << "the head's motion is in the points";
}

TEST_F(Program, WritesSymmetryAsCsv) {
  const fs::path motion =
      fs::path(HYPEREX_SHARED_DIR) / "data/rgbd/subject_A_talk/truth_landmarks68_camera_m.csv";
  if (!fs::exists(motion)) GTEST_SKIP() << "needs " << motion;
  const Outcome found =
      call("symmetry '" + motion.string() + "' --out s.csv --picture s.png --floor 1e-4");
  ASSERT_EQ(found.status, 0) << found.err;
  EXPECT_THAT(read_file(in("s.csv")), StartsWith("time_s,xi_R,xi_L,S_ln,floor,S_floor,"));
  EXPECT_TRUE(fs::exists(in("s.png")));
  EXPECT_THAT(found.out, StartsWith("corners of the mouth: right "));
  EXPECT_THAT(found.err, HasSubstr("exocanthion_L: ibug68_45"));
}

TEST_F(Program, SymmetryLooksAtTheFirstMovementAlone) {
  write_good_inputs(in(""));  // motion.csv: half a second at 30 Hz
  const std::string motion = "motion.csv";
  const Outcome whole = call("symmetry " + motion + " --excursions whole.csv"),
                part = call("symmetry " + motion + " --excursions part.csv --end-s 0.21");
  ASSERT_EQ(whole.status, 0) << whole.err;
  ASSERT_EQ(part.status, 0) << part.err;
  EXPECT_NE(read_file(in("whole.csv")), read_file(in("part.csv")));
  EXPECT_THAT(part.out, HasSubstr("\n    0.2000 "));
  EXPECT_THAT(part.out, testing::Not(HasSubstr("\n    0.2333 ")));
  EXPECT_THAT(call("symmetry " + motion + " --end-s 0.001").err,
              HasSubstr("--end-s = 0.001: expected at least the second sample's time, "));
}

/// Corners of the mouth, eyes, brows, and the jaw last; then the pose, which none of them includes.
TEST_F(Program, SymmetryPrintsWhatIsReadFirst) {
  write_good_inputs(in(""));
  const Outcome found = call("symmetry motion.csv");
  ASSERT_EQ(found.status, 0) << found.err;
  std::size_t before = 0;
  for (const char* words :
       {"\nS compares how much ", "does not say which face moves more evenly in mm",
        "grades no palsy: the excursions say which side moves less", "\npoint ",
        "\ncorner of the mouth", "eyelid", "\nouter end of the brow", "\noutline of the jaw 1",
        "\nhead's pose: uncertain by up to "}) {
    const std::size_t at = found.out.find(words);
    ASSERT_NE(at, std::string::npos) << words << '\n' << found.out;
    EXPECT_GT(at, before) << words << '\n' << found.out;
    before = at;
  }
  EXPECT_THAT(call("symmetry motion.csv --keep-head").out, testing::Not(HasSubstr("head's pose")));
}

TEST_F(Program, SymmetryTakesTheHeadOutByNamedPoints) {
  write_good_inputs(in(""));
  write_opening(in(""), 0, 16, keep_mouth_and_headband);
  const std::string heads = " --rigid-points head_1,head_2,head_3,head_4,head_5,head_6";
  const Outcome found = call("symmetry motion.csv --out s.csv --excursions named.csv" + heads);
  ASSERT_EQ(found.status, 0) << found.err;
  EXPECT_THAT(found.err, testing::AllOf(HasSubstr("S(t) is left out: motion.csv: symmetry needs"),
                                        HasSubstr("exocanthion_L (or ibug68_45)"),
                                        testing::Not(HasSubstr("head pose is not taken out"))));
  EXPECT_THAT(found.out,
              testing::AllOf(HasSubstr("excursion (mm)"), testing::Not(HasSubstr("stretch: "))));
  const io::CsvTable curves = io::read_csv(in("s.csv"));
  ASSERT_EQ(curves.values.rows(), 16);
  EXPECT_TRUE(std::isnan(curves.values(15, curves.column("xi_L"))));
  EXPECT_GT(curves.values(15, curves.column("commissure_L_mm")), 1);
  // The headband does not move in the head: its points are where the skull is.
  const auto corner_mm = [&](const std::string& file) {
    const std::string text = read_file(in(file));
    const auto row = text.find("\nibug68_48/54,");
    return row == std::string::npos ? -1 : std::stod(text.substr(row + 14));
  };
  // The recording itself shows which points are still.
  const Outcome own = call("symmetry motion.csv --excursions own.csv");
  EXPECT_THAT(own.err,
              testing::AllOf(HasSubstr("the head is held by head_1, head_2, head_3, head_4, "
                                       "head_5, head_6, which keep still against each other"),
                             HasSubstr("--rigid-points changes that, --keep-head keeps")));
  EXPECT_EQ(read_file(in("own.csv")), read_file(in("named.csv")));
  EXPECT_THAT(own.out, HasSubstr("head's pose: no noise is seen in the points that hold it"));
  EXPECT_THAT(call("symmetry motion.csv --jitter-mm 0").out,
              HasSubstr("head's pose: exact, as the points are"));
  EXPECT_THAT(call("symmetry motion.csv --keep-head").err,
              testing::Not(HasSubstr("the head is held by")));
  write_opening(in(""), 0, 16);
  ASSERT_EQ(call("symmetry motion.csv --excursions whole.csv --rigid-points "
                 "ibug68_17,ibug68_21,ibug68_26,ibug68_27,ibug68_36,ibug68_45")
                .status,
            0);
  EXPECT_GT(corner_mm("whole.csv"), 1);
  EXPECT_NEAR(corner_mm("named.csv"), corner_mm("whole.csv"), 1e-3);
}

TEST_F(Program, SymmetryNamesTheRigidPointThatIsNotThere) {
  write_good_inputs(in(""));
  const Outcome wrong = call("symmetry motion.csv --rigid-points ibug68_27,ibug68_36,head_9");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("there is no point head_9"));
  EXPECT_THAT(call("symmetry motion.csv --rigid-points ibug68_8,ibug68_48,ibug68_54").err,
              HasSubstr("--rigid-points names points that move with mouth and chin: ibug68_8"));
  EXPECT_EQ(call("symmetry motion.csv --rigid-points ibug68_27 --keep-head").status, 2);
}

TEST_F(Program, SymmetryWithoutThePointsOfSDrawsTheBarsAndWritesTheRest) {
  write_good_inputs(in(""));
  write_opening(in(""), 0, 16, keep_mouth_and_headband);
  const Outcome drawn = call("symmetry motion.csv --picture s.png --excursions e.csv --keep-head");
  ASSERT_EQ(drawn.status, 0) << drawn.err;
  EXPECT_THAT(drawn.err, HasSubstr("S(t) is left out: motion.csv: symmetry needs points"));
  EXPECT_THAT(read_file(in("s.png")).substr(1, 3), "PNG");
  EXPECT_TRUE(fs::exists(in("e.csv")));
}

}  // namespace
}  // namespace hyperex
