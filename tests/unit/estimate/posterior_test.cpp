// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/estimate/posterior.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include "estimate/estimate_twin.hpp"
#include "hyperex/estimate/intervals.hpp"
#include "hyperex/estimate/proposal.hpp"

namespace hyperex::estimate::test {
namespace {

FaceModel model_of(const Question& question, const std::vector<std::string>& points) {
  const TwinMesh& mesh = programs_mesh();
  return face_model(*mesh.face.mesh, mesh.face.landmarks, mesh.face.options, points,
                    places_of(points), question);
}

TEST(RecordingModel, DerivativeIsThatOfFiniteDifferences) {
  const std::vector<std::string> points{"ibug68_48", "ibug68_54", "ibug68_8", "ibug68_51"};
  FaceModel face = model_of({{programs_mesh().cheeks()}, {"zygomatic_R", "zyg_major_R"}}, points);
  Observation seen;
  seen.displacement_m = Eigen::VectorXd::Constant(12, 1e-3);
  seen.head_turn_rad = seen.head_shift_m = 1e-3;
  Posterior posterior(face, {seen, seen}, {});
  const Unknowns& u = posterior.unknowns();
  RecordingModel model(face, u);
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

TEST(Posterior, Trial) {
  using Clock = std::chrono::steady_clock;
  const auto points = inner_points();
  const std::vector<std::string> expressions{"smile", "pucker"};
  auto t0 = Clock::now();
  const auto lap = [&](const char* what) {
    std::printf("%s %.2f s\n", what, std::chrono::duration<double>(Clock::now() - t0).count());
    t0 = Clock::now();
  };
  for (const unsigned seed : {1u, 2u, 3u}) {
    Patient patient{.cheek_ratio = 2, .seed = seed};
    if (seed > 1) patient.lines_off_m = 2e-3;
    if (seed > 2) patient.young_factor = 1.5, patient.uneven = 0.05;
    const auto seen = observations_of(patient, expressions, points);
    lap("truth");
    FaceModel face = model_of({{programs_mesh().cheeks()}, {"zygomatic_R"}}, points);
    lap("model");
    Posterior posterior(face, seen, {});
    const Mode mode = posterior.find(posterior.start(), {});
    lap("mode");
    std::printf(
        "nodes %d, unknowns %d, iterations %d, scale %.2f, rms %.3f mm, ratio %.3f gain %.3f "
        "tissue %.3f\n",
        int(programs_mesh().face.mesh->volume.nodes.rows()), int(mode.x.size()), mode.iterations,
        mode.error_scale, 1e3 * mode.rms_m, std::exp(mode.x[0]), mode.x[1], std::exp(mode.x[2]));
    for (int k = 0; k < 2; ++k) {
      const AskedInterval i = interval_of(posterior, mode, k);
      std::printf("  value %.3f sigma %.3f laplace %.3f %.3f profile %.3f %.3f\n", i.value, i.sigma,
                  i.laplace.low, i.laplace.high, i.profile.low, i.profile.high);
      for (const auto& p : error_parts(mode, posterior.unknowns(), k))
        std::printf("      %.2f %s\n", p.share, p.words);
    }
    lap("intervals");
    for (const auto& p : proposals(face, posterior, mode, {}))
      std::printf("  %-20s %.3f %.3f\n", p.expression.c_str(), p.sigma[0], p.sigma[1]);
    lap("proposals");
  }
}

}  // namespace
}  // namespace hyperex::estimate::test
