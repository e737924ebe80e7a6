// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/driven_points.hpp"

#include <gmock/gmock.h>

#include "hyperex/face/ibug.hpp"

namespace hyperex::session {
namespace {
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// All 68 points, `stomion` and a point of the skull, in two samples. They are 10 mm apart.
motion::Motion whole_face() {
  motion::Motion m;
  for (int i = 0; i < 68; ++i) m.names.push_back(face::ibug(i));
  m.names.insert(m.names.end(), {"stomion", "head_1"});
  m.time_s = {0, 1};
  m.positions.assign(2, Points::Zero(70, 3));
  for (Points& at : m.positions) at.col(0) = Eigen::VectorXd::LinSpaced(70, 0, 0.69);
  return m;
}

motion::Motion moving(int point, double far_m) {
  motion::Motion m = whole_face();
  m.positions[1](point, 1) = far_m;
  return m;
}

std::vector<std::string> points_of(const scene::Scene& scene, const motion::Motion& m) {
  return driven_points(scene, m);
}

std::vector<std::string> ids(const scene::Scene& scene, const motion::Motion& m) {
  std::vector<Note> notes;
  note_left_out_points(scene, m, notes);
  std::vector<std::string> out;
  for (const Note& note : notes) out.push_back(note.id);
  return out;
}

TEST(DrivenPoints, AreThoseOfTheMouthWhereNothingElseMoves) {
  const scene::Scene scene;
  EXPECT_EQ(points_of(scene, whole_face()), scene.drive.points);
  EXPECT_EQ(points_of(scene, moving(19, 1.9e-3)), scene.drive.points) << "as noise does";
  EXPECT_THAT(ids(scene, whole_face()), testing::IsEmpty());
}

TEST(DrivenPoints, PartsThatMoveJoin) {
  const scene::Scene scene;
  const auto brows = points_of(scene, moving(19, 2.1e-3));
  EXPECT_EQ(brows.size(), scene.drive.points.size() + 10);
  EXPECT_THAT(brows, Contains("ibug68_26"));
  EXPECT_THAT(brows, Not(Contains("ibug68_36")));
  EXPECT_EQ(points_of(scene, moving(37, 3e-3)).size(), scene.drive.points.size() + 12);
  EXPECT_EQ(points_of(scene, moving(31, 2.9e-3)), scene.drive.points) << "carried by the lip";
  EXPECT_EQ(points_of(scene, moving(31, 3.1e-3)).size(), scene.drive.points.size() + 5);
  EXPECT_THAT(ids(scene, moving(37, 3e-3)), testing::ElementsAre("drive.parts_joined"));
}

TEST(DrivenPoints, PartsThatJoinAreSaidWithHowFarTheyMove) {
  motion::Motion m = moving(19, 2.84e-3);
  m.positions[1](31, 1) = 6.3e-3;
  std::vector<Note> notes;
  note_left_out_points(scene::Scene(), m, notes);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0].text,
            "driven in addition to the mouth, since they move: brows (2.8 mm), nostrils (6.3 mm)");
}

TEST(DrivenPoints, TheOutlineOfTheFaceIsSaidAndNotDriven) {
  const scene::Scene scene;
  EXPECT_EQ(points_of(scene, moving(3, 9e-3)), scene.drive.points);
  EXPECT_THAT(ids(scene, moving(3, 9e-3)), testing::ElementsAre("drive.measured_not_driven"));
}

TEST(DrivenPoints, TheChinThatDrivesIsNoPartOfTheOutlineThatDoesNot) {
  EXPECT_THAT(ids(scene::Scene(), moving(8, 9e-3)), testing::IsEmpty());
}

/// The text of `drive.measured_not_driven`; empty where there is none.
std::string not_driven(const scene::Scene& scene, const motion::Motion& m) {
  std::vector<Note> notes;
  note_left_out_points(scene, m, notes);
  for (const Note& note : notes)
    if (note.id == "drive.measured_not_driven") return note.text;
  return "";
}

/// Points that are called `names`, each moved by its number of millimetres, added to whole_face().
motion::Motion with_moving(const std::vector<std::pair<std::string, double>>& names) {
  motion::Motion m = whole_face();
  for (const auto& [name, far_mm] : names) {
    int row = m.index_of(name);
    if (row < 0) {
      row = int(m.names.size());
      m.names.push_back(name);
      for (Points& at : m.positions) {
        at.conservativeResize(row + 1, 3);
        at.row(row) << 0.01 * row, 0, 0;
      }
    }
    m.positions[1](row, 1) = 1e-3 * far_mm;
  }
  return m;
}

TEST(DrivenPoints, WhatElseMovesIsSaidAwayFromTheLipsFirst) {
  const scene::Scene scene;
  EXPECT_EQ(not_driven(scene, with_moving({{"ibug68_62", 6}, {"cheek_L", 3}, {"my_mark", 4.26}})),
            "recorded, but not driven: my_mark (4.3 mm), cheek_L (cheek, left; 3.0 mm), ibug68_62 "
            "(edge of the upper lip, middle; 6.0 mm); drive.points selects the driven points");
  EXPECT_EQ(not_driven(scene, with_moving({{"ibug68_3", 9}, {"glabella", 2.1}})),
            "recorded, but not driven: outline of the face (9.0 mm), glabella (between the "
            "brows; 2.1 mm); "
            "drive.points selects the driven points");
  EXPECT_EQ(not_driven(scene, with_moving({{"cheek_L", 1.9}})), "") << "as noise does";
}

TEST(DrivenPoints, ShortNamesAreNamedOnceAndThoseOfTheLipsLast) {
  const scene::Scene scene;
  motion::Motion m = with_moving({{"ibug68_3", 5}, {"ibug68_62", 9}});
  m.names[3] = "3";
  m.names[62] = "p62";
  EXPECT_THAT(not_driven(scene, m), AllOf(HasSubstr("3 (5.0 mm), "), HasSubstr("p62 (9.0 mm);")))
      << "no part of the face looks for a short name";
  EXPECT_LT(not_driven(scene, m).find("3 (5.0 mm)"), not_driven(scene, m).find("p62 ("));
  EXPECT_EQ(not_driven(scene, with_moving({{"ibug68_62", 3}, {"62", 3}})),
            not_driven(scene, with_moving({{"ibug68_62", 3}})));
}

TEST(DrivenPoints, WhatMovesAfterTheEndOfTheRunIsNotSaid) {
  // Each moves by 10 mm a second.
  const motion::Motion m = with_moving({{"ibug68_3", 10}, {"my_mark", 10}});
  scene::Scene scene;
  scene.time.end_s = 0.19;
  EXPECT_EQ(not_driven(scene, m), "");
  scene.time.end_s = 0.5;
  EXPECT_EQ(not_driven(scene, m),
            "recorded, but not driven: outline of the face (5.0 mm), my_mark (5.0 mm); "
            "drive.points selects the driven points");
  motion::Motion later = m;
  for (double& t : later.time_s) t += 20;
  EXPECT_EQ(not_driven(scene, later), not_driven(scene, m)) << "times count from the first sample";
}

TEST(DrivenPoints, OfManyThatMoveFourAreNamed) {
  std::vector<std::pair<std::string, double>> points = {{"ibug68_62", 8}};
  for (int i = 1; i <= 6; ++i) points.emplace_back("mark_" + std::to_string(i), 2 + i);
  EXPECT_EQ(not_driven(scene::Scene(), with_moving(points)),
            "recorded, but not driven: mark_6 (8.0 mm), mark_5 (7.0 mm), mark_4 (6.0 mm), mark_3 "
            "(5.0 mm), and 3 more; drive.points selects the driven points");
}

TEST(DrivenPoints, WhatNeedsNoDriveIsNotSaid) {
  scene::Scene scene;
  // A driven point under its other name, the slit between the lips, the skull, nostrils that a lip
  // carries along, and the vertices of a tracked mesh.
  motion::Motion m = with_moving({{"cheilion_L", 5},
                                  {"stomion", 5},
                                  {"head_1", 5},
                                  {"ibug68_31", 2.5},
                                  {"vertex_0", 5},
                                  {"vertex_1", 5},
                                  {"vertex_2", 5}});
  const int first = m.index_of("vertex_0");
  m.triangles.resize(1, 3);
  m.triangles << first, first + 1, first + 2;
  m.skull_points = {"head_1"};
  EXPECT_EQ(not_driven(scene, m), "");
  // A landmark that has two names is listed once.
  EXPECT_EQ(not_driven(scene, with_moving({{"ibug68_30", 3}, {"pronasale", 3}})),
            "recorded, but not driven: ibug68_30 (tip of the nose; 3.0 mm); drive.points selects "
            "the driven points");
}

TEST(DrivenPoints, APlaceThatDrivesUnderAnotherNameIsNotSaid) {
  const scene::Scene scene;
  motion::Motion m = with_moving({{"ibug68_8", 8}, {"pogonion", 8}});
  EXPECT_EQ(
      not_driven(scene, m),
      "recorded, but not driven: pogonion (chin; 8.0 mm); drive.points selects the driven points")
      << "a marker of its own";
  for (Points& at : m.positions) at.row(m.index_of("pogonion")) = at.row(m.index_of("ibug68_8"));
  EXPECT_EQ(not_driven(scene, m), "");
}

TEST(DrivenPoints, NamedOnesAreKept) {
  scene::Scene scene;
  scene.drive.points = {"ibug68_48"};
  scene.origins.emplace("drive.points", scene::Origin{});
  EXPECT_EQ(points_of(scene, moving(19, 9e-3)), scene.drive.points);
  EXPECT_THAT(ids(scene, moving(19, 9e-3)), testing::IsEmpty());
}

TEST(DrivenPoints, AllLeavesOutTheSkullAndTheSlit) {
  scene::Scene scene;
  scene.drive.all_points = true;
  motion::Motion recorded = whole_face();
  recorded.skull_points = {"head_1"};
  const auto all = points_of(scene, recorded);
  EXPECT_EQ(all.size(), 68u);
  EXPECT_THAT(all, Not(Contains("stomion")));
  EXPECT_THAT(all, Not(Contains("head_1")));
}

}  // namespace
}  // namespace hyperex::session
