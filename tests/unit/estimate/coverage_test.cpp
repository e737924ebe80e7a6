// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "estimate/estimate_twin.hpp"
#include "hyperex/estimate/intervals.hpp"
#include "hyperex/estimate/posterior.hpp"

namespace hyperex::estimate::test {
namespace {

double env(const char* name, double other) {
  const char* text = std::getenv(name);
  return text ? std::atof(text) : other;
}

TEST(Coverage, Explore) {
  const int draws = int(env("HYPEREX_DRAWS", 6));
  auto points = inner_points();
  const TwinMesh& mesh = programs_mesh();
  if (env("CHEEKS", 0) > 0)
    for (const char* side : {"_L", "_R"})
      for (const char* name : {"cheek", "cheekbone", "zygion"})
        if (mesh.face.landmarks.count(std::string(name) + side)) points.push_back(std::string(name) + side);
  std::vector<std::string> expressions{"smile", "pucker"};
  if (env("MANY", 0) > 0) expressions = {"smile", "pucker", "mouth open", "show upper teeth", "show lower teeth"};
  Question question{{mesh.cheeks()}, {}};
  if (env("GAIN", 1) > 0) question.gains = {"zygomatic_R"};
  FaceModel face = face_model(*mesh.face.mesh, mesh.face.landmarks, mesh.face.options, points,
                              places_of(points), question);
  Assumptions a;
  a.misfit_share = env("SHARE", a.misfit_share);
  a.misfit_m = env("MISFIT", a.misfit_m);
  a.side = env("SIDE", a.side);
  a.muscle = env("MUSCLE", a.muscle);
  a.log_tissue = env("TISSUE", a.log_tissue);
  double z2[2] = {}, sigma[2] = {}, error2[2] = {};
  int inside[2] = {};
  for (int d = 0; d < draws; ++d) {
    std::mt19937 random(unsigned(d) + 100);
    std::normal_distribution<double> normal;
    Patient patient{.seed = unsigned(d) + 1};
    patient.cheek_ratio = d % 2 ? env("RATIO", 2) : 1;
    patient.gain = d % 4 < 2 ? 1 : 0.6;
    patient.lines_off_m = env("LINES", 2e-3);
    patient.young_factor = std::exp(env("WHOLE", 0.3) * normal(random));
    patient.uneven = env("UNEVEN", 0.05);
    Posterior posterior(face, observations_of(patient, expressions, points), a);
    const Mode mode = posterior.find(posterior.start(), {});
    const Eigen::MatrixXd c = asked_covariance(mode, posterior.unknowns());
    const double truth[2] = {std::log(patient.cheek_ratio), patient.gain};
    for (int k = 0; k < int(c.rows()); ++k) {
      const double s = std::sqrt(c(k, k)), z = (mode.x[k] - truth[k]) / s;
      z2[k] += z * z;
      sigma[k] += s;
      error2[k] += std::pow(mode.x[k] - truth[k], 2);
      inside[k] += std::abs(z) < 1.96;
    }
    if (env("PRINT", 0) > 0)
      std::printf("%d ratio %.2f of %.2f (s %.2f) gain %.2f of %.2f tissue %.2f of %.2f scale %.2f rms %.3f it %d\n", d, std::exp(mode.x[0]),
                  patient.cheek_ratio, std::sqrt(c(0, 0)), mode.x[1], patient.gain, std::exp(mode.x[posterior.unknowns().tissue()]), patient.young_factor,
                  mode.error_scale, 1e3 * mode.rms_m, mode.iterations);
  }
  for (int k = 0; k < 2; ++k)
    std::printf("%s: inside %d of %d, rms z %.2f, mean sigma %.3f, rms error %.3f\n", k ? "gain" : "ratio",
                inside[k], draws, std::sqrt(z2[k] / draws), sigma[k] / draws,
                std::sqrt(error2[k] / draws));
}

}  // namespace
}  // namespace hyperex::estimate::test
