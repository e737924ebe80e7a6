// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/run/points_off.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/simulate/run/simulator.hpp"
#include "simulate/small_face.hpp"
#include "support/note_matchers.hpp"

namespace hyperex::simulate {
namespace {
using hyperex::test::is_note;
using hyperex::test::is_warning;
using hyperex::test::says;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// 2 mm off, and nothing that explains it.
FarthestPoint unexplained() {
  FarthestPoint point;
  point.name = "ibug68_57";
  point.off_m = 0.002;
  point.edge_m = 0.012;
  return point;
}

SimulationOptions driven_by(DriveBy by) {
  SimulationOptions options;
  options.drive.by = by;
  return options;
}

TEST(ReasonOff, IsNotGivenWhereNoneCanBeEstablished) {
  EXPECT_EQ(reason_of(unexplained(), driven_by(DriveBy::displacement), false), "");
  EXPECT_EQ(reason_of(unexplained(), driven_by(DriveBy::displacement), true), "");
  SimulationOptions measured = driven_by(DriveBy::muscles);
  measured.region.measured = Measured::all;
  EXPECT_EQ(reason_of(unexplained(), measured, false), "") << "no forces act";
}

TEST(ReasonOff, IsLikelyWhereNoneCanBeEstablished) {
  EXPECT_THAT(likely_reason(true), HasSubstr("contact acted"));
  EXPECT_THAT(likely_reason(false), AllOf(HasSubstr("no one cause"), HasSubstr("time.step_s")));
}

TEST(ReasonOff, IsThatOfForcesWhereContactActsToo) {
  EXPECT_THAT(reason_of(unexplained(), driven_by(DriveBy::muscles), true),
              AllOf(HasSubstr("drive.by = \"muscles\""), HasSubstr("Contact moves points too")));
  EXPECT_THAT(reason_of(unexplained(), driven_by(DriveBy::muscles), false),
              Not(HasSubstr("Contact")));
}

TEST(ReasonOff, IsAResultWhereAGainWasAskedFor) {
  SimulationOptions weaker = driven_by(DriveBy::muscles);
  EXPECT_FALSE(is_asked_for(unexplained(), weaker));
  weaker.muscles.gains = {{"side_L", 0.6}};
  EXPECT_TRUE(is_asked_for(unexplained(), weaker));
  for (const bool touched : {false, true})
    EXPECT_THAT(reason_of(unexplained(), weaker, touched),
                AllOf(HasSubstr("muscles.gain"), HasSubstr("a result and no fault")));
  FarthestPoint off_the_mesh = unexplained();
  off_the_mesh.from_mesh_m = 0.0436;
  EXPECT_FALSE(is_asked_for(off_the_mesh, weaker)) << "no gain explains it";
  weaker.drive.by = DriveBy::displacement;
  EXPECT_FALSE(is_asked_for(unexplained(), weaker)) << "no muscle drives it";
  weaker.drive.by = DriveBy::reactions;
  EXPECT_FALSE(is_asked_for(unexplained(), weaker)) << "its forces belong to no muscle";
  EXPECT_THAT(reason_of(unexplained(), weaker, false), HasSubstr("drive.by = \"reactions\""));
  weaker = driven_by(DriveBy::muscles);
  weaker.muscles.gains = {{"side_L", 1}};
  EXPECT_FALSE(is_asked_for(unexplained(), weaker)) << "it changes nothing";
  weaker.muscles.mirrored = true;
  EXPECT_THAT(reason_of(unexplained(), weaker, false), HasSubstr("muscles.mirrored changes"));
}

TEST(ReasonOff, IsAStepThatIsTooLongForTheMotion) {
  FarthestPoint point = unexplained();
  point.between_steps_m = 0.0018;
  SimulationOptions options = driven_by(DriveBy::displacement);
  options.time.step_s = 0.1;
  EXPECT_THAT(reason_of(point, options, false),
              AllOf(HasSubstr("time.step_s = 0.1"), HasSubstr("1.80 mm")));
  options.model.strain = Strain::finite;
  EXPECT_EQ(reason_of(point, options, false), "") << "its steps are others";
  options.model.strain = Strain::linear;
  point.between_steps_m = 0.001;
  EXPECT_EQ(reason_of(point, options, false), "") << "it explains half of the distance";
}

TEST(ReasonOff, IsThatTheMeshEndsBeforeThePoint) {
  FarthestPoint point = unexplained();
  point.from_mesh_m = 0.0436;
  for (const DriveBy by : {DriveBy::displacement, DriveBy::muscles})
    EXPECT_THAT(reason_of(point, driven_by(by), false),
                AllOf(HasSubstr("44 mm from ibug68_57"), HasSubstr("mesh.trim_border_mm")));
  point.from_mesh_m = 0.011;
  EXPECT_EQ(reason_of(point, driven_by(DriveBy::displacement), false), "") << "within an edge";
  point.edge_m = 0.003;
  point.from_mesh_m = 0.008;
  EXPECT_EQ(reason_of(point, driven_by(DriveBy::displacement), false), "") << "a marker's height";
}

TEST(ReasonOff, IsAPointCloserThanTheElementsThatMovesDifferently) {
  FarthestPoint point = unexplained();
  point.neighbour = "ibug68_58";
  point.neighbour_m = 0.0042;
  const std::string reason = reason_of(point, driven_by(DriveBy::displacement), false);
  EXPECT_THAT(reason, AllOf(HasSubstr("4.2 mm from ibug68_58 (inner part of the lower lip, right)"),
                            HasSubstr("12.0 mm")));
  EXPECT_NE(reason_of(point, driven_by(DriveBy::muscles), false), reason)
      << "forces meet such points as exactly as others";
  point.neighbour_m = 0.0125;
  EXPECT_EQ(reason_of(point, driven_by(DriveBy::displacement), false), "");
  point.neighbour_m = 0.0005;
  EXPECT_THAT(reason_of(point, driven_by(DriveBy::muscles), false), HasSubstr("from ibug68_58"))
      << "at one place no drive meets both";
}

/// No drive tells them apart: displacement meets them no better.
TEST(ReasonOff, IsAPointThatTheSameNodesCarry) {
  FarthestPoint point = unexplained();
  point.neighbour = "ibug68_47";
  point.neighbour_m = 0.0125;
  point.shared = 0.86;
  for (const DriveBy by : {DriveBy::displacement, DriveBy::muscles})
    EXPECT_THAT(reason_of(point, driven_by(by), false),
                AllOf(HasSubstr("same nodes"), HasSubstr("ibug68_47"), HasSubstr("12.5 mm"),
                      Not(HasSubstr("drive.by"))));
  point.shared = 0.5;
  EXPECT_THAT(reason_of(point, driven_by(DriveBy::muscles), false), HasSubstr("drive.by"));
}

TEST(ReasonOff, IsThatForcesDriveIt) {
  EXPECT_THAT(reason_of(unexplained(), driven_by(DriveBy::muscles), false),
              HasSubstr("drive.by = \"muscles\""));
  EXPECT_THAT(reason_of(unexplained(), driven_by(DriveBy::reactions), false),
              HasSubstr("drive.by = \"reactions\""));
  SimulationOptions weaker = driven_by(DriveBy::muscles);
  weaker.muscles.gains = {{"zyg_major_L", 0.5}};
  EXPECT_THAT(reason_of(unexplained(), weaker, false), HasSubstr("muscles.gain"));
  weaker.muscles.gains = {{"zyg_major_L", 1}};
  EXPECT_THAT(reason_of(unexplained(), weaker, false), HasSubstr("drive.by"));
}

class FarthestPointOfAFace : public testing::Test {
 protected:
  /// Of the middle of the lower lip, its neighbour and the chin. The middle alone moves: by 6 mm in
  /// the second of samples that are 0.05 s apart.
  FarthestPoint found(double step_s, const std::vector<double>& off_m) const {
    const AlignedMotion motion =
        test::motion_of(landmarks_, 6, 20, [](const std::string& name, const Vec3&, int k) -> Vec3 {
          return Vec3(0, k == 1 && name == "ibug68_57" ? 0.006 : 0, 0);
        });
    const DrivenPoints driven(face_.mesh, landmarks_, motion,
                              {"ibug68_57", "ibug68_58", "ibug68_8"});
    return farthest_point(face_.mesh, driven, PointCurve(motion, 1), {0, 0.05, 0.1}, step_s, off_m);
  }

  const test::SmallFace face_ = test::small_face();
  io::Landmarks landmarks_ = face_.landmarks;
};

TEST_F(FarthestPointOfAFace, IsTheOneThatIsFarthestOff) {
  const FarthestPoint chin = found(0.01, {0.001, 0, 0.002});
  EXPECT_EQ(chin.name, "ibug68_8");
  EXPECT_EQ(chin.off_m, 0.002);
  EXPECT_LT(chin.between_steps_m, 1e-9) << "it does not move";
  EXPECT_GT(chin.edge_m, 0.003);
  EXPECT_LT(chin.edge_m, 0.05);
}

TEST_F(FarthestPointOfAFace, SharesNodesWithTheNeighbourThatLiesOnThem) {
  EXPECT_LT(found(0.01, {0.002, 0, 0}).shared, 0.3) << "they lie on other nodes";
  landmarks_.at("ibug68_58") =
      landmarks_.at("ibug68_57") + 0.1 * (landmarks_.at("ibug68_58") - landmarks_.at("ibug68_57"));
  EXPECT_GT(found(0.01, {0.002, 0, 0}).shared, 0.7);
}

TEST_F(FarthestPointOfAFace, DepartsFromTheLineBetweenLongSteps) {
  EXPECT_NEAR(found(0.1, {0.002, 0, 0}).between_steps_m, 0.006, 1e-9);
  EXPECT_LT(found(0.05, {0.002, 0, 0}).between_steps_m, 1e-9) << "frames at the steps' ends";
}

TEST_F(FarthestPointOfAFace, HasTheNearestNeighbourThatMovesDifferently) {
  const FarthestPoint lip = found(0.05, {0.004, 0, 0});
  EXPECT_EQ(lip.neighbour, "ibug68_58");
  EXPECT_NEAR(lip.neighbour_m, (landmarks_.at("ibug68_57") - landmarks_.at("ibug68_58")).norm(),
              1e-12);
  EXPECT_EQ(found(0.05, {0.007, 0, 0}).neighbour, "") << "6 mm do not explain 7 mm";
  EXPECT_EQ(found(0.05, {0, 0, 0.004}).neighbour, "ibug68_57");
}

TEST_F(FarthestPointOfAFace, IsAsFarFromTheMeshAsFromTheSkin) {
  EXPECT_LT(found(0.05, {0, 0, 0.004}).from_mesh_m, 0.005);
  landmarks_["ibug68_8"].y() -= 0.02;
  const double expected =
      std::sqrt(SurfaceTree(face_.mesh.skin).query(landmarks_.at("ibug68_8")).squared_distance);
  EXPECT_GT(expected, 0.01);
  EXPECT_NEAR(found(0.05, {0, 0, 0.004}).from_mesh_m, expected, 1e-6);
}

TEST(PointsOff, NamesTheFarthestAndCountsTheOthers) {
  const std::vector<std::string> names = {"ibug68_48", "ibug68_54", "ibug68_8", "ibug68_57"};
  EXPECT_EQ(points_off_text(names, {0, 1e-5, 0, 0}, 1e-4), "");
  EXPECT_EQ(points_off_text(names, {0, 7e-4, 0, 0}, 1e-4),
            "1 driven point ends up to 0.70 mm from where it is driven: ibug68_54 (corner of the "
            "mouth, left)");
  EXPECT_EQ(points_off_text(names, {3e-4, 7e-4, 2e-4, 1e-5}, 1e-4),
            "3 driven points end up to 0.70 mm from where they are driven, the farthest: ibug68_54 "
            "(corner of the mouth, left), ibug68_48 (corner of the mouth, right)");
  EXPECT_THAT(points_off_text(names, {3e-4, 3e-3, 2e-4, 1e-5}, 1e-4), HasSubstr("ibug68_8 ("))
      << "all where the distance matters";
}

TEST(PointsOff, AreWithinWhatJitterMakesOrNot) {
  EXPECT_TRUE(is_within_jitter(0.21e-3, 0.2e-3));
  EXPECT_FALSE(is_within_jitter(0.21e-3, 0.07e-3));
  EXPECT_FALSE(is_within_jitter(0.21e-3, 0));
  EXPECT_FALSE(is_within_jitter(0.21e-3, std::nan(""))) << "a jitter that is not known";
  EXPECT_THAT(jitter_text(0.2e-3), HasSubstr("jitter of 0.20 mm alone"));
  EXPECT_THAT(jitter_text(0.2e-3), HasSubstr("up to 0.56 mm (95 %)"));
}

/// Points that shake by 4 mm from sample to sample are met to some 0.5 mm between the steps.
TEST_F(FarthestPointOfAFace, IsNoWarningWhereJitterExplainsIt) {
  const auto mesh = std::make_shared<const tissue::TissueMesh>(face_.mesh);
  SimulationOptions options;
  options.time.step_s = 0.01;
  const auto notes_of_samples = [&](int samples) {
    AlignedMotion shaking = test::mouth_opening(landmarks_, 10, samples, 30);
    for (std::size_t k = 1; k < shaking.motion.positions.size(); ++k)
      shaking.motion.positions[k].array() += k % 2 == 0 ? 0.004 : -0.004;
    return Simulator(mesh, landmarks_, shaking, options).run().report.notes;
  };
  EXPECT_THAT(notes_of_samples(25), AllOf(Contains(is_note("drive.points_off_by_jitter")),
                                          Not(Contains(is_warning("drive.points_off")))));
  EXPECT_THAT(notes_of_samples(15), Contains(is_warning("drive.points_off")))
      << "too short to measure its jitter";
}

TEST_F(FarthestPointOfAFace, IsExplainedInTheNoteOfARun) {
  const auto mesh = std::make_shared<const tissue::TissueMesh>(face_.mesh);
  const AlignedMotion opening = test::mouth_opening(landmarks_, 10, 13, 30);
  SimulationOptions options;
  options.time.step_s = 0.1;
  EXPECT_THAT(Simulator(mesh, landmarks_, opening, options).run().report.notes,
              Contains(AllOf(is_warning("drive.points_off"),
                             says("; between steps of time.step_s = 0.1"))));
  options.time.step_s = 0.01;
  options.drive.by = DriveBy::muscles;
  options.tissue.uniform[tissue::viscosity] = 1e6;
  EXPECT_THAT(
      Simulator(mesh, landmarks_, opening, options).run().report.notes,
      Contains(AllOf(is_warning("drive.points_off"), says("; with drive.by = \"muscles\""))));
  options.muscles.gains = {{"side_L", 0.5}};
  EXPECT_THAT(
      Simulator(mesh, landmarks_, opening, options).run().report.notes,
      AllOf(Contains(AllOf(is_note("drive.points_off_by_gain"), says("a result and no fault"))),
            Not(Contains(is_warning("drive.points_off")))));
}

}  // namespace
}  // namespace hyperex::simulate
