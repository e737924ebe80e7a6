// SPDX-License-Identifier: GPL-3.0-or-later
// The correction of the skin between driven points by shapes of real faces, on a small face.
#include "hyperex/simulate/load/shape_correction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "hyperex/expression/shape_model.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/fem/form/assembler.hpp"
#include "hyperex/simulate/load/holding_forces.hpp"
#include "hyperex/simulate/load/muscle_load.hpp"
#include "hyperex/simulate/load/muscle_tissue.hpp"
#include "simulate/small_face.hpp"

namespace hyperex::simulate {
namespace {

constexpr double kSigma_m = 0.002;

class ShapesOnAFace : public testing::Test {
 protected:
  ShapesOnAFace() {
    for (const std::string& name : test::seven_points())
      points_.push_back({name, face_.landmarks.at(name)});
    options_.drive.by = DriveBy::muscles;
    options_.drive.points = test::seven_points();
  }
  CarriedShapes shapes() const { return shapes_of(points_); }
  CarriedShapes shapes_of(const std::vector<DrivenPoint>& points) const {
    return {face_.mesh.volume.outer.points, face_.mesh.upper_margin, face_.landmarks, points,
            kSigma_m};
  }
  /// Weights of the named shapes.
  static Eigen::VectorXd weights(const std::vector<std::pair<std::string, double>>& of) {
    const auto& names = expression::shape_model().names;
    Eigen::VectorXd out = Eigen::VectorXd::Zero(Eigen::Index(names.size()));
    for (const auto& [name, weight] : of)
      out[std::find(names.begin(), names.end(), name) - names.begin()] = weight;
    return out;
  }
  DriveField field() const { return {points_, {}, face_.mesh, Vec3::UnitY(), 0}; }
  /// From 0 within the clear distance of the nearest driven point to 1 at the reach.
  double nearness(const Vec3& at) const {
    double nearest = 1;
    for (const DrivenPoint& point : points_) nearest = std::min(nearest, (point.rest - at).norm());
    const MuscleOptions& o = options_.muscles;
    return std::clamp((nearest - o.shape_clear_m) / (o.shape_reach_m - o.shape_clear_m), 0.0, 1.0);
  }

  const test::SmallFace face_ = test::small_face();
  std::vector<DrivenPoint> points_;
  SimulationOptions options_;
};

TEST_F(ShapesOnAFace, WeightsAreTheMostProbableOnesThatAreNotNegative) {
  const CarriedShapes shapes = this->shapes();
  const Eigen::VectorXd seen =
      shapes.at_points() * weights({{"mouthSmile_L", 0.8}, {"jawOpen", 0.3}, {"noseSneer_R", -1}});
  const Eigen::VectorXd found = shapes.weights_for(seen);
  const Eigen::VectorXd slope =
      shapes.at_points().transpose() * (shapes.at_points() * found - seen) / (kSigma_m * kSigma_m) +
      expression::shape_model().covariance.llt().solve(found);
  const double scale =
      (shapes.at_points().transpose() * seen).cwiseAbs().maxCoeff() / (kSigma_m * kSigma_m);
  for (Eigen::Index k = 0; k < found.size(); ++k) {
    EXPECT_GE(found[k], 0) << k;
    if (found[k] > 0) {
      EXPECT_NEAR(slope[k], 0, 1e-8 * scale) << k;
    } else {
      EXPECT_GT(slope[k], -1e-8 * scale) << k;
    }
  }
}

/// The small face is the canonical face itself.
TEST_F(ShapesOnAFace, OnTheCanonicalFaceTheyAreTheModels) {
  const CarriedShapes shapes = this->shapes();
  const Eigen::MatrixXd& own = expression::shape_model().displacement;
  ASSERT_EQ(shapes.at_nodes().rows(), own.rows());
  EXPECT_LT((shapes.at_nodes() - own).norm(), 0.01 * own.norm());
  EXPECT_EQ(shapes.cover().minCoeff(), 1);
}

TEST_F(ShapesOnAFace, AStillSideStaysStill) {
  const CarriedShapes shapes = this->shapes();
  const Eigen::VectorXd truth = weights({{"mouthSmile_L", 0.9}});
  const Eigen::VectorXd moved = shapes.at_nodes() * shapes.weights_for(shapes.at_points() * truth);
  const Points& nodes = face_.mesh.volume.outer.points;
  double left = 0, right = 0;
  for (Eigen::Index i = 0; i < nodes.rows(); ++i)
    if (std::abs(nodes(i, 0)) > 0.015)
      (nodes(i, 0) > 0 ? left : right) =
          std::max(nodes(i, 0) > 0 ? left : right, moved.segment<3>(3 * i).norm());
  EXPECT_GT(left, 0.006);
  EXPECT_LT(right, 0.001);
}

TEST_F(ShapesOnAFace, TheCorrectionIsTheSmoothedDifference) {
  const CarriedShapes shapes = this->shapes();
  const DriveField field = this->field();
  const auto nodes = face_.mesh.volume.surface_nodes();
  LoadedSkin load;
  load.moved = 1e-3 * Eigen::MatrixXd::Random(3 * nodes, 2);
  load.course = Eigen::MatrixXd::Random(2, 3);
  load.points = 3e-3 * Eigen::MatrixXd::Random(3 * Eigen::Index(points_.size()), 3);
  const SkinCorrection found =
      shape_correction(face_.mesh, shapes, field, load, {}, options_.muscles);
  ASSERT_FALSE(found.nodes.empty());

  const Points& at = face_.mesh.volume.outer.points;
  const Eigen::MatrixXd of_points =
      field.weights(at, face_.mesh.upper_margin).leftCols(Eigen::Index(points_.size()));
  const double sigma = options_.muscles.shape_smoothing_m;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Eigen::VectorXd seen = load.points.col(k), w = shapes.weights_for(seen);
    const Eigen::VectorXd rest = seen - shapes.at_points() * w;
    const Points left_over = of_points * Eigen::Map<const Points>(rest.data(), rest.size() / 3, 3);
    const Eigen::VectorXd unsmoothed = shapes.at_nodes() * w - load.moved * load.course.col(k);
    const Eigen::VectorXd d = found.displaced * found.course.col(k);
    for (std::size_t n = 0; n < found.nodes.size(); n += 17) {
      const Vec3 x = at.row(found.nodes[n]).transpose();
      Vec3 sum = Vec3::Zero();
      double mass = 0;
      for (Eigen::Index j = 0; j < nodes; ++j) {
        const double r = (at.row(j).transpose() - x).norm() / sigma;
        if (r >= 2.5) continue;
        mass += std::exp(-r * r / 2);
        sum += std::exp(-r * r / 2) *
               (unsmoothed.segment<3>(3 * j) + Vec3(left_over.row(j).transpose()));
      }
      const Vec3 expected =
          options_.muscles.shape_share * nearness(x) * shapes.cover()[found.nodes[n]] * sum / mass;
      EXPECT_LT((d.segment<3>(3 * Eigen::Index(n)) - expected).norm(), 2e-6) << found.nodes[n];
    }
  }
}

TEST_F(ShapesOnAFace, TheSkinAtDrivenPointsAndWhatIsPrescribedStays) {
  const std::vector<int> prescribed = {3 * 200, 3 * 200 + 1, 3 * 200 + 2};
  LoadedSkin load{Eigen::MatrixXd::Zero(3 * face_.mesh.volume.surface_nodes(), 1),
                  Eigen::MatrixXd::Zero(1, 1),
                  Eigen::VectorXd::Constant(3 * Eigen::Index(points_.size()), 0.002)};
  const SkinCorrection found =
      shape_correction(face_.mesh, shapes(), field(), load, prescribed, options_.muscles);
  EXPECT_TRUE(std::is_sorted(found.nodes.begin(), found.nodes.end()));
  EXPECT_EQ(std::count(found.nodes.begin(), found.nodes.end(), 200), 0);
  for (const int node : found.nodes)
    EXPECT_GT(nearness(face_.mesh.volume.outer.points.row(node).transpose()), 0);
}

class LoadWithShapes : public ShapesOnAFace {
 protected:
  LoadWithShapes() {
    fem::System system;
    fem::Assembler(face_.mesh.volume.nodes, face_.mesh.volume.tets, options_.model.element)
        .assemble(options_.tissue.material(std::size_t(face_.mesh.volume.tets.rows()),
                                           options_.model.viscous_form),
                  system);
    model_.emplace(muscle_model(face_.mesh, face_.landmarks, options_, system.stiffness, nullptr));
  }
  /// Static displacement of the outer nodes under a force (3 |nodes|, N).
  Eigen::VectorXd static_response(const Eigen::VectorXd& force) const {
    fem::PartitionedFactor factor(model_->stiffness(), model_->boundary().prescribed(), "test");
    Eigen::MatrixXd free = force(factor.free());
    factor.solve(free, {});
    Eigen::VectorXd all = Eigen::VectorXd::Zero(force.size());
    all(factor.free()) = free.col(0);
    return all.head(3 * face_.mesh.volume.surface_nodes());
  }
  HeldLoad load(const AlignedMotion& motion, bool with_shapes) {
    options_.muscles.shape_prior = with_shapes;
    return muscle_load(face_.mesh, face_.landmarks, motion,
                       measured_region(face_.mesh, face_.landmarks, motion, options_.region),
                       options_, *model_);
  }
  std::optional<MuscleModel> model_;
};

TEST_F(LoadWithShapes, HoldingForcesMakeTheDisplacementThatTheyStateInEquilibrium) {
  const std::vector<int> nodes = {150, 151, 160};
  const Eigen::MatrixXd displaced = 1e-3 * Eigen::MatrixXd::Random(9, 2);
  const HeldShape held = holding_forces(*model_, nodes, exactly(nodes), displaced, {});
  for (Eigen::Index c = 0; c < 2; ++c) {
    const Eigen::VectorXd moved = static_response(held.force.col(c));
    EXPECT_LT((moved - held.moved.col(c)).norm(), 1e-8 * moved.norm());
    for (std::size_t i = 0; i < nodes.size(); ++i)
      EXPECT_LT((moved.segment<3>(3 * nodes[i]) - displaced.col(c).segment<3>(3 * Eigen::Index(i)))
                    .norm(),
                1e-9);
  }
}

TEST_F(LoadWithShapes, ActivationsDoNotFollowTheNoiseOfTheRecordingButThePointsDo) {
  const AlignedMotion smooth = test::mouth_opening(face_.landmarks, 8, 60, 60);
  AlignedMotion noisy = smooth;
  std::mt19937 random(8);
  std::normal_distribution<double> noise_m(0, 3e-4);
  for (std::size_t k = 1; k < noisy.motion.positions.size(); ++k)
    for (double& x : noisy.motion.positions[k].reshaped()) x += noise_m(random);
  AlignedMotion poses = noisy;  // too far apart to tell noise from motion
  for (double& t : poses.motion.time_s) t *= 30;

  const Eigen::MatrixXd truth = load(smooth, false).muscles.activation;
  const HeldLoad held = load(noisy, false);
  const double error = (held.muscles.activation - truth).norm(),
               unfiltered = (load(poses, false).muscles.activation - truth).norm();
  EXPECT_LT(error, 0.6 * unfiltered);

  Points rest(Eigen::Index(points_.size()), 3);
  for (std::size_t i = 0; i < points_.size(); ++i)
    rest.row(Eigen::Index(i)) = points_[i].rest.transpose();
  const CarrierMatrix carrier =
      carriers(face_.mesh, skin_places(face_.mesh, test::seven_points(), rest));
  const Eigen::VectorXd moved = static_response(held.force * held.course.col(40));
  const Points places = carrier * Eigen::Map<const Points>(moved.data(), carrier.cols(), 3);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const int row = noisy.motion.index_of(points_[i].name);
    const Vec3 seen =
        (noisy.motion.positions[40].row(row) - noisy.motion.positions[0].row(row)).transpose();
    EXPECT_LT((places.row(Eigen::Index(i)).transpose() - seen).norm(), 1.5e-4) << points_[i].name;
  }
}

/// The force at such a node is that of a spring between its place and the one asked for.
TEST_F(LoadWithShapes, ANodeThatIsNotHeldFirmlyIsDrawnToItsPlaceByASpring) {
  const std::vector<int> nodes = {150, 151, 160};
  const Eigen::Vector3d hold(1, 0.5, 0.1);
  const Eigen::MatrixXd displaced = 1e-3 * Eigen::MatrixXd::Random(9, 2);
  const HeldShape held = holding_forces(*model_, nodes, hold, displaced, {});
  for (Eigen::Index c = 0; c < 2; ++c) {
    const Eigen::VectorXd moved = static_response(held.force.col(c));
    EXPECT_LT((moved - held.moved.col(c)).norm(), 1e-8 * moved.norm());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto row = 3 * Eigen::Index(i);
      const Vec3 short_of =
          displaced.col(c).segment<3>(row) - moved.segment<3>(3 * Eigen::Index(nodes[i]));
      if (hold[Eigen::Index(i)] == 1) {
        EXPECT_LT(short_of.norm(), 1e-9);
        continue;
      }
      const Eigen::SparseMatrix<double>& k = model_->stiffness();
      double own = 0;
      for (int a = 0; a < 3; ++a) own += k.coeff(3 * nodes[i] + a, 3 * nodes[i] + a) / 3;
      const Vec3 force = held.force.col(c).segment<3>(3 * Eigen::Index(nodes[i]));
      const double spring = own * hold[Eigen::Index(i)] / (1 - hold[Eigen::Index(i)]);
      EXPECT_LT((force - spring * short_of).norm(), 1e-6 * force.norm());
      EXPECT_GT(short_of.norm(), 1e-5);
    }
  }
  const auto nearly =
      holding_forces(*model_, nodes, Eigen::Vector3d(1, 1 - 1e-9, 1), displaced, {});
  const auto firmly = holding_forces(*model_, nodes, exactly(nodes), displaced, {});
  EXPECT_LT((nearly.moved - firmly.moved).norm(), 1e-6 * firmly.moved.norm());
}

/// Where elements are large, the nodes that carry a point may be far from it.
TEST_F(LoadWithShapes, APointBetweenFarNodesEndsWhereItDidWithout) {
  const Triangles& triangles = face_.mesh.skin.triangles;
  const Points& skin = face_.mesh.skin.points;
  Eigen::Index at = 0;
  double nearest = 1;
  const auto middle = [&](Eigen::Index f) -> Vec3 {
    return (skin.row(triangles(f, 0)) + skin.row(triangles(f, 1)) + skin.row(triangles(f, 2)))
               .transpose() /
           3;
  };
  for (Eigen::Index f = 0; f < triangles.rows(); ++f)
    if (const double d = (middle(f) - face_.landmarks.at("ibug68_8")).norm(); d < nearest) {
      nearest = d;
      at = f;
    }
  io::Landmarks moved_landmarks = face_.landmarks;
  moved_landmarks["ibug68_8"] = middle(at);
  ASSERT_GT((skin.row(triangles(at, 0)).transpose() - middle(at)).norm(),
            options_.muscles.shape_clear_m);
  const AlignedMotion motion =
      test::motion_of(moved_landmarks, 2, 30, [](const std::string& name, const Vec3&, int k) {
        return Vec3(k * (name == "ibug68_8" ? Vec3(0.002, -0.006, 0) : Vec3(0, -0.002, 0.001)));
      });
  Vec3 ends[2];
  for (const bool with_shapes : {false, true}) {
    const HeldLoad load = this->load(motion, with_shapes);
    const Eigen::VectorXd nodes = static_response(load.force * load.course.rightCols<1>());
    ends[with_shapes] = Vec3::Zero();
    for (int k = 0; k < 3; ++k) ends[with_shapes] += nodes.segment<3>(3 * triangles(at, k)) / 3;
  }
  EXPECT_LT((ends[true] - ends[false]).norm(), 1e-5);
}

/// A smile of one side with a raised cheek, given by seven points.
TEST_F(LoadWithShapes, TheFaceComesNearerToARealOneAndThePointsStayWhereTheyAreDriven) {
  const Eigen::VectorXd truth = weights({{"mouthSmile_L", 0.7}, {"cheekSquint_L", 0.4}});
  std::vector<DrivenPoint> all;
  for (const auto& [name, at] : face_.landmarks) all.push_back({name, at});
  const CarriedShapes at_landmarks = shapes_of(all);
  const Eigen::VectorXd landmarks_moved = at_landmarks.at_points() * truth;
  const AlignedMotion motion = test::motion_of(
      face_.landmarks, 2, 30, [&](const std::string& name, const Vec3&, int k) -> Vec3 {
        const auto at = std::distance(face_.landmarks.begin(), face_.landmarks.find(name));
        return k * landmarks_moved.segment<3>(3 * at);
      });
  const Eigen::VectorXd expected = at_landmarks.at_nodes() * truth;
  double error[2], off[2];
  for (const bool with_shapes : {false, true}) {
    const HeldLoad load = this->load(motion, with_shapes);
    const Eigen::VectorXd moved = static_response(load.force * load.course.rightCols<1>());
    error[with_shapes] = (moved - expected).norm();
    off[with_shapes] = 0;
    const CarrierMatrix carrier = carriers(
        face_.mesh,
        skin_places(face_.mesh, {"ibug68_54"}, face_.landmarks.at("ibug68_54").transpose()));
    const Points corner =
        carrier * Eigen::Map<const Points>(moved.data(), face_.mesh.volume.surface_nodes(), 3);
    const auto at = std::distance(face_.landmarks.begin(), face_.landmarks.find("ibug68_54"));
    off[with_shapes] = (corner.row(0).transpose() - landmarks_moved.segment<3>(3 * at)).norm();
  }
  EXPECT_LT(error[true], 0.85 * error[false]);
  EXPECT_LT(off[true], 1e-4);
  EXPECT_NEAR(off[true], off[false], 5e-5);
}

}  // namespace
}  // namespace hyperex::simulate
