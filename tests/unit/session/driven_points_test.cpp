// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/driven_points.hpp"

#include <gmock/gmock.h>

#include "hyperex/face/ibug.hpp"

namespace hyperex::session {
namespace {
using testing::Contains;
using testing::Not;

/// All 68 points, `stomion` and a point of the skull, in two samples.
motion::Motion whole_face() {
  motion::Motion m;
  for (int i = 0; i < 68; ++i) m.names.push_back(face::ibug(i));
  m.names.insert(m.names.end(), {"stomion", "head_1"});
  m.time_s = {0, 1};
  m.positions.assign(2, Points::Zero(70, 3));
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

TEST(DrivenPoints, TheOutlineOfTheFaceIsSaidAndNotDriven) {
  const scene::Scene scene;
  EXPECT_EQ(points_of(scene, moving(3, 9e-3)), scene.drive.points);
  EXPECT_THAT(ids(scene, moving(3, 9e-3)), testing::ElementsAre("drive.measured_not_driven"));
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
  scene.motion.rigid_points = {"head_1"};
  const auto all = points_of(scene, whole_face());
  EXPECT_EQ(all.size(), 68u);
  EXPECT_THAT(all, Not(Contains("stomion")));
  EXPECT_THAT(all, Not(Contains("head_1")));
}

}  // namespace
}  // namespace hyperex::session
