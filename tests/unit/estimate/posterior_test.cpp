// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/estimate/posterior.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "estimate/estimate_twin.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/within_95.hpp"
#include "hyperex/estimate/intervals.hpp"
#include "hyperex/estimate/proposal.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/simulate/load/muscle_tissue.hpp"

namespace hyperex::estimate::test {
namespace {

TEST(RecordingModel, DerivativeIsThatOfFiniteDifferences) {
  const std::vector<std::string> points{"ibug68_48", "ibug68_54", "ibug68_8", "ibug68_51"};
  FaceModel face = model_of({{programs_mesh().cheeks()}, {"zygomatic_R", "zyg_major_R"}}, points);
  Observation seen;
  seen.displacement_m = Eigen::VectorXd::Constant(12, 1e-3);
  seen.head_turn_rad = seen.head_shift_m = 1e-3;
  Posterior posterior(face, {seen, seen}, {});
  const Unknowns& u = posterior.unknowns();
  RecordingModel model(face, u, {-1, -1});
  Eigen::VectorXd x = posterior.start();
  for (Eigen::Index i = u.activations(0); i < u.all(); ++i)
    if ((i - u.shared()) % u.each() < u.muscles) x[i] = 0.05 + 0.01 * double(i % 17);
  for (Eigen::Index i = u.lines(0); i < u.shared(); ++i) x[i] = 1e-3 * std::sin(double(i));
  x[u.jaw(1)] = 0.2;
  x[u.jaw(1) + 4] = 2e-3;
  x[u.ratio(0)] = 0.5;
  x[u.tissue()] = -0.2;
  x[u.gain(0)] = 0.6;
  x[u.gain(1)] = 0.8;
  const Eigen::MatrixXd analytic = model.derivative(x, 1);
  for (const Eigen::Index i :
       {u.ratio(0), u.gain(0), u.gain(1), u.tissue(), u.lines(0), u.lines(1) + 7, u.activations(1),
        u.activations(1) + 11, u.jaw(1), u.jaw(1) + 4, u.head(1) + 1}) {
    constexpr double h = 1e-5;
    Eigen::VectorXd more = x, less = x;
    more[i] += h;
    less[i] -= h;
    const Eigen::VectorXd numeric =
        (model.displacement(more, 1) - model.displacement(less, 1)) / (2 * h);
    EXPECT_GT(numeric.norm(), 0) << i;
    EXPECT_LT((analytic.col(i) - numeric).norm(), 1e-5 * numeric.norm()) << i;
  }
  EXPECT_EQ(analytic.col(u.activations(0)).norm(), 0) << "of the other recording";
}

TEST(RecordingModel, DerivativeUnderKnownLoadsIsThatOfFiniteDifferences) {
  const std::vector<std::string> points{"ibug68_48", "ibug68_54", "ibug68_8", "ibug68_51"};
  const io::Landmarks& landmarks = programs_mesh().face.landmarks;
  FaceModel face =
      model_of({{programs_mesh().cheeks()},
                {},
                {lying_down(landmarks), hung_weight(landmarks, landmarks.at("ibug68_48"), 0.02)}},
               points);
  Observation seen;
  seen.displacement_m = Eigen::VectorXd::Constant(12, 1e-3);
  seen.head_turn_rad = seen.head_shift_m = 1e-3;
  Observation lying = seen, weighted = seen;
  lying.load = 0;
  weighted.load = 1;
  Posterior posterior(face, {seen, lying, weighted}, {});
  const Unknowns& u = posterior.unknowns();
  ASSERT_EQ(u.absolute, 1);
  RecordingModel model(face, u, {-1, 0, 1});
  Eigen::VectorXd x = posterior.start();
  x[u.ratio(0)] = 0.5;
  x[u.young()] = -0.7;
  x[u.tissue()] = 0.3;
  for (const Eigen::Index e : {1, 2}) {
    x[u.load_turn(e) + 1] = 0.1;
    x[u.load_turn(e) + 3] = -0.05;
    const Eigen::MatrixXd analytic = model.derivative(x, e);
    for (const Eigen::Index i : {u.ratio(0), u.young(), u.tissue(), u.load_turn(e),
                                 u.load_turn(e) + 2, u.load_turn(e) + 4, u.head(e) + 1}) {
      constexpr double h = 1e-5;
      Eigen::VectorXd more = x, less = x;
      more[i] += h;
      less[i] -= h;
      const Eigen::VectorXd numeric =
          (model.displacement(more, e) - model.displacement(less, e)) / (2 * h);
      EXPECT_EQ(numeric.norm() == 0, e == 2 && i == u.load_turn(e) + 4) << i;
      EXPECT_LE((analytic.col(i) - numeric).norm(), 1e-5 * numeric.norm()) << i;
    }
    // Tissue and support twice as stiff together move by half.
    Eigen::VectorXd stiff = x;
    stiff[u.young()] += std::log(2.0);
    EXPECT_LT((model.displacement(x, e) - 2 * model.displacement(stiff, e)).norm(), 1e-12);
    EXPECT_EQ(analytic.col(u.activations(0)).norm() + analytic.col(u.activations(e)).norm(), 0);
  }
  EXPECT_EQ(model.derivative(x, 0).col(u.young()).norm(), 0) << "muscles do not determine it";
}

TEST(KnownLoad, IsTheWeightOfTheTissueOrOfWhatHangsFromIt) {
  const TwinMesh& mesh = programs_mesh();
  const tissue::TissueMesh& tissue = *mesh.face.mesh;
  fem::System system;
  const fem::Material material = mesh.face.options.tissue.material(
      std::size_t(tissue.volume.tets.rows()), mesh.face.options.model.viscous_form);
  fem::Assembler(tissue.volume.nodes, tissue.volume.tets, fem::ElementKind::tet4)
      .assemble(material, system);
  const auto total = [](const Eigen::MatrixXd& force) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (Eigen::Index row = 0; row < force.rows(); ++row) sum.row(row % 3) += force.row(row);
    return sum;
  };
  const double volume_m3 =
      1e-9 * tissue::quality_of(tissue.volume.nodes, tissue.volume.tets).total_volume_mm3;
  const KnownLoad lying = lying_down(mesh.face.landmarks);
  const double mass_kg = material.density_kg_m3.front() * volume_m3;
  EXPECT_LT(
      (total(unit_forces_of(lying, tissue, system.mass)) - mass_kg * Eigen::Matrix3d::Identity())
          .norm(),
      1e-9 * mass_kg);
  EXPECT_NEAR(lying.amount().norm(), 9.81 * std::sqrt(2.0), 1e-9);
  const auto& landmarks = mesh.face.landmarks;
  EXPECT_GT(lying.amount().dot(landmarks.at("ibug68_27") - landmarks.at("ibug68_8")), 0) << "up";
  EXPECT_LT(lying.amount().dot(landmarks.at("ibug68_30") - landmarks.at("ibug68_36")), 0) << "back";
  const KnownLoad weight = hung_weight(landmarks, landmarks.at("ibug68_48"), 0.02);
  const Eigen::MatrixXd hung = unit_forces_of(weight, tissue, system.mass);
  EXPECT_LT((total(hung) - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_NEAR(weight.amount().norm(), 0.02 * 9.81, 1e-12);
  const Vec3 far = landmarks.at("ibug68_48") + Vec3(0, 0, 0.1);
  EXPECT_THROW(unit_forces_of(hung_weight(landmarks, far, 0.02), tissue, system.mass), InputError);
}

TEST(FaceResponses, AreThoseOfTheMusclesInTheScenesTissue) {
  const TwinMesh& mesh = programs_mesh();
  const std::vector<std::string> points{"ibug68_48", "ibug68_54", "ibug68_20"};
  FaceModel face = model_of({{mesh.cheeks()}, {}}, points);
  fem::Material material = mesh.face.options.tissue.material(
      std::size_t(mesh.face.mesh->volume.tets.rows()), mesh.face.options.model.viscous_form);
  stiffen_lips(*mesh.face.mesh, mesh.face.landmarks, mesh.face.options.muscles, material);
  fem::System system;
  fem::Assembler(mesh.face.mesh->volume.nodes, mesh.face.mesh->volume.tets,
                 mesh.face.options.model.element)
      .assemble(material, system);
  const auto model = muscle_model(*mesh.face.mesh, mesh.face.landmarks, mesh.face.options,
                                  system.stiffness, nullptr);
  const auto carrier = simulate::carriers(
      *mesh.face.mesh, simulate::skin_places(*mesh.face.mesh, points, face.places));
  const auto expect_same = [](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    EXPECT_LT((a - b).norm(), 1e-9 * b.norm());
  };
  const PointColumns& columns = face.responses.columns();
  expect_same(columns.muscles.narrow, simulate::at_places(carrier, model.response()));
  expect_same(columns.muscles.wide, simulate::at_places(carrier, model.wide_response()));
  expect_same(columns.jaw, simulate::at_places(carrier, model.jaw_response()));
  // Stiffer tissue moves less under the same forces; only the cheek's change is one-sided.
  face.responses.set_stiffness(Eigen::Vector2d(0, 1));
  EXPECT_LT(columns.muscles.narrow.norm(),
            0.7 * simulate::at_places(carrier, model.response()).norm());
  face.responses.set_stiffness(Eigen::Vector2d(1, 0));
  const auto moves = [&](const char* muscle, int point) {
    const auto& lines = face.responses.lines();
    const auto at = std::ranges::find(lines, muscle, &muscles::MuscleLine::name) - lines.begin();
    return columns.muscles.narrow.col(at).segment<3>(3 * point).norm();
  };
  EXPECT_LT(moves("zyg_major_L", 1), 0.95 * moves("zyg_major_R", 0));
}

TEST(Posterior, BothSidesAreTriedAlike) {
  FaceModel face = model_of({{}, {"zygomatic_R"}}, {"ibug68_48", "ibug68_54", "ibug68_8"});
  Observation seen;
  seen.displacement_m = Eigen::VectorXd::Zero(9);
  seen.head_turn_rad = seen.head_shift_m = 1e-3;
  const Assumptions assumed;
  Posterior posterior(face, {seen}, assumed);
  const Unknowns& u = posterior.unknowns();
  Eigen::VectorXd x = posterior.start();
  x.segment(u.activations(0), u.muscles).setConstant(0.4);
  const Eigen::MatrixXd covariance = posterior.prior_precision(x).inverse();
  const int left = face.prior.left[0], right = face.prior.right[0];
  const auto at = [&](int a, int b) {
    return covariance(u.activations(0) + a, u.activations(0) + b);
  };
  // Var((L - R) / 2) and Var((L + R) / 2)
  const double difference = (at(left, left) + at(right, right) - 2 * at(left, right)) / 4;
  const double mean = (at(left, left) + at(right, right) + 2 * at(left, right)) / 4;
  EXPECT_NEAR(difference,
              std::pow(0.4 * assumed.side, 2) + std::pow(0.4 * assumed.muscle, 2) +
                  std::pow(assumed.least_difference, 2),
              1e-9);
  EXPECT_NEAR(mean, std::pow(face.prior.sigma[0], 2), 1e-9);
  EXPECT_NEAR(covariance(u.gain(0), u.gain(0)), 1, 1e-9);
}

TEST(Posterior, AWeakBranchIsFoundAndItsIntervalIsThatOfTheProfile) {
  const auto points = inner_points();
  FaceModel face = model_of({{}, {"zygomatic_R"}}, points);
  const auto seen =
      observations_of({.gain = 0.5, .noise_m = 1e-4}, {"smile", "eye closure"}, points);
  Posterior posterior(face, seen, {});
  const Mode mode = posterior.find(posterior.start(), {});
  EXPECT_LT(mode.rms_m, 3e-4);
  const AskedInterval gain = interval_of(posterior, mode, 0);
  EXPECT_NEAR(gain.value, 0.5, 0.1);
  EXPECT_LT(gain.profile.high, 1);
  EXPECT_NEAR(gain.profile.low, gain.laplace.low, 0.3 * gain.sigma + 0.02);
  EXPECT_NEAR(gain.profile.high, gain.laplace.high, 0.7 * gain.sigma + 0.02);
  // At an end of the profile's interval the posterior has fallen by exp(-1.92).
  const Mode end = posterior.find(mode.x, {{0, gain.profile.high}}, mode.error_scale);
  EXPECT_NEAR(end.cost - mode.cost, 1.92, 0.4);
  for (const ErrorPart& part : error_parts(mode, posterior.unknowns(), 0)) {
    EXPECT_GE(part.share, -1e-9) << part.words;
    EXPECT_LE(part.share, 1) << part.words;
  }
}

TEST(Posterior, ErrorsAreEnlargedWhereTheRecordingsShowMore) {
  std::vector<std::string> points;
  for (int p = 17; p < 68; p += 2) points.push_back(face::ibug(p));
  FaceModel face = model_of({{}, {"zygomatic_R"}}, points);
  auto seen = observations_of({.noise_m = 1e-4}, {"smile"}, points);
  Posterior usual(face, seen, {});
  EXPECT_EQ(usual.find(usual.start(), {}).error_scale, 1);
  // Errors of 1 mm that neither muscles nor the stated noise explain.
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0, 1e-3);
  for (double& coordinate : seen.front().displacement_m) coordinate += normal(random);
  Posterior rough(face, seen, {});
  EXPECT_GT(rough.find(rough.start(), {}).error_scale, 2);
}

TEST(Posterior, WhatMovesThePointsAlikeIsNotToldApart) {
  const std::vector<std::string> seven{"ibug68_48", "ibug68_54", "ibug68_51", "ibug68_57",
                                       "ibug68_8",  "ibug68_58", "ibug68_56"};
  FaceModel face = model_of({{}, {"zyg_major_R", "lev_anguli_R"}}, seven);
  Posterior posterior(face, observations_of({.gain = 0.5, .weak = "zyg_major_R"}, {"smile"}, seven),
                      {});
  const Mode mode = posterior.find(posterior.start(), {});
  const Eigen::MatrixXd c = asked_covariance(mode, posterior.unknowns());
  EXPECT_GT(2 * kWithin95 * std::sqrt(c(1, 1)), kWidestGain);
  EXPECT_LT(c(0, 1), 0) << "more of one is less of the other";
}

TEST(Proposals, AreWhatTheRecordingThenGives) {
  const auto points = inner_points();
  FaceModel face = model_of({{}, {"zygomatic_R"}}, points);
  const std::vector<std::string> both{"smile", "eye closure"};
  const auto seen = observations_of({.gain = 0.6}, both, points);
  const auto sigma_of = [&](const std::vector<Observation>& some) {
    Posterior posterior(face, some, {});
    const Mode mode = posterior.find(posterior.start(), {});
    return std::pair(std::sqrt(asked_covariance(mode, posterior.unknowns())(0, 0)),
                     proposals(face, posterior, mode, {}));
  };
  const auto [alone, further] = sigma_of({seen.front()});
  const auto best = std::ranges::min_element(further, {}, [](const auto& p) { return p.sigma[0]; });
  EXPECT_LT(best->sigma[0], alone);
  const auto closure = std::ranges::find(further, "eye closure", &Proposal::expression);
  ASSERT_NE(closure, further.end());
  EXPECT_NEAR(sigma_of(seen).first / closure->sigma[0], 1, 0.35);
}

}  // namespace
}  // namespace hyperex::estimate::test
