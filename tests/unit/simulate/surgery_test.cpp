// SPDX-License-Identifier: GPL-3.0-or-later
// Bones that surgery moves, and the face that follows them.
#include <gmock/gmock.h>

#include <cmath>

#include "hyperex/core/error.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/fem/element/tet4.hpp"
#include "hyperex/metrics/peak_tissue.hpp"
#include "hyperex/metrics/soft_tissue_moves.hpp"
#include "hyperex/simulate/drive/osteotomy.hpp"
#include "hyperex/simulate/load/added_volume.hpp"
#include "hyperex/simulate/run/simulator.hpp"
#include "simulate/small_face.hpp"
#include "support/refusal.hpp"

namespace hyperex::simulate {
namespace {
using face::ibug;

BoneMove move_of(BonePart part, std::vector<double> move_m, BoneCut cut = BoneCut::standard,
                 std::vector<double> turn_deg = {0, 0, 0}) {
  return {.part = part, .cut = cut, .move_m = std::move(move_m), .turn_deg = std::move(turn_deg)};
}

class Surgery : public testing::Test {
 protected:
  Surgery() {
    options_.time.step_s = 0.01;
    options_.drive.by = DriveBy::muscles;
    options_.drive.points = {"ibug68_48", "ibug68_54", "ibug68_51", "ibug68_57", "ibug68_8"};
  }
  Simulator made(const std::vector<BoneMove>& bones) const {
    SimulationOptions options = options_;
    options.surgery.bones = bones;
    return Simulator(mesh_, face_.landmarks, motion_, options);
  }
  Points neutral(const std::vector<BoneMove>& bones) const {
    return made(bones).run().performance.neutral_displacement_m.cast<double>();
  }
  /// Along the axes of the face.
  Vec3 local(const Eigen::Ref<const Eigen::RowVector3d>& v) const {
    return frame_.face_from_scan() * v.transpose();
  }
  int vertex_at(const std::string& landmark) const {
    Eigen::Index best = 0;
    (mesh_->skin.points.rowwise() - face_.landmarks.at(landmark).transpose())
        .rowwise()
        .squaredNorm()
        .minCoeff(&best);
    return int(best);
  }
  Vec3 shift(const Points& skin, const std::string& landmark) const {
    return 1e3 * local(skin.row(vertex_at(landmark)));
  }

  const test::SmallFace face_ = test::small_face(2);
  const std::shared_ptr<const tissue::TissueMesh> mesh_ =
      std::make_shared<const tissue::TissueMesh>(face_.mesh);
  const face::FaceFrame frame_ = face::face_frame(face_.landmarks);
  const AlignedMotion motion_ = test::mouth_opening(face_.landmarks, 6, 5, 30);
  SimulationOptions options_;
};

TEST_F(Surgery, AllBonesTogetherMoveTheFaceRigidly) {
  for (const bool border : {true, false}) {
    options_.support.border_held = border;
    const Points moved =
        neutral({move_of(BonePart::skull, {0.002, -0.003, 0.006}),
                 move_of(BonePart::mandible, {0.002, -0.003, 0.006}, BoneCut::whole)});
    for (Eigen::Index v = 0; v < moved.rows(); ++v)
      EXPECT_LT((local(moved.row(v)) - Vec3(0.002, -0.003, 0.006)).norm(), 1e-6 * 0.007 + 1e-9)
          << v;
  }
}

TEST_F(Surgery, AllBonesTogetherTurnTheFaceRigidlyAtFiniteStrain) {
  options_.model.strain = Strain::finite;
  options_.solver.finite_tolerance = 1e-8;
  options_.time.end_s = 0.04;
  const std::vector<BoneMove> bones = {
      move_of(BonePart::skull, {0, 0, 0.004}, BoneCut::standard, {12, -5, 8}),
      move_of(BonePart::mandible, {0, 0, 0.004}, BoneCut::whole, {12, -5, 8})};
  const Points moved = neutral(bones);
  const Osteotomies cuts(bones, face_.landmarks);
  for (Eigen::Index v = 0; v < moved.rows(); ++v) {
    const Vec3 at = mesh_->skin.points.row(v);
    EXPECT_LT((cuts.cranium() * at - at - moved.row(v).transpose()).norm(), 1e-6) << v;
  }
}

TEST_F(Surgery, AMandibleThatMovesTakesTheChinAndNotTheNose) {
  const Points moved = neutral({move_of(BonePart::mandible, {0, 0, 0.006})});
  EXPECT_GT(shift(moved, ibug(8)).z(), 4.5);
  EXPECT_LT(shift(moved, ibug(8)).z(), 6.1);
  const double lip = shift(moved, ibug(57)).z();
  EXPECT_GT(lip, 2);
  EXPECT_LT(lip, shift(moved, ibug(8)).z());
  EXPECT_LT(shift(moved, ibug(30)).norm(), 0.5);
  EXPECT_LT(shift(moved, ibug(27)).norm(), 0.05);
}

TEST_F(Surgery, AChinThatMovesTakesLessOfTheJaw) {
  const Points jaw = neutral({move_of(BonePart::mandible, {0, 0, 0.006})});
  const Points chin = neutral({move_of(BonePart::chin, {0, 0, 0.006})});
  EXPECT_GT(shift(chin, ibug(8)).z(), 3.5);
  EXPECT_LT(shift(chin, ibug(57)).z(), 0.7 * shift(jaw, ibug(57)).z());
  EXPECT_LT(shift(chin, ibug(5)).norm(), 0.7 * shift(jaw, ibug(5)).norm());
}

TEST_F(Surgery, AMaxillaThatMovesTakesTheUpperLip) {
  const Points moved = neutral({move_of(BonePart::maxilla, {0, 0, 0.005})});
  EXPECT_GT(shift(moved, ibug(33)).z(), 1.0);
  EXPECT_GT(shift(moved, ibug(51)).z(), 0.5);
  EXPECT_LT(shift(moved, ibug(8)).norm(), 0.5);
  EXPECT_LT(shift(moved, ibug(27)).norm(), 0.3);
}

TEST_F(Surgery, TheRecordedForcesActOnTheFaceAfterwards) {
  const SimulationResult before = made({}).run();
  const SimulationResult after = made({move_of(BonePart::mandible, {0, 0, 0.004})}).run();
  EXPECT_EQ(before.performance.neutral_displacement_m.rows(), 0);
  const PointsF& rest = after.performance.neutral_displacement_m;
  ASSERT_EQ(rest.rows(), mesh_->skin.points.rows());
  EXPECT_LT((after.performance.skin_displacement_m[0] - rest).cwiseAbs().maxCoeff(), 1e-6)
      << "it begins at rest on the moved bones";
  // At small strain the motion is the same, but that the jaw turns from where it now lies.
  constexpr std::size_t peak = 2;
  const PointsF more = after.performance.skin_displacement_m[peak] - rest -
                       before.performance.skin_displacement_m[peak];
  const Eigen::Matrix3d turn = before.performance.jaw_now_from_rest[peak].linear();
  const Vec3 by_turn = turn * (0.004 * frame_.z) - 0.004 * frame_.z;
  const int at_chin = vertex_at(ibug(8));
  EXPECT_GT(by_turn.norm(), 2e-4);
  EXPECT_LT(more.rowwise().norm().maxCoeff(), 1.2 * by_turn.norm());
  EXPECT_LT((more.row(at_chin).cast<double>().transpose() - by_turn).norm(), 0.3 * by_turn.norm())
      << 1e3 * more.row(at_chin) << " and " << 1e3 * by_turn.transpose();
  EXPECT_LT(more.row(vertex_at(ibug(27))).norm(), 1e-5);
  const Vec3 chin = face_.landmarks.at(ibug(8));
  EXPECT_NEAR(local((after.performance.jaw_now_from_rest[0] * chin - chin).transpose()).z(), 0.004,
              1e-9)
      << "the teeth are drawn where they are";
}

TEST_F(Surgery, MovesAddUpAndTheChinGoesWithTheMandible) {
  const Osteotomies cuts(
      {move_of(BonePart::mandible, {0, 0, 0.006}), move_of(BonePart::chin, {0, 0.002, 0.003})},
      face_.landmarks);
  const Vec3 chin = face_.landmarks.at(ibug(8));
  const Vec3 by = cuts.motion(Bone::mandible, chin) * chin - chin;
  EXPECT_LT((local(by.transpose()) - Vec3(0, 0.002, 0.009)).norm(), 1e-12);
  EXPECT_LT((local((cuts.lower_teeth() * chin - chin).transpose()) - Vec3(0, 0, 0.006)).norm(),
            1e-12);
  const Vec3 condyle = JawHinge(face_.landmarks, nullptr).centre;
  EXPECT_TRUE(cuts.motion(Bone::mandible, condyle).isApprox(Eigen::Isometry3d::Identity()))
      << "behind the cut";
  EXPECT_TRUE(cuts.motion(Bone::skull, chin).isApprox(Eigen::Isometry3d::Identity()));
  EXPECT_TRUE(cuts.upper_teeth().isApprox(Eigen::Isometry3d::Identity()));
}

TEST_F(Surgery, AMaxillaEndsInFrontOfThePterygoidPlates) {
  const Osteotomies cuts({move_of(BonePart::maxilla, {0, 0, 0.005})}, face_.landmarks);
  const Vec3 nose = frame_.local(face_.landmarks.at(ibug(33)));
  const Vec3 condyles = frame_.local(JawHinge(face_.landmarks, nullptr).centre);
  const auto moved = [&](double share) {
    const Vec3 at(0.03, nose.y(), nose.z() + share * (condyles.z() - nose.z()));
    return !cuts.motion(Bone::skull, frame_.world(at)).isApprox(Eigen::Isometry3d::Identity());
  };
  EXPECT_TRUE(moved(0));
  EXPECT_TRUE(moved(0.45));
  EXPECT_FALSE(moved(0.55));
  EXPECT_FALSE(moved(1));
}

TEST_F(Surgery, TurnsHaveTheSignsThatTheyAreDescribedWith) {
  const auto turned = [&](std::vector<double> degrees, const Vec3& offset) {
    const Osteotomies cuts({move_of(BonePart::mandible, {0, 0, 0}, BoneCut::whole, degrees)},
                           face_.landmarks);
    const Vec3 at = JawHinge(face_.landmarks, nullptr).centre + offset;
    return local((cuts.motion(Bone::mandible, at) * at - at).transpose());
  };
  EXPECT_LT(turned({5, 0, 0}, 0.08 * frame_.z).y(), -0.005) << "the front turns down";
  EXPECT_GT(turned({0, 5, 0}, 0.08 * frame_.z).x(), 0.005) << "the front turns to the left";
  EXPECT_GT(turned({0, 0, 5}, 0.05 * frame_.x).y(), 0.003) << "the left side turns up";
}

TEST_F(Surgery, ACutMayBeShifted) {
  BoneMove chin = move_of(BonePart::chin, {0, 0, 0.006});
  const Vec3 lower = frame_.world(frame_.local(face_.landmarks.at(ibug(8))) + Vec3(0, 0.004, 0));
  EXPECT_FALSE(Osteotomies({chin}, face_.landmarks)
                   .motion(Bone::mandible, lower)
                   .isApprox(Eigen::Isometry3d::Identity()));
  chin.cut_shift_m = -0.02;
  EXPECT_TRUE(Osteotomies({chin}, face_.landmarks)
                  .motion(Bone::mandible, lower)
                  .isApprox(Eigen::Isometry3d::Identity()));
}

TEST_F(Surgery, IsRefusedWhereDrivenPointsWouldStayBehindOrACutBelongsToAnotherBone) {
  const auto refused = [&] { return hyperex::test::refusal([&] { check(options_); }); };
  options_.surgery.bones = {move_of(BonePart::chin, {0, 0, 0.006})};
  options_.drive.by = DriveBy::displacement;
  EXPECT_THAT(refused(), testing::HasSubstr("drive.by = muscles"));
  options_.drive.by = DriveBy::muscles;
  options_.surgery.bones[0].cut = BoneCut::bsso;
  EXPECT_THAT(refused(),
              testing::AllOf(testing::HasSubstr("surgery.bone[0].cut"),
                             testing::HasSubstr("standard or genioplasty for the chin")));
  options_.surgery.bones[0].cut = BoneCut::whole;
  EXPECT_THAT(refused(), testing::HasSubstr("for the chin"));
  options_.surgery.bones[0].part = BonePart::mandible;
  EXPECT_NO_THROW(check(options_));
}

TEST_F(Surgery, TheCartilageOfTheNoseBendsWithTheMaxilla) {
  const Osteotomies cuts({move_of(BonePart::maxilla, {0.001, 0.003, 0.005})}, face_.landmarks);
  const auto local_at = [&](int k) { return frame_.local(face_.landmarks.at(ibug(k))); };
  const double cut = local_at(33).y() + 0.006, bone = (local_at(28).y() + local_at(29).y()) / 2,
               wings = std::abs(local_at(35).x() - local_at(31).x()) / 2;
  const auto moved = [&](double x, double height) {
    const Vec3 at = frame_.world({x, height, local_at(30).z()});
    return local(cuts.displacement_of_skull(at).transpose());
  };
  EXPECT_LT((moved(0, cut - 1e-6) - Vec3(0.001, 0.003, 0.005)).norm(), 1e-9) << "on the maxilla";
  EXPECT_LT((moved(0, cut + 1e-6) - Vec3(0.001, 0, 0.005)).norm(), 1e-5) << "the septum is cut";
  EXPECT_LT(moved(0, bone - 1e-6).norm(), 1e-9) << "clamped at the nasal bones";
  EXPECT_EQ(moved(0, bone + 0.001).norm(), 0);
  // A cantilever at its half: 5 / 16 of the end's deflection.
  EXPECT_LT((moved(0, (cut + bone) / 2) - 5.0 / 16 * Vec3(0.001, 0, 0.005)).norm(), 1e-9);
  EXPECT_LT((moved(wings / 2, (cut + bone) / 2) - 5.0 / 32 * Vec3(0.001, 0, 0.005)).norm(), 1e-9);
  EXPECT_EQ(moved(1.01 * wings, (cut + bone) / 2).norm(), 0);
  const double behind = frame_.local(JawHinge(face_.landmarks, nullptr).centre).z();
  const Vec3 back = frame_.world({0, (cut + bone) / 2, behind});
  EXPECT_EQ(cuts.displacement_of_skull(back).norm(), 0) << "no cartilage";
}

TEST_F(Surgery, TheTipOfTheNoseFollowsTheMaxillaALittle) {
  const Points moved = neutral({move_of(BonePart::maxilla, {0, 0, 0.005})});
  EXPECT_GT(shift(moved, ibug(30)).z(), 0.5);
  EXPECT_LT(shift(moved, ibug(30)).z(), 0.6 * shift(moved, ibug(33)).z());
}

class AddedVolume : public Surgery {
 protected:
  AddedVolume() {
    // 0.3 times more about the chin, for one tetrahedron in full and for its neighbours in part.
    const Vec3 chin = face_.landmarks.at(ibug(8));
    const tissue::VolumeMesh& volume = mesh_->volume;
    for (Eigen::Index t = 0; t < volume.tets.rows(); ++t) {
      Vec3 at = Vec3::Zero();
      for (int k = 0; k < 4; ++k) at += volume.nodes.row(volume.tets(t, k)).transpose() / 4;
      const double share = std::exp(-(at - chin).squaredNorm() / (2 * 0.015 * 0.015));
      ratio_.push_back(1 + 0.3 * share);
      added_ml_ +=
          1e6 * 0.3 * share * fem::make_tet4(fem::corners_of(volume.nodes, volume.tets, t)).volume;
    }
  }
  SimulationResult with_volume(const std::vector<BoneMove>& bones = {}) const {
    SimulationOptions options = options_;
    options.tissue.volume_ratio = ratio_;
    options.surgery.bones = bones;
    return Simulator(mesh_, face_.landmarks, motion_, options).run();
  }
  std::vector<double> ratio_;
  double added_ml_ = 0;
};

TEST_F(AddedVolume, ShowsAtTheSkin) {
  const Performance before = made({}).run().performance, after = with_volume().performance;
  ASSERT_EQ(after.neutral_displacement_m.rows(), mesh_->skin.points.rows());
  const double shown = metrics::change_of_volume_ml(before, after);
  EXPECT_GT(shown, 0.75 * added_ml_);
  EXPECT_LT(shown, 1.25 * added_ml_);
  const Points rest = after.neutral_displacement_m.cast<double>();
  EXPECT_GT(shift(rest, ibug(8)).z(), 0.3);
  EXPECT_LT(shift(rest, ibug(27)).norm(), 0.1) << "far away";
}

TEST_F(AddedVolume, LeavesTheRecordedForcesAsTheyWere) {
  const Performance before = made({}).run().performance, after = with_volume().performance;
  for (std::size_t f = 0; f < before.skin_displacement_m.size(); ++f)
    EXPECT_LT((after.skin_displacement_m[f] - after.neutral_displacement_m -
               before.skin_displacement_m[f])
                  .cwiseAbs()
                  .maxCoeff(),
              1e-6)
        << "frame " << f;
}

TEST_F(AddedVolume, AddsUpWithMovedBones) {
  const std::vector<BoneMove> bones = {move_of(BonePart::mandible, {0, 0, 0.004})};
  const Points both = with_volume(bones).performance.neutral_displacement_m.cast<double>();
  const Points volume = with_volume().performance.neutral_displacement_m.cast<double>();
  EXPECT_LT((both - volume - neutral(bones)).cwiseAbs().maxCoeff(), 1e-7);
}

TEST_F(AddedVolume, IsNearlyTheSameAtFiniteStrain) {
  const Points small = with_volume().performance.neutral_displacement_m.cast<double>();
  options_.model.strain = Strain::finite;
  options_.solver.finite_tolerance = 1e-6;
  options_.time.end_s = 0.04;
  const SimulationResult finite = with_volume();
  const Points large = finite.performance.neutral_displacement_m.cast<double>();
  EXPECT_LT((large - small).norm(), 0.15 * small.norm());
  EXPECT_GT((large - small).norm(), 1e-4 * small.norm()) << "another law";
  EXPECT_LT(
      (finite.performance.skin_displacement_m[0].cast<double>() - large).cwiseAbs().maxCoeff(),
      1e-6);
}

TEST_F(AddedVolume, GrowsThroughTheLayerAlone) {
  const auto growth = growth_through_layer(mesh_->volume, ratio_);
  for (std::size_t t = 0; t < growth.size(); t += 97) {
    EXPECT_NEAR(growth[t].determinant(), ratio_[t], 1e-12);
    const Vec3 stretches = growth[t].selfadjointView<Eigen::Lower>().eigenvalues();
    EXPECT_NEAR(stretches[0], 1, 1e-12);
    EXPECT_NEAR(stretches[1], 1, 1e-12);
  }
}

TEST_F(AddedVolume, IsRefusedWhereDrivenPointsWouldStayBehind) {
  options_.tissue.volume_ratio = ratio_;
  options_.drive.by = DriveBy::displacement;
  EXPECT_THAT(hyperex::test::refusal([&] { check(options_); }),
              testing::AllOf(testing::HasSubstr("tissue.region"),
                             testing::HasSubstr("drive.by = muscles")));
}

TEST_F(AddedVolume, MakesNoStressWhereItIsFree) {
  Performance free;
  free.nodes = mesh_->volume.nodes;
  free.tets = mesh_->volume.tets;
  free.material = options_.tissue.material(std::size_t(free.tets.rows()), {});
  Eigen::Matrix3d growth = Eigen::Matrix3d::Identity();
  growth(0, 0) = 1.02, growth(1, 2) = growth(2, 1) = 0.01;
  free.growth.assign(std::size_t(free.tets.rows()), growth);
  free.node_displacement_m = {(free.nodes * (growth - Eigen::Matrix3d::Identity())).cast<float>()};
  for (const Strain strain : {Strain::linear, Strain::finite}) {
    free.model.strain = strain;
    const metrics::PeakTissue tissue = metrics::peak_tissue(free);
    EXPECT_LT(tissue.von_mises_kpa->p99, 0.02) << "of 192 kPa";
    EXPECT_LT(std::abs(tissue.principal_strain->p99), 1e-4);
    if (tissue.finite) {
      EXPECT_NEAR(tissue.volume_ratio->median, 1, 1e-5);
    }
    free.growth.clear();
    EXPECT_GT(metrics::peak_tissue(free).von_mises_kpa->p99, 1);
    free.growth.assign(std::size_t(free.tets.rows()), growth);
  }
}

TEST_F(AddedVolume, ReachesTheFiguresOfTheTissue) {
  const Performance after = with_volume().performance;
  ASSERT_EQ(after.growth.size(), ratio_.size());
  EXPECT_NEAR(after.growth[11].determinant(), ratio_[11], 1e-12);
  EXPECT_TRUE(made({}).run().performance.growth.empty());
}

TEST_F(AddedVolume, ChangesNoForceThatWasFound) {
  Simulator simulator = made({});
  simulator.run();
  TissueValues more = options_.tissue;
  more.volume_ratio = ratio_;
  simulator.set_tissue(more);
  EXPECT_FALSE(simulator.run().report.forces_found_anew);
}

}  // namespace
}  // namespace hyperex::simulate
