// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/check_alone.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <limits>

#include "hyperex/core/error.hpp"
#include "hyperex/face/canonical_face.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "hyperex/session/plausible.hpp"
#include "support/note_matchers.hpp"
#include "support/refusal.hpp"

namespace hyperex::session {
namespace {
using test::is_about;
using test::is_warning;
using test::says;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Optional;

/// Seven points of mouth and chin.
std::vector<std::string> mouth_and_chin() {
  std::vector<std::string> names;
  for (const int k : {48, 54, 51, 57, 8, 56, 58}) names.push_back(face::ibug(k));
  return names;
}

/// Two samples of these landmarks and of two points with names of their own.
motion::Motion still_points_of(const io::Landmarks& landmarks, double scale = 1,
                               const std::string& unit_note = "mm (as the columns say)") {
  motion::Motion m;
  m.source = "alone.csv";
  m.unit_note = unit_note;
  m.time_s = {0, 0.03};
  m.names = mouth_and_chin();
  m.names.insert(m.names.end(), {"head_1", "head_2"});
  Points at = Points::Constant(Eigen::Index(m.names.size()), 3, 0.05);
  for (std::size_t p = 0; p < m.names.size(); ++p)
    if (const auto found = landmarks.find(m.names[p]); found != landmarks.end())
      at.row(Eigen::Index(p)) = scale * found->second.transpose();
  m.positions = {at, at};
  return m;
}

/// The names of both sides exchanged.
motion::Motion exchanged_names(motion::Motion m) {
  for (std::string& name : m.names) name = face::mirrored_landmark(name);
  return m;
}

TEST(CheckAlone, ASizeThatNoFaceHasIsNamedWithItsUnit) {
  const auto at_scale = [](double scale, const std::string& unit_note) {
    return size_warning(still_points_of(average_face().landmarks, scale, unit_note));
  };
  EXPECT_THAT(at_scale(0.1, "mm (as the columns say)"),
              Optional(AllOf(is_warning("recording.size_implausible"), is_about("motion.unit"),
                             says("7 points"), says("0.1 times"),
                             says("as if in cm, and were read as mm (as the columns say)"))));
  EXPECT_THAT(at_scale(0.115, "mm (as stated)"), Optional(says("as if in cm")));
  EXPECT_THAT(at_scale(1 / 2.54, "cm (guessed)"), Optional(says("as if in inches")));
  EXPECT_THAT(at_scale(10, "cm (as stated)"), Optional(says("as if in mm")));
  EXPECT_THAT(at_scale(0.2, "mm (as stated)"), Optional(says("check its unit")));
  EXPECT_THAT(at_scale(0.1, ""), Optional(says("check its unit")));
  for (const double people : {0.55, 0.8, 1.0, 1.3, 1.7})
    EXPECT_EQ(at_scale(people, "mm (as stated)"), std::nullopt) << people;
}

TEST(CheckAlone, OnePointOrOnePlaceHasNoSize) {
  motion::Motion m = still_points_of(average_face().landmarks, 0.1);
  for (std::size_t p = 1; p < m.names.size(); ++p) m.names[p] = "own_" + std::to_string(p);
  EXPECT_EQ(size_warning(m), std::nullopt);
  m.names[1] = "cheilion_R";  // another name of ibug68_48
  EXPECT_EQ(size_warning(m), std::nullopt);
}

/// The names of a corner of the mouth and of the nostril beside it, or of a lip and an eye.
TEST(CheckAlone, ExchangedNamesOfOneSideAreAWarning) {
  const io::Landmarks average = average_face().landmarks;
  motion::Motion m;
  m.source = "alone.csv";
  m.time_s = {0};
  m.positions = {Points(68, 3)};
  for (int k = 0; k < 68; ++k) {
    m.names.push_back(face::ibug(k));
    m.positions[0].row(k) = average.at(m.names.back()).transpose();
  }
  EXPECT_THAT(check_alone(m), IsEmpty());
  motion::Motion moved = m;
  moved.positions[0](54, 1) += 0.012;  // people and trackers differ by as much
  EXPECT_THAT(check_alone(moved), IsEmpty());
  for (const auto& [a, b] : {std::pair{35, 54}, {51, 36}}) {
    motion::Motion exchanged = m;
    std::swap(exchanged.names[std::size_t(a)], exchanged.names[std::size_t(b)]);
    EXPECT_THAT(check_alone(exchanged),
                ElementsAre(AllOf(is_warning("recording.point_off"), is_about("motion.file"),
                                  says("2 points"), says(face::ibug(a)), says(face::ibug(b)),
                                  says("their names may be exchanged"))));
  }
}

TEST(CheckAlone, WarningsThatDoubtTheFiguresAreNotAll) {
  for (const char* id : {"recording.point_off", "recording.size_implausible", "sides.doubtful",
                         "sides.exchanged_pair", "recording.starts_in_expression",
                         "recording.ends_in_expression", "recording.nothing_moves"})
    EXPECT_TRUE(doubts_figures(make_warning(id, "a text"))) << id;
  for (const char* id : {"recording.coarse", "recording.short", "recording.time_unit_doubtful"})
    EXPECT_FALSE(doubts_figures(make_warning(id, "a text"))) << id;
}

TEST(CheckAlone, ExchangedSidesAreRefusedByThePointsOfTheMouth) {
  const motion::Motion right = still_points_of(average_face().landmarks);
  EXPECT_THAT(check_alone(right), IsEmpty());
  EXPECT_THAT(
      test::refusal([&] { check_alone(exchanged_names(right)); }),
      AllOf(HasSubstr("alone.csv: left and right are exchanged"), HasSubstr("an average face")));
}

TEST(CheckAlone, SidesThatAreExchangedLessSurelyAreAWarning) {
  motion::Motion m = still_points_of(average_face().landmarks);
  for (Points& sample : m.positions) sample(0, 2) += 0.02;  // a corner of the mouth
  EXPECT_THAT(check_alone(m), IsEmpty());
  EXPECT_THAT(check_alone(exchanged_names(m)),
              ElementsAre(AllOf(is_warning("sides.doubtful"), is_about("motion.file"),
                                says("7.7 mm rms"), says("4.9 mm with one axis negated"))));
}

/// One sample of all iBUG points of the average face, raised by so much.
motion::Motion average_sample(double up_m) {
  motion::Motion m;
  m.source = "alone.csv";
  m.time_s = {0};
  m.positions.emplace_back(68, 3);
  for (int i = 0; i < 68; ++i) {
    m.names.push_back(face::ibug(i));
    const Vec3 at = average_face().landmarks.at(m.names.back()) + Vec3(0, up_m, 0);
    m.positions[0].row(i) = at.transpose();
  }
  return m;
}

TEST(CheckAlone, OneExchangedPairAmongOthersIsRefused) {
  motion::Motion m = average_sample(0);
  EXPECT_THAT(check_alone(m), IsEmpty());
  m.positions[0].row(48).swap(m.positions[0].row(54));
  EXPECT_THAT(test::refusal([&] { check_alone(m); }),
              AllOf(HasSubstr("alone.csv: left and right are exchanged in ibug68_48 and ibug68_54 "
                              "(corner of the mouth): "),
                    HasSubstr("an average face"), HasSubstr("exchange their names")));
}

/// The fit follows the pair that is farther apart, whose names are wrong.
TEST(CheckAlone, PairsThatContradictEachOtherAreAWarning) {
  motion::Motion m = still_points_of(average_face().landmarks);
  EXPECT_EQ(exchanged_warning(m, average_face()), std::nullopt);
  std::swap(m.names[0], m.names[1]);  // the corners of the mouth
  EXPECT_THAT(check_alone(m),
              ElementsAre(AllOf(is_warning("sides.exchanged_pair"), is_about("motion.file"),
                                says("contradict each other"),
                                says("exchange the names of ibug68_48 and ibug68_54 (corner")),
                          is_warning("recording.point_off")));
}

/// By the place of the face's origin the two corners lie the other way round, or hardly so.
TEST(CheckAlone, APointWithTwoAxesExchangedIsNotCalledTheOtherSide) {
  for (const double up_m : {0.0, -0.03}) {
    motion::Motion m = average_sample(up_m);
    std::swap(m.positions[0](54, 0), m.positions[0](54, 1));
    EXPECT_THAT(check_alone(m),
                ElementsAre(AllOf(is_warning("recording.point_off"),
                                  says("ibug68_54 (corner of the mouth, left) lies"),
                                  says("with its x and y exchanged); correct it"))))
        << up_m;
    EXPECT_EQ(exchanged_warning(m, average_face()), std::nullopt);
  }
}

TEST(CheckAlone, TheFirstSampleWithTheMostPointsIsJudged) {
  motion::Motion m = still_points_of(average_face().landmarks);
  m.positions[0].topRows(5).setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_THAT(check_alone(m), IsEmpty());
  EXPECT_NE(test::refusal([&] { check_alone(exchanged_names(m)); }), "");
  for (Points& sample : m.positions) sample *= 0.1;
  EXPECT_THAT(check_alone(m), ElementsAre(is_warning("recording.size_implausible")));
}

TEST(CheckAlone, AGuessedUnitIsTold) {
  motion::Motion m;
  m.unit_note = "cm (guessed: the points then span 93 mm)";
  EXPECT_EQ(guessed_unit(m), m.unit_note);
  m.unit_note = "mm (as the columns say)";
  EXPECT_EQ(guessed_unit(m), "");
}

TEST(CheckAlone, TellsTheSidesOfRealPeople) {
  const auto data = std::filesystem::path(HYPEREX_SHARED_DIR) / "data";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "the shared faces are not here";
  for (const char* file : {"ict/subject_A_landmarks.json", "ict/subject_D_landmarks.json",
                           "ict/subject_E_landmarks.json", "real/spacetime/landmarks.json",
                           "real/animface/cheeks_landmarks.json"}) {
    const motion::Motion right =
        still_points_of(io::read_landmarks(data / file, io::LengthUnit::millimetre));
    EXPECT_THAT(check_alone(right), IsEmpty()) << file;
    EXPECT_THROW(check_alone(exchanged_names(right)), InputError) << file;
  }
}

TEST(CheckAlone, RealRecordingsAreFacesWhereverTheyBegin) {
  const auto data = std::filesystem::path(HYPEREX_SHARED_DIR) / "data";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "the shared recordings are not here";
  for (const char* file :
       {"real/spacetime/smile_mm.csv", "real/spacetime/smile_7_mm.csv",
        "rgbd/subject_A_mouth_open/truth_landmarks68_camera_m.csv",
        "rgbd/subject_A_talk/truth_landmarks68_camera_m.csv", "real/animface/cheeks_mm.csv"}) {
    motion::Motion m = motion::read_motion(data / file);
    EXPECT_THAT(check_alone(m), IsEmpty()) << file;
    while (m.positions.size() > 5) {
      m.positions.erase(m.positions.begin(), m.positions.begin() + 5);
      m.time_s.erase(m.time_s.begin(), m.time_s.begin() + 5);
      EXPECT_EQ(size_warning(m), std::nullopt) << file << " from " << m.time_s.front();
      EXPECT_NO_THROW(check_alone(m)) << file << " from " << m.time_s.front();
    }
  }
}

}  // namespace
}  // namespace hyperex::session
