// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/landmark_doubts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/face/same_place.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/io/scan.hpp"
#include "support/note_matchers.hpp"
#include "unit/anatomy/another_face.hpp"

namespace hyperex::anatomy {
namespace {
namespace fs = std::filesystem;
using test::is_about;
using test::is_warning;
using test::says;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

auto is_doubt_on(const std::string& name) {
  return AllOf(is_warning("landmarks.doubtful"), says("landmark " + name + " is "));
}

const std::vector<std::string> kSevenNamed = {"exocanthion_R", "endocanthion_R", "endocanthion_L",
                                              "exocanthion_L", "pronasale",      "cheilion_R",
                                              "cheilion_L"};

TEST(SamePlace, NamesOnePlaceEitherWay) {
  EXPECT_TRUE(face::same_place("cheilion_R", "ibug68_48"));
  EXPECT_TRUE(face::same_place("ibug68_48", "cheilion_R"));
  EXPECT_FALSE(face::same_place("cheilion_R", "ibug68_54"));
  EXPECT_FALSE(face::same_place("cheilion_R", "cheilion_R"));
  EXPECT_EQ(face::other_name("pogonion"), "");
  EXPECT_FALSE(face::same_place("pogonion", ""));
  // Both names stand for the same vertices of the canonical face.
  for (const auto& [name, vertices] : canonical_face().landmarks) {
    const std::string other = face::other_name(name);
    if (other.empty()) continue;
    EXPECT_EQ(vertices, canonical_face().landmarks.at(other)) << name;
  }
}

TEST(LandmarkSurprises, PredictsFromTheOthersAlone) {
  const EmbeddedFace face = another_face(1.5);
  const auto before = landmark_surprises(face.landmarks);
  io::Landmarks moved = face.landmarks;
  moved["ibug68_48"] += Vec3(0.01, 0.02, 0);
  const auto after = landmark_surprises(moved);
  ASSERT_EQ(before.size(), face.landmarks.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_LT(before[i].deviations, 2.5) << before[i].name;
    if (before[i].name != "ibug68_48") continue;
    // Its own place has no say in where it is expected (but for the frame's linearisation).
    EXPECT_LT((after[i].expected - before[i].expected).norm(), 3e-4);
    EXPECT_GT(after[i].deviations, 8);
  }
}

TEST(LandmarkSurprises, LeavingOneOutIsSolvingWithoutIt) {
  // Without its neighbours near by, a landmark is known less well: the deviations say so.
  const EmbeddedFace face = another_face(1.5);
  io::Landmarks seven;
  for (const auto& name : kSevenNamed) seven[name] = face.landmarks.at(name);
  const double d = 0.012;
  const auto deviations = [&](io::Landmarks given) {
    given["cheilion_R"] += Vec3(0, d, 0);
    for (const auto& surprise : landmark_surprises(given))
      if (surprise.name == "cheilion_R") return surprise.deviations;
    return 0.0;
  };
  EXPECT_GT(deviations(face.landmarks), 1.5 * deviations(seven));
  EXPECT_THAT(landmark_surprises({{"cheilion_R", Vec3::Zero()}}), IsEmpty());
}

TEST(LandmarkDoubts, NamesTheOneThatSlippedAndHowFar) {
  const EmbeddedFace face = another_face(1.5);
  EXPECT_THAT(landmark_doubts(face.landmarks, face.mesh), IsEmpty());
  const SurfaceTree tree(face.mesh);
  for (const char* name : {"cheilion_R", "exocanthion_L", "ibug68_30", "ibug68_57", "alare_L"}) {
    io::Landmarks given = face.landmarks;
    const Vec3 to = face.landmarks.at("cheek_R");
    const Vec3 direction = (to - given[name]).normalized();
    given[name] = tree.query(given[name] + 0.012 * direction).point;
    const double moved_mm = 1e3 * (given[name] - face.landmarks.at(name)).norm();
    ASSERT_GT(moved_mm, 9) << name;
    const auto doubts = landmark_doubts(given, face.mesh);
    ASSERT_EQ(doubts.size(), 1u) << name;
    EXPECT_THAT(doubts[0], AllOf(is_doubt_on(name), is_about("scan.landmarks")));
  }
}

TEST(LandmarkDoubts, TellsWhichOfTwoNamesOfOnePlaceIsWrong) {
  const EmbeddedFace face = another_face(1.5);
  io::Landmarks given = face.landmarks;
  given["cheilion_R"] = face.landmarks.at("cheek_R");
  auto doubts = landmark_doubts(given, face.mesh);
  ASSERT_EQ(doubts.size(), 1u);
  EXPECT_THAT(doubts[0], AllOf(is_doubt_on("cheilion_R"), says("ibug68_48")));
  // Too near for surprise, yet not one place.
  given = face.landmarks;
  given["ibug68_54"] += 0.006 * (given["ibug68_48"] - given["ibug68_54"]).normalized();
  doubts = landmark_doubts(given, face.mesh);
  ASSERT_GE(doubts.size(), 1u);
  EXPECT_THAT(doubts[0], AllOf(is_doubt_on("ibug68_54"), says("6.0 mm from cheilion_L")));
}

TEST(LandmarkDoubts, SeesWhatFloatsOffTheScan) {
  const EmbeddedFace face = embedded_face();
  io::Landmarks given;
  for (const auto& name : {"exocanthion_R", "exocanthion_L", "pronasale"})
    given[name] = face.landmarks.at(name);
  given["pronasale"] += Vec3(0, 0, 0.008);
  EXPECT_THAT(landmark_doubts(given, face.mesh),
              ElementsAre(AllOf(is_doubt_on("pronasale"), says("8.0 mm off the scan"))));
}

TEST(LandmarkDoubts, PromiseNoPlaceForALandmarkOfTheFold) {
  const EmbeddedFace face = embedded_face();
  io::Landmarks given = face.landmarks;
  given["nasolabial_fold_middle_R"] = face.landmarks.at("cheek_R") + Vec3(0, 0, 0.012);
  EXPECT_THAT(landmark_doubts(given, face.mesh),
              ElementsAre(AllOf(is_doubt_on("nasolabial_fold_middle_R"),
                                says("remove it from the landmarks: a rule then leads the fold"))));
}

TEST(LandmarkDoubts, SaysOfAWrongSetThatItIsWrongAsAWhole) {
  const EmbeddedFace face = embedded_face();
  io::Landmarks given = face.landmarks;
  for (auto& [name, p] : given) p.z() += 0.01;
  const auto doubts = landmark_doubts(given, face.mesh);
  EXPECT_THAT(doubts, ElementsAre(is_warning("landmarks.many_doubtful")));
}

/// True landmarks of real people give no warning; one moved by 15 mm does.
TEST(LandmarkDoubts, HoldsOnRealFaces) {
  const fs::path data = fs::path(HYPEREX_SHARED_DIR) / "data";
  if (!fs::exists(data)) GTEST_SKIP() << "no " << data;
  for (const auto& [scan, landmarks] :
       {std::pair{"ict/subject_A_neutral_scan.ply", "ict/subject_A_landmarks.json"},
        {"real/humface.ply", "real/humface_landmarks.json"},
        {"real/spacetime/neutral.ply", "real/spacetime/landmarks.json"},
        {"real/animface/cheeks_scan.ply", "real/animface/cheeks_landmarks.json"}}) {
    const TriMesh mesh = io::read_scan(data / scan, io::LengthUnit::millimetre).mesh;
    const io::Landmarks given = io::read_landmarks(data / landmarks);
    EXPECT_THAT(landmark_doubts(given, mesh), IsEmpty()) << scan;
    io::Landmarks clicked = given;
    const Vec3 outwards = (given.at("cheilion_R") - given.at("cheilion_L")).normalized();
    clicked["cheilion_R"] = SurfaceTree(mesh).query(given.at("cheilion_R") + 0.02 * outwards).point;
    const auto doubts = landmark_doubts(clicked, mesh);
    ASSERT_EQ(doubts.size(), 1u) << scan;
    EXPECT_THAT(doubts[0], is_doubt_on("cheilion_R")) << scan;
  }
}

/// The landmarks as another person would set them: brows and jaw 5 mm off, equally on both sides.
io::Landmarks set_otherwise(io::Landmarks landmarks) {
  for (auto& [name, p] : landmarks) {
    if (!name.starts_with("ibug68_")) continue;
    const int k = std::stoi(name.substr(7));
    if (k < 17) p += Vec3(0, 0.003, -0.004);
    if (k >= 17 && k < 27) p += Vec3(0, 0.005, 0);
  }
  return landmarks;
}

TEST(LandmarkDoubts, AgainstLandmarksFoundOnTheScanTellABrowMovedByTenMillimetres) {
  const EmbeddedFace face = embedded_face();
  const io::Landmarks found = set_otherwise(face.landmarks);
  EXPECT_THAT(landmark_doubts(face.landmarks, found), IsEmpty()) << "another hand is no mistake";
  for (const char* name : {"ibug68_19", "ibug68_24", "ibug68_51", "ibug68_33", "ibug68_39"})
    for (const Vec3& by : {Vec3(0.01, 0, 0), Vec3(-0.006, -0.008, 0)}) {
      io::Landmarks given = face.landmarks;
      std::erase_if(given, [&](const auto& entry) { return !entry.first.starts_with("ibug68_"); });
      given.at(name) += by;
      const auto doubts = landmark_doubts(given, found);
      ASSERT_EQ(doubts.size(), 1u) << name;
      EXPECT_THAT(doubts[0], is_doubt_on(name));
    }
}

}  // namespace
}  // namespace hyperex::anatomy
