// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/scan_doubts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/anatomy/landmarks.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/io/scan.hpp"
#include "support/half_face.hpp"
#include "support/note_matchers.hpp"
#include "support/refusal.hpp"
#include "unit/anatomy/another_face.hpp"

namespace hyperex::anatomy {
namespace {
namespace fs = std::filesystem;
using test::half_face;
using test::is_about;
using test::is_warning;
using test::says;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

io::Landmarks on_side(const io::Landmarks& all, bool left) {
  io::Landmarks some;
  for (const auto& [name, p] : all)
    if ((left ? p.x() : -p.x()) > -1e-3) some[name] = p;
  return some;
}

io::Landmarks named(const io::Landmarks& all, const std::vector<std::string>& names) {
  io::Landmarks some;
  for (const auto& name : names) some[name] = all.at(name);
  return some;
}

const std::vector<std::string> kFourOfTheRight = {"exocanthion_R", "endocanthion_R", "pronasale",
                                                  "cheilion_R"};

auto says_missing(const std::string& side) {
  return AllOf(HasSubstr("the " + side + " half of the face is missing from the scan: "),
               HasSubstr(" of 37 named places"));
}

std::string missing(const io::Landmarks& given, const io::Landmarks& all, const TriMesh& scan) {
  return half_missing(given, all, scan).value_or("");
}

TEST(ScanDoubts, NameTheHalfThatIsMissing) {
  const EmbeddedFace face = embedded_face();
  for (const bool left : {false, true}) {
    const io::Landmarks given = on_side(face.landmarks, left);
    EXPECT_THAT(missing(given, face.landmarks, half_face(face.mesh, left)),
                says_missing(left ? "right" : "left"));
    EXPECT_THAT(missing(given, face.landmarks, face.mesh), IsEmpty()) << "a whole scan";
  }
}

/// Landmarks that were not given are placed on the border, and are no evidence.
TEST(ScanDoubts, NameItByFourLandmarks) {
  const EmbeddedFace face = embedded_face();
  const TriMesh half = half_face(face.mesh, false);
  const io::Landmarks four = named(face.landmarks, kFourOfTheRight);
  const CompletedLandmarks completed = complete_landmarks(four, half);
  EXPECT_THAT(missing(four, completed.landmarks, half), says_missing("left"));
  EXPECT_THAT(missing(four, face.landmarks, face.mesh), IsEmpty()) << "a whole scan";
  io::Landmarks three = four;
  three.erase("pronasale");
  EXPECT_THAT(missing(three, face.landmarks, half), IsEmpty()) << "too few to tell";
}

/// So are those of a search, which puts them on the scan.
TEST(ScanDoubts, NameItByLandmarksFoundOnTheBorder) {
  const EmbeddedFace face = embedded_face();
  const TriMesh half = half_face(face.mesh, true);
  const SurfaceTree tree(half);
  io::Landmarks found;
  for (const auto& [name, p] : face.landmarks) found[name] = tree.query(p).point;
  EXPECT_THAT(missing(found, face.landmarks, half), says_missing("right"));
}

TEST(ScanDoubts, AScanThatEndsInOneCheekHasBothHalves) {
  const EmbeddedFace face = embedded_face();
  const TriMesh cut = test::part_of(face.mesh, [](const Vec3& p) { return p.x() < 0.03; });
  EXPECT_THAT(missing(on_side(face.landmarks, false), face.landmarks, cut), IsEmpty());
}

TEST(ScanDoubts, GivenLandmarksOfAMissingHalfAreRefusedInOneSentence) {
  const EmbeddedFace face = embedded_face();
  const TriMesh half = half_face(face.mesh, false);
  const std::string said =
      test::refusal([&] { complete_landmarks(face.landmarks, half, "l.json"); });
  EXPECT_THAT(said, AllOf(HasSubstr("l.json: the left half of the face is missing from the scan, "
                                    "or its landmarks are misplaced: "),
                          HasSubstr(" of 37 landmarks of the subject's left side are 1"),
                          Not(HasSubstr("\n"))));
}

TEST(ScanDoubts, AMissingHalfIsNotBlamedForOtherLandmarks) {
  const std::map<std::string, double> good = {{"exocanthion_R", 0},    {"cheilion_R", 0},
                                              {"exocanthion_L", 0.04}, {"cheilion_L", 0.03},
                                              {"endocanthion_L", 0},   {"pronasale", 0}};
  EXPECT_THAT(half_missing_problem(good).value_or(""),
              HasSubstr("2 of 3 landmarks of the subject's left side are 30 to 40 mm"));
  const auto with = [&](const std::string& name, double off_m) {
    std::map<std::string, double> changed = good;
    changed[name] = off_m;
    return half_missing_problem(changed);
  };
  EXPECT_TRUE(with("exocanthion_R", 0.014));
  EXPECT_FALSE(with("exocanthion_R", 0.016)) << "one of the other half";
  EXPECT_FALSE(with("pronasale", 0.016)) << "one of the midline";
  EXPECT_FALSE(with("scar", 0.016)) << "one without a side";
  EXPECT_FALSE(with("cheilion_L", 0)) << "one alone";
  EXPECT_FALSE(with("alare_L", 0)) << "half of that side";
  EXPECT_TRUE(with("nasolabial_fold_middle_L", 0.02)) << "the fold has sides";
}

/// The face with its depth multiplied.
EmbeddedFace pressed(double share) {
  EmbeddedFace face = embedded_face();
  face.mesh.points.col(2) *= share;
  for (auto& [name, p] : face.landmarks) p.z() *= share;
  return face;
}

TEST(ScanDoubts, NameAScanWithoutDepth) {
  EXPECT_NEAR(nose_before_plane(embedded_face().landmarks).value_or(0), 0.435, 0.02);
  EXPECT_NEAR(nose_before_plane(another_face(1.5).landmarks).value_or(0), 0.41, 0.04);
  for (const double share : {0.001, 0.1, 0.3}) {
    const EmbeddedFace face = pressed(share);
    const auto flat = flat_warning(face.landmarks);
    ASSERT_TRUE(flat) << share;
    EXPECT_THAT(*flat, AllOf(is_warning("scan.flat"), is_about("scan.file"),
                             says("at least 13 mm where the eyes are 89 mm wide")));
  }
  const EmbeddedFace half_as_deep = pressed(0.5);
  EXPECT_FALSE(flat_warning(half_as_deep.landmarks));
  EXPECT_EQ(missing(half_as_deep.landmarks, half_as_deep.landmarks, half_as_deep.mesh), "");
  io::Landmarks no_nose = pressed(0.1).landmarks;
  no_nose.erase("pronasale");
  no_nose.erase("ibug68_30");
  EXPECT_FALSE(nose_before_plane(no_nose));
}

/// Half a face laid on it turns, so that the other half leaves it.
TEST(ScanDoubts, AShallowScanIsNotJudgedForItsHalves) {
  const EmbeddedFace face = pressed(0.4);
  ASSERT_FALSE(flat_problem(face.landmarks));
  for (const bool left : {false, true})
    EXPECT_THAT(missing(on_side(face.landmarks, left), face.landmarks, half_face(face.mesh, left)),
                IsEmpty());
}

TEST(ScanDoubts, AFlatSheetIsCompletedAndNamed) {
  const EmbeddedFace sheet = pressed(0.001);
  const io::Landmarks seven =
      named(sheet.landmarks, {"exocanthion_R", "endocanthion_R", "endocanthion_L", "exocanthion_L",
                              "pronasale", "cheilion_R", "cheilion_L"});
  const CompletedLandmarks completed = complete_landmarks(seven, sheet.mesh);
  const auto flat = flat_warning(completed.landmarks);
  ASSERT_TRUE(flat);
  EXPECT_THAT(*flat, AllOf(is_warning("scan.flat"), says("stands 0.0 mm before")));
}

/// The outline of the face is then farthest from where the others put it.
TEST(ScanDoubts, AFlatSheetIsRefusedByItsDepthNotByOneLandmark) {
  const EmbeddedFace sheet = pressed(0.1);
  EXPECT_THAT(test::refusal([&] { complete_landmarks(sheet.landmarks, sheet.mesh); }),
              HasSubstr("the scan is too flat for a face"));
  EmbeddedFace slipped = embedded_face();
  const Vec3 brow = slipped.landmarks.at("ibug68_17");
  slipped.landmarks["pronasale"] = slipped.landmarks["ibug68_30"] = brow;
  ASSERT_TRUE(flat_problem(slipped.landmarks));
  EXPECT_THAT(test::refusal([&] { complete_landmarks(slipped.landmarks, slipped.mesh); }),
              HasSubstr("from where the others put it"));
}

/// The half of a scan on one side of the midline, by the corners of eyes and mouth.
TriMesh half_by_corners(const TriMesh& scan, const io::Landmarks& landmarks, bool left) {
  const auto frame = face::face_frame_of_corners(landmarks);
  return test::part_of(scan, [&](const Vec3& p) { return (frame->local(p).x() > 0) == left; });
}

TEST(ScanDoubts, TellWholeFacesFromHalvesOnRealScans) {
  const fs::path data = fs::path(HYPEREX_SHARED_DIR) / "data";
  if (!fs::exists(data)) GTEST_SKIP() << "no " << data;
  for (const auto& [scan, landmarks] :
       {std::pair{"ict/subject_A_neutral_scan.ply", "ict/subject_A_landmarks.json"},
        {"ict/subject_D_neutral_scan.ply", "ict/subject_D_landmarks.json"},
        {"ict/subject_E_neutral_scan.ply", "ict/subject_E_landmarks.json"},
        {"real/humface.ply", "real/humface_landmarks.json"},
        {"real/spacetime/neutral.ply", "real/spacetime/landmarks.json"},
        {"real/animface/cheeks_scan.ply", "real/animface/cheeks_landmarks.json"}}) {
    const TriMesh mesh = io::read_scan(data / scan, io::LengthUnit::millimetre).mesh;
    const io::Landmarks all = io::read_landmarks(data / landmarks);
    const double nose = nose_before_plane(all).value_or(0);
    EXPECT_GT(nose, 0.3) << scan;
    EXPECT_LT(nose, 0.53) << scan;
    EXPECT_THAT(missing(all, all, mesh), IsEmpty()) << scan;
    for (const bool left : {false, true}) {
      io::Landmarks given = all;
      std::erase_if(given, [&](const auto& entry) {
        const std::string other = mirrored_landmark(entry.first);
        return other != entry.first && canonical_face().landmarks.contains(entry.first) &&
               (canonical_face().landmark(entry.first, canonical_face().mesh.points).x() > 0) !=
                   left;
      });
      EXPECT_THAT(missing(given, all, mesh), IsEmpty()) << scan;
      EXPECT_THAT(missing(given, all, half_by_corners(mesh, all, left)),
                  says_missing(left ? "right" : "left"))
          << scan;
    }
  }
}

}  // namespace
}  // namespace hyperex::anatomy
