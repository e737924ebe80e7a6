// SPDX-License-Identifier: GPL-3.0-or-later
// How strongly units act, read off a tracked face.
#include "hyperex/tracking/fit/unit_weights.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "hyperex/tracking/fit/frame_fit.hpp"
#include "hyperex/tracking/model/lips.hpp"
#include "hyperex/tracking/model/unit_matrix.hpp"
#include "unit/tracking/face_depth.hpp"

namespace hyperex::tracking {
namespace {

const FaceModel& model() {
  return canonical_model();
}

int unit(const std::string& name) {
  const int k = model().animation_unit(name);
  EXPECT_GE(k, 0) << name;
  return k;
}

Points moved_by(const Eigen::VectorXd& weights) {
  return deformed(model().mesh.points, model().animation_units, weights);
}

Eigen::VectorXd none() {
  return Eigen::VectorXd::Zero(Eigen::Index(model().animation_units.size()));
}

/// The function that UnitReader says it makes least, at the best rigid motion, written anew.
class Cost {
 public:
  Cost(const Points& vertices_m, const UnitReaderOptions& options) : options_(options) {
    const Points& rest = model().mesh.points;
    const UnitMatrix units = unit_matrix(model());
    const Eigen::VectorXd typical = typical_weights(model());
    const std::vector<bool> lip = within_lips(model());
    Eigen::MatrixXd rigid(units.rows(), 6);
    Eigen::VectorXd off(units.rows()), deviation(units.rows());
    for (Eigen::Index v = 0; v < rest.rows(); ++v) {
      double squares = std::pow(options.noise_m, 2);
      if (lip[std::size_t(v)]) squares += std::pow(options.off_units_lip_m, 2);
      for (Eigen::Index k = 0; k < typical.size(); ++k)
        squares +=
            (options.off_units_share * typical[k] * units.block<3, 1>(3 * v, k)).squaredNorm();
      const Vec3 p = rest.row(v).transpose();
      for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Index row = 3 * v + axis;
        deviation[row] = std::sqrt(squares);
        off[row] = vertices_m(v, axis) - rest(v, axis);
        for (int turn = 0; turn < 3; ++turn)
          rigid(row, turn) = Vec3(Vec3::Unit(turn).cross(p))[axis];
        rigid.row(row).tail<3>() = Vec3::Unit(axis).transpose();
      }
    }
    const auto without_rigid = [&](const Eigen::MatrixXd& columns) -> Eigen::MatrixXd {
      const Eigen::MatrixXd scaled = deviation.cwiseInverse().asDiagonal() * columns,
                            motions = deviation.cwiseInverse().asDiagonal() * rigid;
      return scaled - motions * motions.colPivHouseholderQr().solve(scaled);
    };
    units_ = without_rigid(units);
    off_ = without_rigid(off);
    typical_ = typical;
  }

  double operator()(const Eigen::VectorXd& weights) const {
    const double vertices = double(off_.size()) / 3;
    double sum = (units_ * weights - off_).squaredNorm() / (2 * vertices);
    for (Eigen::Index k = 0; k < weights.size(); ++k)
      sum +=
          options_.sparseness * units_.col(k).norm() / std::sqrt(vertices) * std::abs(weights[k]) +
          std::pow(options_.shrinkage * weights[k] / typical_[k], 2) / 2;
    return sum;
  }

 private:
  UnitReaderOptions options_;
  Eigen::MatrixXd units_;
  Eigen::VectorXd off_, typical_;
};

/// A smile with a little of everything else, noise, and a bulge that no unit makes.
Points busy_face() {
  Eigen::VectorXd weights = none();
  weights[unit("mouthSmile_L")] = 0.8;
  weights[unit("jawOpen")] = 0.3;
  weights[unit("jawSide")] = -0.4;
  weights[unit("browInnerUp_R")] = 0.6;
  Points points = moved_by(weights);
  std::mt19937 random(4);
  for (double& x : points.reshaped()) x += 1e-3 * (double(random() % 2001) / 1000 - 1);
  for (auto p : points.rowwise())
    p.z() += 0.004 * std::exp(-std::pow((p.x() - 0.03) / 0.02, 2) - std::pow(p.y() / 0.02, 2));
  return points;
}

TEST(UnitReader, NoOtherWeightsCostLess) {
  const UnitReaderOptions options;
  const Points face = busy_face();
  const Eigen::VectorXd found = UnitReader(model(), model().mesh.points, 1).read(face);
  const Cost cost(face, options);
  const double least = cost(found);
  std::mt19937 random(9);
  int idle = 0;
  for (Eigen::Index k = 0; k < found.size(); ++k) {
    const bool two_ways = !model().animation_units[std::size_t(k)].arkit_negative.empty();
    idle += found[k] == 0;
    for (const double step : {-1e-2, -1e-3, 1e-3, 1e-2}) {
      Eigen::VectorXd other = found;
      other[k] += step;
      if (other[k] > options.most || other[k] < (two_ways ? -options.most : 0)) continue;
      EXPECT_GT(cost(other), least) << model().animation_units[std::size_t(k)].name << step;
    }
  }
  EXPECT_GT(idle, 10) << "most units are at rest, and are said to be";
  for (int trial = 0; trial < 200; ++trial) {
    Eigen::VectorXd other = found;
    for (double& weight : other)
      weight = std::abs(weight + 1e-2 * (double(random() % 2001) / 1000 - 1));
    EXPECT_GT(cost(other), least);
  }
}

TEST(UnitReader, ReadsTheModelsOwnUnits) {
  const UnitReader reader(model(), model().mesh.points, 1);
  for (const char* name : {"jawOpen", "mouthSmile_L", "mouthSmile_R", "mouthStretch_L",
                           "mouthPucker", "mouthSide", "browOuterUp_R", "cheekPuff_L"}) {
    const Eigen::VectorXd truth = 0.8 * Eigen::VectorXd::Unit(none().size(), unit(name));
    Eigen::VectorXd read = reader.read(moved_by(truth));
    EXPECT_NEAR(read[unit(name)], 0.8, 0.16) << name;
    read[unit(name)] = 0;
    EXPECT_LT(read.cwiseAbs().maxCoeff(), 0.1) << name;
  }
  EXPECT_EQ(reader.read(model().mesh.points), none());
}

TEST(UnitReader, AnErrorOfTheHeadsPoseIsNoExpression) {
  const UnitReader reader(model(), model().mesh.points, 1);
  const Points face = busy_face();
  Points turned = face;
  const Vec3 turn(0.01, -0.02, 0.015), shift(0.002, 0.003, -0.004);
  for (Eigen::Index v = 0; v < face.rows(); ++v)
    turned.row(v) += (turn.cross(Vec3(model().mesh.points.row(v).transpose())) + shift).transpose();
  EXPECT_LT((reader.read(turned) - reader.read(face)).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(UnitReader, WeightsHaveARangeAndASizeOfTheirOwn) {
  const UnitReader reader(model(), model().mesh.points, 1);
  const auto read = [&](const char* name, double weight) {
    return reader.read(moved_by(weight * Eigen::VectorXd::Unit(none().size(), unit(name))));
  };
  EXPECT_EQ(read("mouthSmile_L", 3)[unit("mouthSmile_L")], 1.5);
  EXPECT_EQ(read("mouthSmile_L", -0.8)[unit("mouthSmile_L")], 0) << "no unit pulls";
  EXPECT_EQ(read("mouthPucker", -0.8)[unit("mouthPucker")], 0);
  EXPECT_LT(read("jawSide", -0.8)[unit("jawSide")], -0.5) << "to the right";
  EXPECT_LT(read("mouthSide", -3)[unit("mouthSide")], -1.4);
  // Of a larger person 1 is more millimetres.
  const Points rest = 1.2 * model().mesh.points;
  const Points smile =
      1.2 * moved_by(0.8 * Eigen::VectorXd::Unit(none().size(), unit("mouthSmile_L")));
  EXPECT_NEAR(UnitReader(model(), rest, 1.2).read(smile)[unit("mouthSmile_L")], 0.8, 0.12);
}

/// The fit's own weights against those read off, over a smile that comes in ten frames. Its corners
/// go back farther than those of the model's smile, as real ones do.
TEST(UnitReader, ASmileIsASmileWhereTheFitSharesItOut) {
  const capture::Intrinsics camera{525, 525, 319.5, 239.5, 640, 480};
  const Points& rest = model().mesh.points;
  Eigen::VectorXd smile = none();
  smile[unit("mouthSmile_L")] = smile[unit("mouthSmile_R")] = 0.9;
  Points full = moved_by(smile) - rest;
  full.col(2) *= 1.6;
  full.col(0) *= 0.8;
  FrameFit fit(model(), camera, rest, 1, {});
  FaceState state = fit.at_rest();
  state.camera_from_head.linear() =
      Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()).toRotationMatrix();
  state.camera_from_head.translation() = Vec3(0, 0, 0.6);
  for (int frame = 0; frame <= 10; ++frame) {
    const TriMesh seen{
        in_camera(Eigen::Translation3d(0, 0, 0.6) *
                      Eigen::Isometry3d(Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX())),
                  Points(rest + 0.1 * frame * full)),
        model().mesh.triangles};
    Observation observation;
    observation.network_px = network_of(seen.points, camera);
    observation.depth_m = depth_of(seen, camera);
    const FaceState before = state;
    state = fit.fit(observation, before, &before, nullptr);
  }
  const Eigen::VectorXd read = UnitReader(model(), rest, 1).read(fit.vertices(state));
  const Eigen::Index left = unit("mouthSmile_L"), right = unit("mouthSmile_R");
  EXPECT_LT(state.weights[left], 0.7) << "what this is for: the fit's own weight";
  EXPECT_NEAR(read[left], 0.9, 0.2);
  EXPECT_NEAR(read[right], 0.9, 0.2);
  for (const char* name : {"mouthFrown_L", "mouthFrown_R", "mouthPucker", "mouthFunnel"})
    EXPECT_EQ(read[unit(name)], 0) << name;
}

}  // namespace
}  // namespace hyperex::tracking
