// SPDX-License-Identifier: GPL-3.0-or-later
// The unit rule, and the real files.
#include "hyperex/io/scan.hpp"

#include "hyperex/io/csv.hpp"
#include "hyperex/io/landmarks.hpp"
#include "unit/io/io_testing.hpp"

namespace hyperex::io {
namespace {
using testing::expect_refused;
using testing::shared_data;
using testing::sheet;
using ScanUnit = testing::FileTest;

TEST(LengthUnits, NamesAndScales) {
  for (const auto& [name, metres] : {std::pair{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}}) {
    const auto unit = length_unit(name);
    ASSERT_TRUE(unit);
    EXPECT_EQ(name_of(*unit), name);
    EXPECT_DOUBLE_EQ(metres_per(*unit), metres);
  }
  EXPECT_FALSE(length_unit("inch"));
  EXPECT_FALSE(length_unit("MM"));
}

TEST_F(ScanUnit, StatedUnitIsBelievedOverAWiderRangeThanAGuess) {
  TriMesh small = sheet(3);
  small.points *= 0.09 / 0.16;  // the middle side: 9 cm
  write_ply(path("s.ply"), small, LengthUnit::millimetre);
  expect_refused(path("s.ply"), "state the unit (\"mm\" would make it 9 cm)",
                 [&] { read_scan(path("s.ply")); });
  const Scan scan = read_scan(path("s.ply"), LengthUnit::millimetre);
  EXPECT_FALSE(scan.unit_guessed);
  EXPECT_NEAR(scan.mesh.points(15, 0), 0.045, 1e-7);
}

TEST_F(ScanUnit, AWrongStatedUnitIsRefusedWithTheOneThatFits) {
  write_ply(path("a.ply"), sheet(3), LengthUnit::millimetre);
  expect_refused(path("a.ply"),
                 "is 160 m in the stated unit \"m\"; expected a face, 8 to 45 cm: the unit \"mm\" "
                 "would fit (16 cm)",
                 [&] { read_scan(path("a.ply"), LengthUnit::metre); });
  expect_refused(path("a.ply"), "is 1.6 m in the stated unit \"cm\"",
                 [&] { read_scan(path("a.ply"), LengthUnit::centimetre); });
  EXPECT_NEAR(read_mesh(path("a.ply"), LengthUnit::metre).points(15, 0), 80, 1e-4);
}

TEST_F(ScanUnit, NoUnitFitsAButtonOrATable) {
  for (const double scale : {0.04, 5.}) {  // 6.4 mm and 0.8 m, whatever the unit
    TriMesh mesh = sheet(3);
    mesh.points *= scale;
    write_ply(path("a.ply"), mesh, LengthUnit::metre);
    expect_refused(path("a.ply"), "expected the scan of one face",
                   [&] { read_scan(path("a.ply")); });
    expect_refused(path("a.ply"), "no unit of mm, cm or m fits",
                   [&] { read_scan(path("a.ply"), LengthUnit::metre); });
  }
}

TEST_F(ScanUnit, UnknownExtensionMissingFileAndFolder) {
  const auto text = write("face.fbx", "x");
  expect_refused(text, "expected .ply, .obj, .stl, .gltf or .glb", [&] { read_scan(text); });
  expect_refused(path("gone.ply"), "no such file", [&] { read_scan(path("gone.ply")); });
  std::filesystem::create_directory(path("folder.ply"));
  expect_refused(path("folder.ply"), "is a folder", [&] { read_scan(path("folder.ply")); });
}

struct Expected {
  const char* file;
  long vertices, triangles;
  LengthUnit unit;
};

TEST(RealFiles, CountsUnitsAndSizes) {
  if (!std::filesystem::exists(shared_data())) GTEST_SKIP() << "no shared data beside the project";
  for (const Expected& expected :
       {Expected{"ict/subject_A_neutral_scan.ply", 36326, 71952, LengthUnit::millimetre},
        Expected{"ict/subject_A_mouth_open_truth.ply", 36326, 71952, LengthUnit::millimetre},
        Expected{"ict/subject_A_talk_peak_truth.ply", 36326, 71952, LengthUnit::millimetre},
        Expected{"ict/subject_A_mouth_open_scan.ply", 36297, 71891, LengthUnit::millimetre},
        Expected{"real/humface.ply", 10381, 20000, LengthUnit::millimetre}}) {
    const Scan scan = read_scan(shared_data() / expected.file);
    EXPECT_EQ(scan.mesh.points.rows(), expected.vertices) << expected.file;
    EXPECT_EQ(scan.mesh.triangles.rows(), expected.triangles) << expected.file;
    EXPECT_EQ(scan.unit, expected.unit) << expected.file;
    EXPECT_TRUE(scan.unit_guessed);
  }
}

TEST(RealFiles, RigPartsShareTheirVertices) {
  const auto file = shared_data() / "ict/subject_A_rig.glb";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no shared data beside the project";
  const TriMesh rig = read_mesh(file, LengthUnit::metre);
  EXPECT_EQ(rig.points.rows(), 26719);
  // A landmark of the rig is where the landmark file says.
  const Landmarks landmarks = read_landmarks(shared_data() / "ict/subject_A_landmarks.json");
  EXPECT_LT((Vec3(rig.points.row(1225)) - landmarks.at("ibug68_0")).norm(), 1e-6);
}

TEST(RealFiles, LandmarksLieOnTheirScans) {
  if (!std::filesystem::exists(shared_data())) GTEST_SKIP() << "no shared data beside the project";
  for (const auto& [scan_file, landmark_file, count] :
       {std::tuple{"ict/subject_A_neutral_scan.ply", "ict/subject_A_landmarks.json", 68ul},
        std::tuple{"real/humface.ply", "real/humface_landmarks.json", 7ul}}) {
    const Scan scan = read_scan(shared_data() / scan_file);
    const Landmarks landmarks = read_landmarks(shared_data() / landmark_file);
    EXPECT_GE(landmarks.size(), count);
    for (const auto& [name, p] : landmarks)
      EXPECT_LT((scan.mesh.points.rowwise() - p.transpose()).rowwise().norm().minCoeff(), 0.004)
          << name;
  }
}

TEST(RealFiles, RecordingsAreTables) {
  if (!std::filesystem::exists(shared_data())) GTEST_SKIP() << "no shared data beside the project";
  const CsvTable truth =
      read_csv(shared_data() / "rgbd/subject_A_mouth_open/truth_landmarks68_camera_m.csv");
  EXPECT_EQ(truth.values.rows(), 81);
  EXPECT_EQ(truth.values.cols(), 1 + 3 * 68);
  EXPECT_NEAR(truth.values(80, truth.column("time_s")), 80 / 30., 1e-5);
  EXPECT_FALSE(truth.values.hasNaN());
  const CsvTable action_units = read_csv(shared_data() / "motion/openface_au_19_3.csv");
  EXPECT_EQ(action_units.values.rows(), 301);
  EXPECT_NEAR(action_units.values(0, action_units.column("AU25_r")), 0.995644, 1e-12);
}

}  // namespace
}  // namespace hyperex::io
