// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/misplaced_points.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "hyperex/motion/stabilise.hpp"
#include "support/note_matchers.hpp"

namespace hyperex::session {
namespace {
using test::is_about;
using test::is_warning;
using test::says;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::Optional;

io::Landmarks of_embedded_face() {
  return anatomy::embedded_face().landmarks;
}

/// The 68 points of the embedded face.
io::Landmarks of_68_points() {
  io::Landmarks out;
  for (const std::string& name : face::all_ibug()) out[name] = of_embedded_face().at(name);
  return out;
}

io::Landmarks of_the_mouth() {
  io::Landmarks out;
  for (const int k : {48, 54, 51, 57, 8, 58, 56})
    out[face::ibug(k)] = of_embedded_face().at(face::ibug(k));
  return out;
}

/// A motion of one sample, as a camera in front of the face sees it.
motion::Motion seen(const io::Landmarks& points) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Vec3(1, 2, 0).normalized()).matrix();
  motion::Motion m;
  m.time_s = {0};
  m.positions.emplace_back(Eigen::Index(points.size()), 3);
  for (const auto& [name, at] : points) {
    m.positions.front().row(Eigen::Index(m.names.size())) =
        (turn * at + Vec3(0.02, -0.03, 0.5)).transpose();
    m.names.push_back(name);
  }
  return m;
}

std::vector<std::string> names_off(const motion::Motion& m, const io::Landmarks& landmarks) {
  std::vector<std::string> names;
  for (const auto& point : misplaced_points(m, landmarks).points) names.push_back(point.name);
  return names;
}
std::vector<std::string> names_off(const io::Landmarks& recorded) {
  return names_off(seen(recorded), of_embedded_face());
}

TEST(MisplacedPoints, AreNamedWithTheirDistance) {
  io::Landmarks recorded = of_68_points();
  recorded["ibug68_54"] += Vec3(0.012, 0.016, 0);
  const MisplacedPoints found = misplaced_points(seen(recorded), of_embedded_face());
  ASSERT_EQ(found.points.size(), 1u);
  EXPECT_EQ(found.points.front().name, "ibug68_54");
  EXPECT_NEAR(1e3 * found.points.front().off_m, 20, 0.1) << "the point does not pull the fit";
  EXPECT_LT(found.others.rms_mm, 0.05);
  EXPECT_NEAR(found.others.scale, 1, 1e-3);
  EXPECT_EQ(found.others.common, 67u);
  EXPECT_THAT(misplaced_warning(found),
              Optional(AllOf(is_warning("recording.point_off"), is_about("motion.file"),
                             says("ibug68_54 (corner of the mouth, left) lies 20.0 mm"),
                             says("the other 67 points"))));
}

TEST(MisplacedPoints, AreNamedWithAxesThatSeemToBeExchanged) {
  motion::Motion m = seen(of_68_points());
  const int corner = m.index_of("ibug68_54");
  std::swap(m.positions.front()(corner, 1), m.positions.front()(corner, 2));
  const MisplacedPoints found = misplaced_points(m, of_embedded_face());
  ASSERT_EQ(found.points.size(), 1u);
  EXPECT_EQ(found.points.front().exchanged_axes, "y and z");
  EXPECT_LT(found.points.front().off_exchanged_m, 1e-4);
  EXPECT_THAT(misplaced_warning(found), Optional(says(" (0.0 mm with its y and z exchanged);")));
  m.positions.front()(corner, 0) += 0.02;
  EXPECT_EQ(misplaced_points(m, of_embedded_face()).points.front().exchanged_axes, "");
}

TEST(MisplacedPoints, IncludeAMarkerAtTheOrigin) {
  motion::Motion m = seen(of_68_points());
  m.positions.front().row(m.index_of("ibug68_54")).setZero();
  const MisplacedPoints found = misplaced_points(m, of_embedded_face());
  ASSERT_EQ(found.points.size(), 1u);
  EXPECT_EQ(found.points.front().name, "ibug68_54");
  EXPECT_GT(found.points.front().off_m, 0.4);
  EXPECT_LT(found.others.rms_mm, 0.05);
}

TEST(MisplacedPoints, AreNamedUpToThreeTheFarthestFirst) {
  io::Landmarks recorded = of_68_points();
  recorded["ibug68_54"].y() += 0.03;
  recorded["ibug68_30"].z() += 0.05;
  recorded["ibug68_19"].y() += 0.04;
  EXPECT_THAT(names_off(recorded), ElementsAre("ibug68_30", "ibug68_19", "ibug68_54"));
  recorded["ibug68_57"].y() -= 0.02;
  recorded["ibug68_8"].z() -= 0.025;
  const auto note = misplaced_warning(misplaced_points(seen(recorded), of_embedded_face()));
  ASSERT_TRUE(note);
  EXPECT_THAT(
      note,
      Optional(AllOf(says("5 points"), says("ibug68_30 (tip of the nose) lies 50.0 mm"),
                     says("ibug68_19 (middle of the brow, right) 40.0 mm"),
                     says("ibug68_54 (corner of the mouth, left) 30.0 mm"), says("and 2 more"))));
  EXPECT_THAT(note->text, Not(HasSubstr("ibug68_8")));
  EXPECT_EQ(misplaced_warning(MisplacedPoints{}), std::nullopt);
}

TEST(MisplacedPoints, AreNoneOnAFaceWithALongerChin) {
  io::Landmarks recorded = of_68_points();
  const double mouth = recorded["ibug68_48"].y();
  for (auto& [name, at] : recorded) at.y() -= 0.5 * std::max(0.0, mouth - at.y());
  EXPECT_THAT(names_off(recorded), IsEmpty()) << "neighbours differ alike";
}

TEST(MisplacedPoints, AreNoneWherePointsArePlacedDifferently) {
  io::Landmarks recorded = of_embedded_face();
  for (const char* name : {"ibug68_16", "glabella", "pogonion"}) recorded[name].y() += 0.02;
  EXPECT_THAT(names_off(recorded), IsEmpty());
  recorded["ibug68_16"].y() += 0.02;
  EXPECT_THAT(names_off(recorded), ElementsAre("ibug68_16"));
}

TEST(MisplacedPoints, OfFewCommonPointsAreFarOff) {
  io::Landmarks recorded = of_the_mouth();
  recorded["ibug68_54"].y() += 0.02;
  EXPECT_THAT(names_off(recorded), IsEmpty());
  recorded["ibug68_54"].y() += 0.02;
  EXPECT_THAT(names_off(recorded), ElementsAre("ibug68_54"));
  recorded.erase("ibug68_56");
  EXPECT_THAT(names_off(recorded), ElementsAre("ibug68_54"));
  recorded.erase("ibug68_58");
  EXPECT_THAT(names_off(recorded), IsEmpty()) << "five points do not tell which is wrong";
}

TEST(MisplacedPoints, AreNotThoseOfAnExchangedPair) {
  io::Landmarks recorded = of_68_points();
  std::swap(recorded["ibug68_48"], recorded["ibug68_54"]);
  EXPECT_THAT(names_off(recorded), IsEmpty());
}

TEST(MisplacedPoints, AreNoneOfRealRecordingsOnOtherPeople) {
  const std::filesystem::path data = std::filesystem::path(HYPEREX_SHARED_DIR) / "data";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "the shared recordings are not here";
  for (const char* file :
       {"rgbd/subject_A_mouth_open/truth_landmarks68_camera_m.csv",
        "rgbd/subject_A_talk/truth_landmarks68_camera_m.csv", "real/spacetime/smile_mm.csv"}) {
    const motion::Motion m = motion::stabilise(motion::read_motion(data / file)).motion;
    EXPECT_THAT(names_off(m, of_embedded_face()), IsEmpty()) << file;
    for (const char* scan : {"ict/subject_A_landmarks.json", "ict/subject_D_landmarks.json",
                             "ict/subject_E_landmarks.json", "real/spacetime/landmarks.json",
                             "real/animface/cheeks_landmarks.json"})
      EXPECT_THAT(names_off(m, io::read_landmarks(data / scan)), IsEmpty()) << file << scan;
  }
}

}  // namespace
}  // namespace hyperex::session
