// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/contact/obstacles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hyperex/core/progress.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/fem/form/assembler.hpp"
#include "hyperex/fem/solve/condensed_inverse.hpp"
#include "hyperex/simulate/contact/mouth_contact.hpp"
#include "hyperex/simulate/run/simulator.hpp"
#include "support/box_mesh.hpp"
#include "support/fem_support.hpp"
#include "unit/simulate/small_face.hpp"

namespace hyperex::simulate {
namespace {

constexpr double kYoung = 20e3, kPoisson = 0.3;

/// A quarter of an elastic block on a rigid base; its other side is that of the mouth. A rigid ball
/// touches it at its corner and is lowered like a jaw.
class PressedBlock {
 public:
  static constexpr double kSide = 0.008, kHeight = 0.006, kRadius = 0.010;

  explicit PressedBlock(int cells_a_side, double rest_depth_m = 0) {
    const int up = cells_a_side * 3 / 4;
    const hyperex::test::BoxMesh box =
        hyperex::test::box_mesh({cells_a_side, cells_a_side, up}, {kSide, kSide, kHeight});
    mesh_.volume.nodes = box.nodes;
    mesh_.volume.layers = up;
    const int level = (cells_a_side + 1) * (cells_a_side + 1);
    mesh_.volume.outer.points = box.nodes.topRows(level);
    stiffness_ =
        fem::assemble(box.nodes, box.tets,
                      hyperex::test::uniform_material(box.tets.rows(), kYoung, kPoisson, 0, 1000),
                      fem::ElementKind::tet4)
            .stiffness;
    for (int n = 0; n < int(box.nodes.rows()); ++n)
      for (int axis = 0; axis < 3; ++axis) {
        const bool base = box.nodes(n, 2) < 1e-9;
        const bool wall =
            axis < 2 && (box.nodes(n, axis) < 1e-9 || box.nodes(n, axis) > kSide - 1e-9);
        if (base || wall) prescribed_.push_back(3 * n + axis);
      }
    io::Landmarks landmarks;
    for (int k = 0; k < 68; ++k) landmarks[face::ibug(k)] = Vec3::Zero();
    const Vec3 centre(0, 0, kHeight + kRadius - rest_depth_m);
    places_ = std::make_shared<const ObstaclePlaces>(
        mesh_, landmarks,
        Obstacle{Obstacle::Kind::teeth, std::make_shared<const SphereDistance>(centre, kRadius),
                 true});
    surfaces_ = std::make_shared<const LipSurfaces>(mesh_, landmarks);
    factor_.emplace(stiffness_, prescribed_, "test");
  }

  MouthContact contact(std::vector<SkinCarrier> held = {}) {
    ObstacleSide side{places_, {}};
    for (Eigen::Index i = 0; i < places_->count(); ++i)
      side.carriers.push_back(places_->rest().row(i).head<2>().norm() < 0.0035
                                  ? SkinCarrier{{places_->nodes()[std::size_t(i)], 1.0}}
                                  : SkinCarrier());
    return MouthContact(
        surfaces_, {}, {}, {side}, std::move(held), 1e-9,
        [&](const std::vector<int>& nodes) { return fem::condensed_inverse(*factor_, nodes); });
  }

  MouthContact::Correction pressed(const MouthContact& contact, double depth_m) const {
    const PointsF skin(0, 3);
    const std::vector<Points> at{Points::Zero(places_->count(), 3)};
    Eigen::Isometry3d lowered = Eigen::Isometry3d::Identity();
    lowered.translation().z() = -depth_m;
    return contact.correct({skin, at, lowered});
  }

  /// Displacement of all unknowns under a correction's forces.
  Eigen::VectorXd moved(const MouthContact& contact, const Eigen::VectorXd& force) {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(stiffness_.cols());
    for (std::size_t n = 0; n < contact.nodes().size(); ++n)
      all.segment<3>(3 * contact.nodes()[n]) = force.segment<3>(3 * Eigen::Index(n));
    Eigen::VectorXd free = all(factor_->free());
    factor_->solve(free);
    all.setZero();
    all(factor_->free()) = free;
    return all;
  }

  static double pressing(const Eigen::VectorXd& force) {
    double sum = 0;
    for (Eigen::Index k = 2; k < force.size(); k += 3) sum -= 4 * force[k];
    return sum;
  }
  const ObstaclePlaces& places() const { return *places_; }

 private:
  tissue::TissueMesh mesh_;
  fem::SparseMatrix stiffness_;
  std::vector<int> prescribed_;
  std::shared_ptr<const ObstaclePlaces> places_;
  std::shared_ptr<const LipSurfaces> surfaces_;
  std::optional<fem::PartitionedFactor> factor_;
};

/// Hertz' law for a rigid ball, multiplied by the correction for a layer bonded to its base
/// (Dimitriadis et al., Biophys. J. 82, 2002, 2798).
double force_of_ball(double radius, double depth, double height, double young, double nu) {
  const double alpha = -(1.2876 - 1.4678 * nu + 1.3442 * nu * nu) / (1 - nu);
  const double beta = (0.6387 - 1.0277 * nu + 1.5164 * nu * nu) / (1 - nu);
  const double x = std::sqrt(radius * depth) / height, pi = std::numbers::pi;
  const double thin =
      1 - 2 * alpha / pi * x + 4 * std::pow(alpha / pi * x, 2) -
      8 / std::pow(pi, 3) * (std::pow(alpha, 3) + 4 * pi * pi / 15 * beta) * std::pow(x, 3) +
      16 * alpha / std::pow(pi, 4) * (std::pow(alpha, 3) + 3 * pi * pi / 5 * beta) * std::pow(x, 4);
  return 4 * young / (3 * (1 - nu * nu)) * std::sqrt(radius) * std::pow(depth, 1.5) * thin;
}

TEST(PressedBlock, FollowsHertzOnALayer) {
  constexpr double depth = 4e-4;  // a contact of 2 mm
  const double known =
      force_of_ball(PressedBlock::kRadius, depth, PressedBlock::kHeight, kYoung, kPoisson);
  double error[2];
  int i = 0;
  for (const int cells : {8, 16}) {
    PressedBlock block(cells);
    const MouthContact contact = block.contact();
    const auto pressed = block.pressed(contact, depth);
    EXPECT_LT(pressed.after_m, 1e-5);
    EXPECT_NEAR(pressed.before_m, depth, 1e-9);
    error[i++] = PressedBlock::pressing(pressed.force) / known - 1;
  }
  RecordProperty("error_at_1_mm", std::to_string(error[0]));
  RecordProperty("error_at_half_a_mm", std::to_string(error[1]));
  EXPECT_LT(std::abs(error[1]), 0.09) << "cells of half a millimetre";
  EXPECT_LT(std::abs(error[1]), 0.6 * std::abs(error[0]) + 0.02);
}

TEST(PressedBlock, MayLieAsDeepAsAtRest) {
  PressedBlock block(8, 3e-4);
  const MouthContact contact = block.contact();
  EXPECT_EQ(block.pressed(contact, 0).before_m, 0);
  EXPECT_EQ(block.pressed(contact, 0).force.norm(), 0) << "nothing jumps";
  const auto deeper = block.pressed(contact, 1e-4);
  EXPECT_NEAR(deeper.before_m, 1e-4, 1e-6);
  EXPECT_GT(PressedBlock::pressing(deeper.force), 0);
  EXPECT_EQ(block.pressed(contact, -1e-4).force.norm(), 0) << "nothing pulls";
}

TEST(PressedBlock, HeldPlacesStay) {
  PressedBlock block(8);
  constexpr double depth = 4e-4;
  const MouthContact free = block.contact();
  // Two cells from the corner, where the free surface sinks in.
  int at = -1;
  for (Eigen::Index i = 0; i < block.places().count(); ++i)
    if ((block.places().rest().row(i) - Eigen::RowVector3d(0.003, 0, PressedBlock::kHeight))
            .norm() < 1e-6)
      at = block.places().nodes()[std::size_t(i)];
  ASSERT_GE(at, 0);
  const MouthContact holding = block.contact({{{at, 1.0}}});
  const auto sunk = [&](const MouthContact& contact) {
    return block.moved(contact, block.pressed(contact, depth).force).segment<3>(3 * at).norm();
  };
  EXPECT_GT(sunk(free), 2e-5);
  EXPECT_LT(sunk(holding), 1e-3 * sunk(free));
  EXPECT_LT(block.pressed(holding, depth).after_m, 1e-5) << "and nothing passes all the same";
}

/// A face whose lips are pushed back towards a ball behind them.
class ObstacleOfAFace : public testing::Test {
 protected:
  ObstacleOfAFace() {
    Progress::silence(true);
    options_.drive.points = test::seven_points();
    options_.time.step_s = 0.01;
    options_.contact.teeth = true;
    const face::FaceFrame frame = face::face_frame(face_.landmarks);
    const Vec3 mouth = 0.5 * (face_.landmarks.at("ibug68_62") + face_.landmarks.at("ibug68_66"));
    Vec3 centre = mouth - 0.04 * frame.z;
    for (int k = 0; k < 20; ++k) centre += (least_gap_m(centre) - 5e-4) * frame.z;
    auto all = std::make_shared<std::vector<Obstacle>>();
    all->push_back(ball(centre));
    obstacles_ = all;
    motion_ = test::motion_of(face_.landmarks, 13, 30, [&](const std::string&, auto&, int k) {
      const double share = k < 6 ? k / 6.0 : (12 - k) / 6.0;
      return Vec3(-0.003 * share * frame.z);
    });
  }
  ~ObstacleOfAFace() override { Progress::silence(false); }

  static Obstacle ball(const Vec3& centre) {
    return {Obstacle::Kind::teeth, std::make_shared<const SphereDistance>(centre, 0.02), false};
  }
  double least_gap_m(const Vec3& centre) const {
    const ObstaclePlaces places(face_.mesh, face_.landmarks, ball(centre));
    double least = 1;
    Vec3 outward;
    for (Eigen::Index i = 0; i < places.count(); ++i)
      least = std::min(least, places.obstacle().shape->at(places.rest().row(i), outward));
    return least;
  }
  Simulator simulator() const {
    const std::shared_ptr<const tissue::TissueMesh> mesh(std::shared_ptr<void>(), &face_.mesh);
    Simulator out(mesh, face_.landmarks, motion_, options_);
    out.set_obstacles(obstacles_);
    return out;
  }
  static bool same(const SimulationResult& a, const SimulationResult& b) {
    return a.performance.skin_displacement_m == b.performance.skin_displacement_m &&
           a.performance.node_displacement_m == b.performance.node_displacement_m;
  }

  const test::SmallFace face_ = test::small_face();
  SimulationOptions options_;
  AlignedMotion motion_;
  std::shared_ptr<const std::vector<Obstacle>> obstacles_;
};

TEST_F(ObstacleOfAFace, KeepsTissueOut) {
  for (const DriveBy by : {DriveBy::displacement, DriveBy::muscles}) {
    options_.drive.by = by;
    const SimulationResult r = simulator().run();
    EXPECT_GT(r.report.contact.teeth_mm, 0.2);
    EXPECT_LT(r.report.contact.teeth_left_mm, 0.02);
    EXPECT_GT(r.report.contact.frames, 0);
    EXPECT_LT(r.report.contact.frames, 12);
    EXPECT_EQ(r.report.contact.overlap_mm, 0) << "lips are not asked for";
  }
}

TEST_F(ObstacleOfAFace, ProgressMovesThroughContactAtFiniteStrain) {
  options_.drive.gain = 0.7;
  options_.drive.by = DriveBy::displacement;
  options_.model.strain = Strain::finite;
  RunCallbacks callbacks;
  std::vector<double> shares;
  callbacks.progress = [&](double share) { shares.push_back(share); };
  const SimulationResult r = simulator().run(callbacks);
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_EQ(shares.back(), 1);
  const auto within = [&](double from, double to) {
    return std::ranges::count_if(shares, [&](double s) { return s > from && s < to; });
  };
  EXPECT_GE(within(0.4, 0.95), r.report.contact.frames) << "each frame takes its share";
  EXPECT_GE(within(0, 0.4), 6) << "and the motion before";
}

TEST_F(ObstacleOfAFace, KeepsTissueOutAtFiniteStrain) {
  options_.drive.gain = 0.7;  // pressed flat, tissue finds no equilibrium any more
  for (const DriveBy by : {DriveBy::displacement, DriveBy::muscles}) {
    options_.drive.by = by;
    options_.model.strain = Strain::linear;
    const SimulationResult linear = simulator().run();
    options_.model.strain = Strain::finite;
    const SimulationResult r = simulator().run();
    EXPECT_GT(r.report.contact.teeth_mm, 0.2);
    EXPECT_LT(r.report.contact.teeth_left_mm, 0.025);
    EXPECT_EQ(r.report.inverted_tets, 0);
    EXPECT_EQ(r.performance.skin_displacement_m.front().cwiseAbs().maxCoeff(), 0);
    options_.contact.teeth = false;
    const SimulationResult free = simulator().run();
    EXPECT_EQ(free.report.contact.frames, 0);
    EXPECT_EQ(free.performance.skin_displacement_m[1], r.performance.skin_displacement_m[1])
        << "what does not touch keeps its bits";
    options_.contact.teeth = true;
    // What contact changes is much the same for so small a press.
    const std::size_t f = 6;
    const SimulationOptions finite = options_;
    options_.model.strain = Strain::linear;
    options_.contact.teeth = false;
    const SimulationResult linear_free = simulator().run();
    options_ = finite;
    const PointsF change =
        r.performance.skin_displacement_m[f] - free.performance.skin_displacement_m[f];
    const PointsF linear_change =
        linear.performance.skin_displacement_m[f] - linear_free.performance.skin_displacement_m[f];
    EXPECT_GT(change.norm(), 0.5 * linear_change.norm());
    EXPECT_LT(change.norm(), 2 * linear_change.norm());
  }
}

TEST_F(ObstacleOfAFace, SwitchedOffAndOnAgainGivesTheSameBits) {
  Simulator one = simulator();
  const SimulationResult on = one.run();
  SimulationOptions off = options_;
  off.contact.teeth = false;
  one.set_options(off);
  const SimulationResult without = one.run();
  EXPECT_EQ(without.report.contact.frames, 0);
  EXPECT_FALSE(same(on, without));
  one.set_obstacles(nullptr);
  one.set_options(options_);
  EXPECT_TRUE(same(without, one.run())) << "nothing to touch";
  one.set_obstacles(obstacles_);
  EXPECT_TRUE(same(on, one.run()));
  EXPECT_TRUE(same(on, one.run())) << "compliance and factor being kept";
  EXPECT_TRUE(same(on, Simulator(one).run())) << "a copy";
}

TEST_F(ObstacleOfAFace, AFaceAlikeOnBothSidesIsCorrectedAlike) {
  options_.drive.by = DriveBy::displacement;
  const SimulationResult with = simulator().run();
  options_.contact.teeth = false;
  const SimulationResult without = simulator().run();
  const auto f = std::size_t(with.performance.peak_frame);
  const Points& rest = face_.mesh.skin.points;
  const Points change =
      (with.performance.skin_displacement_m[f] - without.performance.skin_displacement_m[f])
          .cast<double>();
  double most = 0, apart = 0;
  for (Eigen::Index v = 0; v < rest.rows(); ++v) {
    const Vec3 mirrored(-rest(v, 0), rest(v, 1), rest(v, 2));
    Eigen::Index w = 0;
    if ((rest.rowwise() - mirrored.transpose()).rowwise().norm().minCoeff(&w) > 1e-4) continue;
    const Vec3 twin(-change(w, 0), change(w, 1), change(w, 2));
    most = std::max(most, change.row(v).norm());
    apart = std::max(apart, (change.row(v).transpose() - twin).norm());
  }
  EXPECT_GT(most, 1e-4);
  EXPECT_LT(apart, 0.1 * most) << "tetrahedra are not cut alike";
}

TEST_F(ObstacleOfAFace, GapsOpenAlongTheNormalOfAnObstacleThatTurned) {
  const ObstaclePlaces places(face_.mesh, face_.landmarks, obstacles_->front());
  Eigen::Isometry3d turned = Eigen::Isometry3d::Identity();
  turned.rotate(Eigen::AngleAxisd(0.4, Vec3(3, -1, 2).normalized()));
  constexpr double step = 1e-6;
  for (Eigen::Index i = 0; i < places.count(); i += 7) {
    const Vec3 at(0.001, -0.002, 0.0005);
    Vec3 outward, ignored;
    places.gap_m(i, at, turned, outward);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR((places.gap_m(i, at + step * Vec3::Unit(axis), turned, ignored) -
                   places.gap_m(i, at - step * Vec3::Unit(axis), turned, ignored)) /
                      (2 * step),
                  outward[axis], 1e-6);
  }
}

TEST_F(ObstacleOfAFace, LidsTouchTheEyeballsBehindThem) {
  const std::vector<Obstacle> eyes = eye_obstacles(face_.mesh.skin.points, face_.landmarks);
  ASSERT_EQ(eyes.size(), 2u);
  for (const Obstacle& eye : eyes) {
    const ObstaclePlaces places(face_.mesh, face_.landmarks, eye);
    EXPECT_GT(places.skin().size(), 8u);
    EXPECT_TRUE(places.nodes().empty());
    const Points still = Points::Zero(places.count(), 3);
    EXPECT_EQ(places.depth(still, Eigen::Isometry3d::Identity()), 0);
    Points back = still;
    back.rowwise() -= 0.003 * face::face_frame(face_.landmarks).z.transpose();
    EXPECT_GT(places.depth(back, Eigen::Isometry3d::Identity()), 1e-3);
  }
}

/// A gap between two teeth; its points are outside both.
class Notch final : public SignedDistance {
 public:
  double at(const Vec3& place, Vec3& outward) const override {
    const Vec3 left(0.8, 0, 0.6), right(-0.8, 0, 0.6);
    outward = left.dot(place) < right.dot(place) ? left : right;
    return outward.dot(place);
  }
};

TEST(MouthContact, APlacePressedBetweenTwoFacesComesToRestOnBoth) {
  tissue::TissueMesh mesh;  // a node of the skin and one of the mouth's side
  mesh.volume.nodes = Points::Zero(2, 3);
  mesh.volume.layers = 1;
  mesh.volume.outer.points = mesh.volume.nodes.topRows(1);
  io::Landmarks landmarks;
  for (int k = 0; k < 68; ++k) landmarks[face::ibug(k)] = Vec3::Zero();
  const auto places = std::make_shared<const ObstaclePlaces>(
      mesh, landmarks, Obstacle{Obstacle::Kind::teeth, std::make_shared<const Notch>(), false});
  ASSERT_EQ(places->count(), 1);
  const MouthContact contact(std::make_shared<const LipSurfaces>(mesh, landmarks), {}, {},
                             {ObstacleSide{places, {SkinCarrier{{1, 1.0}}}}}, {}, 1e-9,
                             [](const std::vector<int>&) -> Eigen::MatrixXd {
                               return Vec3(1e-3, 1e-3, 2e-3).asDiagonal();  // m/N
                             });
  const PointsF skin(0, 3);
  Points in(1, 3);
  in << 0.0003, 0, -0.001;
  const MouthContact::Correction out = contact.correct({skin, {in}, Eigen::Isometry3d::Identity()});
  EXPECT_GT(out.before_m, 0.0008);
  EXPECT_LT(out.after_m, 1e-5) << "pushed off one, it enters the other, and back";
  // The only place outside of both to which a push by both leads is the notch's bottom.
  const Vec3 at = in.row(0).transpose() + out.moved;
  EXPECT_LT(at.norm(), 3e-5);
  EXPECT_NEAR(out.force[0], -0.0003 / 1e-3, 0.02);
  EXPECT_NEAR(out.force[2], 0.001 / 2e-3, 0.02);
}

}  // namespace
}  // namespace hyperex::simulate
