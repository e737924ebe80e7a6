// SPDX-License-Identifier: GPL-3.0-or-later
// A twin experiment: known activations move a face, its landmarks are measured with noise, and the
// activations are estimated from them.
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "hyperex/face/ibug.hpp"
#include "hyperex/fem/form/assembler.hpp"
#include "hyperex/muscles/muscle_template.hpp"
#include "hyperex/simulate/drive/skin_places.hpp"
#include "hyperex/simulate/load/muscle_fit.hpp"
#include "hyperex/simulate/load/muscle_load.hpp"
#include "hyperex/simulate/load/muscle_model.hpp"
#include "muscles/a_face.hpp"
#include "simulate/small_face.hpp"

namespace hyperex::simulate {
namespace {

constexpr int kTwinSamples = 25;
constexpr double kNoise_m = 0.0003;

class MuscleTwin : public testing::Test {
 protected:
  MuscleTwin() {
    options_.drive.by = DriveBy::muscles;
    options_.drive.points = face::all_ibug();
    options_.muscles.many_sigma_m = kNoise_m;  // what the points really have
    fem::Material material = options_.tissue.material(std::size_t(face_.mesh.volume.tets.rows()),
                                                      options_.model.viscous_form);
    stiffen_lips(face_.mesh, face_.landmarks, options_.muscles, material);
    fem::System system;
    fem::Assembler(face_.mesh.volume.nodes, face_.mesh.volume.tets, options_.model.element)
        .assemble(material, system);
    stiffness_ = system.stiffness;
  }

  /// Activations as expressions have them: one sample in three of a muscle is active.
  Eigen::MatrixXd drawn(Eigen::Index muscles) {
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(muscles, kTwinSamples);
    std::uniform_real_distribution<double> share(0, 1);
    for (int k = 1; k < kTwinSamples; ++k)
      for (Eigen::Index m = 0; m < muscles; ++m)
        if (share(random_) < 1.0 / 3) a(m, k) = 0.7 * share(random_);
    return a;
  }

  const muscles::test::AFace& face_ = muscles::test::a_face();
  SimulationOptions options_;
  fem::SparseMatrix stiffness_;
  std::mt19937 random_{17};
};

double correlation(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  const Eigen::VectorXd x = a.array() - a.mean(), y = b.array() - b.mean();
  return x.dot(y) / (x.norm() * y.norm());
}

TEST_F(MuscleTwin, GroupsOfMusclesAreFoundFromLandmarks) {
  MuscleModel model(face_.mesh, face_.landmarks, stiffness_, muscles::muscle_template(),
                    {muscle_support(options_.support, options_.muscles), options_.muscles.shape,
                     options_.muscles.widening});
  const auto count = Eigen::Index(model.lines().size());
  const Eigen::MatrixXd truth = drawn(count);
  Points rest(68, 3);
  for (int p = 0; p < 68; ++p) rest.row(p) = face_.landmarks.at(face::ibug(p)).transpose();
  const CarrierMatrix carrier =
      carriers(face_.mesh, skin_places(face_.mesh, face::all_ibug(), rest));
  const JawKinematics jaw(face_.landmarks, nullptr);
  std::normal_distribution<double> normal;
  AlignedMotion motion;
  motion.motion.names = motion.common = face::all_ibug();
  motion.rest = rest;
  Eigen::VectorXd opening(kTwinSamples);
  for (int k = 0; k < kTwinSamples; ++k) {
    JawPose pose = JawPose::Zero();
    pose[0] = opening[k] = 0.1 * (1 - std::cos(0.5 * k));
    Eigen::VectorXd nodes = model.jaw_response() * jaw.motion(pose);
    for (Eigen::Index m = 0; m < count; ++m) {
      const double a = truth(m, k), wide = a / (a + options_.muscles.half);
      nodes += a * (1 - wide) * model.response().col(m) + a * wide * model.wide_response().col(m);
    }
    Points moved = carrier * Eigen::Map<const Points>(nodes.data(), carrier.cols(), 3);
    if (k > 0) moved += kNoise_m * Points::NullaryExpr(68, 3, [&] { return normal(random_); });
    motion.motion.time_s.push_back(0.5 * k);  // poses, not a motion
    motion.motion.positions.push_back(rest + moved);
  }
  const HeldLoad load =
      muscle_load(face_.mesh, face_.landmarks, motion,
                  measured_region(face_.mesh, face_.landmarks, motion, options_.region), options_,
                  muscle_model(face_.mesh, face_.landmarks, options_, stiffness_, model.order()));
  EXPECT_EQ(load.muscles.names.size(), std::size_t(count));
  EXPECT_FALSE(load.muscles.few_points);

  std::map<std::string, std::array<Eigen::VectorXd, 2>> sums;  // of a group on a side
  for (Eigen::Index m = 0; m < count; ++m) {
    const muscles::MuscleLine& line = model.lines()[std::size_t(m)];
    const std::string group =
        muscles::muscle_template()[std::size_t(line.row)].group + (line.left ? "_L" : "_R");
    auto& [true_sum, found_sum] = sums[group];
    if (true_sum.size() == 0) true_sum = found_sum = Eigen::VectorXd::Zero(kTwinSamples);
    true_sum += truth.row(m).transpose();
    found_sum += load.muscles.activation.row(m).transpose();
  }
  Eigen::VectorXd all_true(Eigen::Index(sums.size()) * kTwinSamples), all_found = all_true;
  Eigen::Index at = 0;
  for (const auto& [group, both] : sums) {
    const auto& groups = load.muscles.groups;
    const auto row = std::find(groups.begin(), groups.end(), group) - groups.begin();
    ASSERT_LT(row, Eigen::Index(groups.size())) << group;
    EXPECT_LT((load.muscles.group_activation.row(row).transpose() - both[1]).norm(), 1e-12);
    all_true.segment(at, kTwinSamples) = both[0];
    all_found.segment(at, kTwinSamples) = both[1];
    at += kTwinSamples;
  }
  const double whole = correlation(all_true, all_found);
  EXPECT_GT(whole, 0.92);
  EXPECT_GT(correlation(opening, load.muscles.jaw_opening_deg), 0.89);
}

}  // namespace
}  // namespace hyperex::simulate
