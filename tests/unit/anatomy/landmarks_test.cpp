// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/landmarks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/anatomy/lip_line.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/face/optional_landmarks.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/io/scan.hpp"
#include "support/note_matchers.hpp"
#include "support/refusal.hpp"
#include "support/sheet_mesh.hpp"
#include "unit/anatomy/another_face.hpp"

namespace hyperex::anatomy {
namespace {
namespace fs = std::filesystem;

void expect_refused(const std::function<void()>& work, const std::vector<std::string>& parts) {
  const std::string said = test::refusal(work);
  EXPECT_NE(said, "") << "was not refused";
  for (const auto& part : parts) EXPECT_THAT(said, ::testing::HasSubstr(part));
}

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const auto& [name, vertices] : canonical_face().landmarks) names.push_back(name);
  return names;
}

const std::vector<std::string> kSeven = {"ibug68_36", "ibug68_39", "ibug68_42", "ibug68_45",
                                         "ibug68_30", "ibug68_48", "ibug68_54"};

io::Landmarks only(const io::Landmarks& all, const std::vector<std::string>& names) {
  io::Landmarks some;
  for (const auto& name : names) some[name] = all.at(name);
  return some;
}

TEST(CompleteLandmarks, PlacesTheMissingOnesOnAnotherFace) {
  const EmbeddedFace face = another_face(0.5);
  const CompletedLandmarks completed =
      complete_landmarks(only(face.landmarks, kSeven), all_names(), face.mesh);
  EXPECT_EQ(completed.placed.size(), face.landmarks.size() - kSeven.size());
  EXPECT_TRUE(std::is_sorted(completed.placed.begin(), completed.placed.end()));
  const SurfaceTree tree(face.mesh);
  double mean = 0;
  for (const auto& name : completed.placed) {
    const Vec3 p = completed.landmarks.at(name);
    EXPECT_LT(tree.query(p).squared_distance, 1e-20) << name;
    const double error = (p - face.landmarks.at(name)).norm();
    EXPECT_LT(error, 0.006) << name;
    mean += error / double(completed.placed.size());
  }
  EXPECT_LT(mean, 0.002);
  for (const auto& name : kSeven) EXPECT_EQ(completed.landmarks.at(name), face.landmarks.at(name));
}

TEST(CompleteLandmarks, LeavesACompleteSetAlone) {
  const EmbeddedFace face = another_face(0.5);
  io::Landmarks given = only(face.landmarks, kSeven);
  given["scar"] = face.landmarks.at("cheek_L");  // unknown to the canonical face, and welcome
  const CompletedLandmarks completed = complete_landmarks(given, {"scar", "ibug68_30"}, face.mesh);
  EXPECT_TRUE(completed.placed.empty());
  EXPECT_EQ(completed.landmarks, given);
}

TEST(CompleteLandmarks, RefusesALandmarkOffTheScan) {
  const EmbeddedFace face = another_face(0.5);
  io::Landmarks given = only(face.landmarks, kSeven);
  given["ibug68_30"] += Vec3(0, 0, 0.1);
  expect_refused([&] { complete_landmarks(given, {}, face.mesh, "l.json"); },
                 {"l.json: landmark ibug68_30 is ", " mm from the scan's surface", "15 mm"});
}

TEST(CompleteLandmarks, RefusesALandmarkThatSlippedAlongTheScan) {
  const EmbeddedFace face = another_face(0.5);
  io::Landmarks given = only(face.landmarks, kSeven);
  given["ibug68_48"] = face.landmarks.at("ibug68_17");
  expect_refused([&] { complete_landmarks(given, {}, face.mesh, "l.json"); },
                 {"landmark ibug68_48", "from where the others put it"});
  // A corner of the eye at the chin puts the nose behind the plane: the scan is not blamed.
  given = only(face.landmarks, kSeven);
  given["ibug68_36"] = face.landmarks.at("ibug68_8");
  expect_refused([&] { complete_landmarks(given, {}, face.mesh, "l.json"); },
                 {"landmark ibug68_36", "from where the others put it"});
}

TEST(CompleteLandmarks, RefusesExchangedSides) {
  const EmbeddedFace face = another_face(0.5);
  io::Landmarks one = only(face.landmarks, kSeven);
  std::swap(one["ibug68_48"], one["ibug68_54"]);
  expect_refused([&] { complete_landmarks(one, {}, face.mesh); },
                 {"ibug68_48 and ibug68_54 are exchanged"});
  io::Landmarks all;
  for (const auto& name : kSeven) all[name] = face.landmarks.at(mirrored_landmark(name));
  expect_refused([&] { complete_landmarks(all, {}, face.mesh); }, {"exchanged in all"});
  // The eyes alone are nearly the same turned round: there the surface decides.
  io::Landmarks eyes;
  for (const int k : {36, 39, 42, 45, 48, 54}) {
    const std::string name = "ibug68_" + std::to_string(k);
    eyes[name] = face.landmarks.at(mirrored_landmark(name));
  }
  expect_refused([&] { complete_landmarks(eyes, {}, face.mesh); }, {"exchanged"});
  TriMesh inside_out = face.mesh;
  inside_out.triangles.col(0).swap(inside_out.triangles.col(1));
  expect_refused([&] { complete_landmarks(only(face.landmarks, kSeven), {}, inside_out); },
                 {"inside out"});
}

io::Landmarks negated(io::Landmarks landmarks, const Vec3& sign) {
  for (auto& [name, p] : landmarks) p = p.cwiseProduct(sign);
  return landmarks;
}

/// Checks that a scan with x and y negated is refused, and so are mirrored landmarks.
void expect_axes_told(const TriMesh& scan, const io::Landmarks& all) {
  for (const auto& given :
       {all, only(all, kSeven), only(all, {"ibug68_36", "ibug68_45", "ibug68_30"})}) {
    EXPECT_NO_THROW(complete_landmarks(given, all_names(), scan));
    expect_refused(
        [&] {
          complete_landmarks(negated(given, {-1, -1, 1}), all_names(), scan, "l.json");
        },
        {"l.json: these landmarks fit the scan only with x and y negated", "RAS", "LPS"});
    expect_refused(
        [&] {
          complete_landmarks(negated(given, {1, -1, 1}), all_names(), scan);
        },
        {"only with y negated", "mirrored"});
    expect_refused(
        [&] {
          complete_landmarks(negated(given, {-1, 1, -1}), all_names(), scan);
        },
        {"only with x and z negated", "axes"});
  }
}

TEST(CompleteLandmarks, RefusesOtherAxesThanTheScans) {
  // By chance these lie within 15 mm of the skin, upside down.
  const EmbeddedFace face = embedded_face();
  const SurfaceTree tree(face.mesh);
  for (const auto& [name, p] : negated(face.landmarks, {-1, -1, 1}))
    EXPECT_LT(tree.query(p).squared_distance, 0.015 * 0.015) << name;
  expect_axes_told(face.mesh, face.landmarks);
}

TEST(UnknownLandmarks, AreNamedTheLikelyMistakesFirst) {
  io::Landmarks given = only(embedded_face().landmarks, kSeven);
  EXPECT_TRUE(unknown_landmarks(given).empty());
  given["exocantion_R"] = Vec3::Zero();
  EXPECT_THAT(unknown_landmarks_note(unknown_landmarks(given)),
              ::testing::AllOf(test::is_note("landmarks.unknown"), test::says("one landmark"),
                               test::says(": exocantion_R;")));
  for (int k = 10; k < 40; ++k) given["M" + std::to_string(k)] = Vec3::Zero();
  EXPECT_THAT(unknown_landmarks_note(unknown_landmarks(given)),
              ::testing::AllOf(test::says("31 landmarks"), test::says(": exocantion_R, M10, M11, "),
                               test::says("M28 and 11 more;")));
}

TEST(UnknownLandmarks, DoNotCountThoseOfTheFold) {
  io::Landmarks given = only(embedded_face().landmarks, kSeven);
  for (const std::string& name : face::optional_landmarks()) given[name] = Vec3::Zero();
  EXPECT_TRUE(unknown_landmarks(given).empty());
  given["nasolabial_fold"] = Vec3::Zero();
  EXPECT_THAT(unknown_landmarks(given), ::testing::ElementsAre("nasolabial_fold"));
}

/// All landmarks of the embedded face, with those of its left fold on the skin.
io::Landmarks with_left_fold() {
  const EmbeddedFace face = embedded_face();
  io::Landmarks landmarks = face.landmarks;
  const SurfaceTree tree(face.mesh);
  const Vec3 wing = landmarks.at("ibug68_35"), corner = landmarks.at("ibug68_54");
  landmarks["nasolabial_fold_upper_L"] = tree.query(wing + Vec3(0.005, 0.005, 0)).point;
  landmarks["nasolabial_fold_middle_L"] =
      tree.query((wing + corner) / 2 + Vec3(0.008, 0.002, 0)).point;
  landmarks["nasolabial_fold_lower_L"] = tree.query(corner + Vec3(0.01, 0, 0)).point;
  return landmarks;
}

TEST(LandmarksOfTheFold, AreKeptAndNeverPlaced) {
  const EmbeddedFace face = embedded_face();
  const io::Landmarks given = with_left_fold();
  EXPECT_EQ(complete_landmarks(given, face.mesh).landmarks, given);
  io::Landmarks few = only(given, kSeven);
  few["nasolabial_fold_upper_L"] = given.at("nasolabial_fold_upper_L");
  const CompletedLandmarks completed = complete_landmarks(few, face.mesh);
  EXPECT_EQ(completed.landmarks.at("nasolabial_fold_upper_L"), given.at("nasolabial_fold_upper_L"));
  EXPECT_FALSE(completed.landmarks.contains("nasolabial_fold_lower_L"));
  EXPECT_FALSE(completed.landmarks.contains("nasolabial_fold_upper_R"));
}

TEST(LandmarksOfTheFold, InWrongPlacesAreRefused) {
  const EmbeddedFace face = embedded_face();
  const io::Landmarks good = with_left_fold();
  const auto expect_told = [&](const io::Landmarks& given, const std::vector<std::string>& parts) {
    expect_refused([&] { complete_landmarks(given, face.mesh, "l.json"); }, parts);
  };
  io::Landmarks given = good;
  given["nasolabial_fold_upper_R"] = good.at("nasolabial_fold_upper_L");
  expect_told(given, {"l.json: landmark nasolabial_fold_upper_R lies ",
                      " mm beyond the middle of the face", "the subject's own right"});
  given = good;
  given["nasolabial_fold_lower_L"] = good.at("exocanthion_L");
  expect_told(given, {"landmark nasolabial_fold_lower_L is ", " mm from the corner of the mouth",
                      "at most 30 mm"});
  given = good;
  std::swap(given["nasolabial_fold_upper_L"], given["nasolabial_fold_lower_L"]);
  expect_told(given, {"nasolabial_fold_upper_L"});
  given = good;  // both within reach of their places, and turned round
  given["nasolabial_fold_upper_L"] = good.at("ibug68_35") + Vec3(0.008, -0.012, -0.004);
  given["nasolabial_fold_lower_L"] = good.at("ibug68_54") + Vec3(0.006, 0.022, 0);
  expect_told(given, {"nasolabial_fold_upper_L lies below nasolabial_fold_lower_L"});
  given = good;
  given["nasolabial_fold_middle_L"] += Vec3(0, 0, 0.05);
  expect_told(given, {"landmark nasolabial_fold_middle_L is ", " mm from the scan's surface"});
}

TEST(CompleteLandmarks, NeedsThreeKnownOnesOffOneLine) {
  const EmbeddedFace face = another_face(0.5);
  const std::vector<std::string> needed = {"ibug68_8"};
  expect_refused(
      [&] {
        complete_landmarks(only(face.landmarks, {"ibug68_36", "ibug68_45"}), needed, face.mesh);
      },
      {"ibug68_8", "three"});
  expect_refused(
      [&] {
        complete_landmarks(only(face.landmarks, {"ibug68_27", "ibug68_28", "ibug68_29"}), {"elbow"},
                           face.mesh);
      },
      {"elbow", "unknown"});
  const Vec3 a = face.landmarks.at("ibug68_27"), b = face.landmarks.at("ibug68_29");
  expect_refused(
      [&] {
        complete_landmarks({{"ibug68_27", a}, {"ibug68_29", b}, {"ibug68_28", (a + b) / 2}}, needed,
                           face.mesh);
      },
      {"line"});
}

TEST(CompleteLandmarks, AllProblemsAreToldAtOnce) {
  const EmbeddedFace face = another_face(0.5);
  io::Landmarks given = only(face.landmarks, kSeven);
  given["ibug68_30"] += Vec3(0, 0, 0.1);
  expect_refused([&] { complete_landmarks(given, {"elbow"}, face.mesh, "l.json"); },
                 {"ibug68_30", "\nl.json: landmark elbow"});
}

/// The scan is a wall of two lips that meet in a groove along y = curve(x).
TEST(LipLine, FollowsAGrooveAndFindsNoneOnABulge) {
  const auto curve = [](double x) { return 0.003 * std::sin(x * 60); };
  const auto wall = [&](double depth) {
    TriMesh mesh = test::sheet_mesh({120, 120}, {1, 1}).mesh;
    for (auto point : mesh.points.rowwise()) {
      const double x = 0.08 * (point.x() - 0.5), y = 0.06 * (point.y() - 0.5);
      const double groove = std::exp(-std::pow((y - curve(x)) / 0.002, 2));
      point << x, y, 0.1 - 6 * x * x - 4 * y * y - depth * groove;
    }
    return mesh;
  };
  Points guess(2, 3);
  guess << -0.025, curve(-0.025), 0.09, 0.025, curve(0.025), 0.09;
  const auto found = find_lip_line(wall(0.002), guess, Eigen::Matrix3d::Identity());
  ASSERT_TRUE(found);
  EXPECT_GT(found->crease_m, 0.0005);
  for (Eigen::Index i = 0; i < found->points.rows(); ++i)
    EXPECT_NEAR(found->points(i, 1), curve(found->points(i, 0)), 0.0008);
  EXPECT_FALSE(find_lip_line(wall(0), guess, Eigen::Matrix3d::Identity()));
}

class OnRealScans : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(data_)) GTEST_SKIP() << "the shared data are not here";
  }
  const fs::path data_ = fs::path(HYPEREX_SHARED_DIR) / "data";
};

TEST_F(OnRealScans, SevenLandmarksGiveTheOthersOfSubjectA) {
  const io::Scan scan = io::read_scan(data_ / "ict/subject_A_neutral_scan.ply");
  const io::Landmarks truth = io::read_landmarks(data_ / "ict/subject_A_landmarks.json");
  const CompletedLandmarks completed =
      complete_landmarks(only(truth, kSeven), all_names(), scan.mesh);
  const auto mean_error_mm = [&](int first, int last) {
    double sum = 0;
    for (int k = first; k <= last; ++k) {
      const std::string name = "ibug68_" + std::to_string(k);
      sum += (completed.landmarks.at(name) - truth.at(name)).norm() * 1e3;
    }
    return sum / (last - first + 1);
  };
  // Measured: jaw outline 6.9 (its points slide along the outline), chin 2.9, brows 4.3, nose 1.5,
  // eyes 1.1, outer lips 1.2, inner lips 1.2 mm.
  EXPECT_LT(mean_error_mm(0, 16), 8.5);
  EXPECT_LT(mean_error_mm(6, 10), 4);
  EXPECT_LT(mean_error_mm(17, 26), 5.5);
  EXPECT_LT(mean_error_mm(27, 35), 2.2);
  EXPECT_LT(mean_error_mm(36, 47), 1.6);
  EXPECT_LT(mean_error_mm(48, 59), 1.8);
  EXPECT_LT(mean_error_mm(60, 67), 1.8);
  for (int k = 0; k < 68; ++k)
    std::printf("%s%d: %.1f", k ? ", " : "error in mm of ", k, mean_error_mm(k, k));
  std::printf("\n");
}

TEST_F(OnRealScans, OtherAxesThanThoseOfSubjectAAreRefused) {
  const io::Landmarks all = io::read_landmarks(data_ / "ict/subject_A_landmarks.json");
  expect_axes_told(io::read_scan(data_ / "ict/subject_A_neutral_scan.ply").mesh, all);
}

TEST_F(OnRealScans, ScannedFaceWithJoinedLipsGetsItsLipLineInTheCrease) {
  const io::Scan scan = io::read_scan(data_ / "real/humface.ply");
  const io::Landmarks given = io::read_landmarks(data_ / "real/humface_landmarks.json");
  const CompletedLandmarks completed = complete_landmarks(given, all_names(), scan.mesh);
  const auto at = [&](const std::string& name) { return completed.landmarks.at(name); };
  // Read off the picture: the crease's middle is at (21, 8.7) mm, the lower lip's lower border at
  // -2, the tip of the nose was given.
  EXPECT_NEAR(at("stomion").x(), 0.021, 0.002);
  EXPECT_NEAR(at("stomion").y(), 0.0087, 0.0015);
  EXPECT_NEAR(at("labiale_inferius").y(), -0.002, 0.003);
  EXPECT_LT((at("ibug68_30") - given.at("pronasale")).norm(), 1e-4);
  EXPECT_GT(at("ibug68_62").y(), at("ibug68_66").y() - 1e-4);
}

}  // namespace
}  // namespace hyperex::anatomy
