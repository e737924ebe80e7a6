// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/run/solve.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hyperex/core/progress.hpp"
#include "hyperex/motion/resample.hpp"
#include "hyperex/simulate/drive/input_shapes.hpp"
#include "simulate/small_face.hpp"
#include "support/layer.hpp"
#include "support/note_matchers.hpp"

namespace hyperex::simulate {
namespace {

/// Solves as a simulator does, for matrices and a drive of the test.
Solution solve(const fem::System& system, const std::vector<int>& prescribed,
               const fem::Drive& drive, const std::vector<double>& times,
               const SolverOptions& options, double dt_s) {
  const fem::NewmarkOptions newmark{dt_s, options.newmark_beta, options.newmark_gamma};
  fem::Newmark full(system, prescribed, newmark);
  if (options.method == SolverMethod::direct) return run_full(full, drive, times);
  fem::ReducedModel model(system, prescribed);
  Solution out = run_reduced(model, model.run(drive, {newmark, options.tolerance}), times);
  if (options.verify)
    out.verified_error =
        greatest_difference(out.displacement, run_full(full, drive, times).displacement);
  return out;
}

class SolveFace : public testing::Test {
 protected:
  static constexpr double kDt = 0.005;

  SolveFace() {
    Progress::silence(true);
    SimulationOptions options;
    options.drive.points = test::seven_points();
    Boundary boundary(face_.mesh, face_.landmarks, motion_,
                      measured_region(face_.mesh, face_.landmarks, motion_, options.region),
                      options.drive, options.support);
    const auto tets = static_cast<std::size_t>(face_.mesh.volume.tets.rows());
    system_ = fem::assemble(face_.mesh.volume.nodes, face_.mesh.volume.tets,
                            options.tissue.material(tets, options.model.viscous_form),
                            options.model.element);
    boundary.add_springs(system_.stiffness);
    prescribed_ = boundary.prescribed();
    const motion::MotionCurve curve(motion_.motion);
    drive_ =
        input_shapes(
            boundary, [&](double t) { return Points(curve.at(t) - motion_.rest); }, kDt, 80, 1e-6)
            .drive;
    for (int k = 0; k <= 80; ++k) steps_.push_back(k);
  }
  ~SolveFace() override { Progress::silence(false); }

  Solution run(const SolverOptions& options) const {
    return solve(system_, prescribed_, drive_, steps_, options, kDt);
  }
  Solution direct() const {
    SolverOptions options;
    options.method = SolverMethod::direct;
    return run(options);
  }

  const test::SmallFace face_ = test::small_face();
  const AlignedMotion motion_ = test::mouth_opening(face_.landmarks, 12, 13, 30);
  fem::System system_;
  std::vector<int> prescribed_;
  fem::Drive drive_;
  std::vector<double> steps_;
};

/// 0.03 mm of 10 mm is not worth a warning, the same share of 20 mm is.
TEST(ReducedError, IsAWarningWhereItMattersAndElseANote) {
  Solution stopped;
  stopped.basis_size = 405;
  stopped.estimated_error = 3.1e-3;
  stopped.greatest_displacement_m = 0.010;
  stopped.converged = false;
  using namespace hyperex::test;
  using testing::AllOf;
  const auto named =
      AllOf(says("405 vectors"), says("3.1e-03"), says("solver.tolerance asks for 0.001"),
            says("solver.method = \"direct\""), is_about("solver.method"));
  EXPECT_THAT(note_on_reduced_error(stopped, 1e-3),
              testing::Optional(AllOf(is_note("solver.reduced_error_small"), named,
                                      says("0.031 mm, too little to matter"))));
  stopped.greatest_displacement_m = 0.020;
  EXPECT_THAT(note_on_reduced_error(stopped, 1e-3),
              testing::Optional(
                  AllOf(is_warning("solver.reduced_not_converged"), named, says("is 0.062 mm: "))));
  stopped.converged = true;
  EXPECT_EQ(note_on_reduced_error(stopped, 1e-3), std::nullopt);
}

TEST_F(SolveFace, ReducedAgreesWithDirectToItsTolerance) {
  const Solution full = direct();
  EXPECT_EQ(full.basis_size, 0);
  EXPECT_EQ(full.estimated_error, -1);
  EXPECT_EQ(full.verified_error, -1);
  const double most = hyperex::test::greatest_motion(full.displacement);
  EXPECT_GT(most, 0.01);
  int before = 0;
  for (const double tolerance : {1e-1, 1e-3, 1e-5}) {
    SolverOptions options;
    options.tolerance = tolerance;
    options.verify = true;
    const Solution reduced = run(options);
    const double error =
        hyperex::test::greatest_motion(reduced.displacement - full.displacement) / most;
    std::printf("tolerance %.0e: error %.1e, estimated %.1e, %d vectors\n", tolerance, error,
                reduced.estimated_error, reduced.basis_size);
    EXPECT_TRUE(reduced.converged);
    EXPECT_LE(error, tolerance);
    EXPECT_LE(error, 1.5 * reduced.estimated_error);
    EXPECT_NEAR(reduced.verified_error, error, 1e-12 + 1e-6 * error);
    EXPECT_GT(reduced.basis_size, before) << "the tolerance reaches the basis";
    EXPECT_EQ(reduced.free_dofs, full.free_dofs);
    before = reduced.basis_size;
    options.verify = false;
    EXPECT_EQ(run(options).verified_error, -1);
  }
}

TEST_F(SolveFace, BetaAndGammaReachBothMethods) {
  const Solution full = direct();
  const double most = hyperex::test::greatest_motion(full.displacement);
  for (const auto& [beta, gamma] : {std::pair{0.25, 0.5}, {0.3025, 0.6}, {0.5, 0.9}}) {
    SolverOptions options;
    options.newmark_beta = beta;
    options.newmark_gamma = gamma;
    // With strong numerical damping the estimate falls short: 5e-6 for a true 5e-5.
    options.tolerance = gamma < 0.8 ? 1e-5 : 1e-4;
    const Solution reduced = run(options);
    options.method = SolverMethod::direct;
    const Solution other = run(options);
    EXPECT_LT(hyperex::test::greatest_motion(reduced.displacement - other.displacement),
              options.tolerance * most)
        << gamma << ": estimated " << reduced.estimated_error << ", " << reduced.basis_size;
    if (gamma > 0.5) {
      EXPECT_GT(hyperex::test::greatest_motion(other.displacement - full.displacement),
                5e-6 * most);
    } else {
      EXPECT_EQ(hyperex::test::greatest_motion(other.displacement - full.displacement), 0);
    }
  }
}

/// A tissue without viscosity after an impact: gamma = 0.6 damps the remaining vibration, 0.5 does
/// not.
TEST_F(SolveFace, GammaAboveAHalfDamps) {
  system_.damping *= 0;
  const auto ringing = [&](double beta, double gamma) {
    SolverOptions options;
    options.method = SolverMethod::direct;
    options.newmark_beta = beta;
    options.newmark_gamma = gamma;
    fem::Drive struck = drive_;
    struck.s *= 0;
    struck.rate *= 0;
    struck.second *= 0;
    struck.s.col(0) = struck.s.col(1) = drive_.s.col(40);
    struck.prescribed *= 0;
    const Solution s = solve(system_, prescribed_, struck, steps_, options, kDt);
    return hyperex::test::greatest_motion(s.displacement.rightCols(20)) /
           hyperex::test::greatest_motion(s.displacement);
  };
  EXPECT_GT(ringing(0.25, 0.5), 0.1);
  EXPECT_LT(ringing(0.3025, 0.6), 0.5 * ringing(0.25, 0.5));
}

TEST_F(SolveFace, ReadsOffBetweenSteps) {
  SolverOptions options;
  for (const SolverMethod method : {SolverMethod::direct, SolverMethod::reduced}) {
    options.method = method;
    const Eigen::MatrixXd all = run(options).displacement;
    const std::vector<double> times = {0, 0.5, 1, 7.25, 7.75, 40, 79.9, 80};
    const Eigen::MatrixXd some =
        solve(system_, prescribed_, drive_, times, options, kDt).displacement;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const auto before = std::min<Eigen::Index>(static_cast<Eigen::Index>(times[i]), 79);
      const double share = times[i] - static_cast<double>(before);
      const Eigen::VectorXd expected = (1 - share) * all.col(before) + share * all.col(before + 1);
      EXPECT_LT((some.col(static_cast<Eigen::Index>(i)) - expected).cwiseAbs().maxCoeff(), 1e-12)
          << times[i];
    }
  }
}

TEST_F(SolveFace, GivesTheSameNumbersTwice) {
  for (const SolverMethod method : {SolverMethod::direct, SolverMethod::reduced}) {
    SolverOptions options;
    options.method = method;
    EXPECT_EQ((run(options).displacement - run(options).displacement).cwiseAbs().maxCoeff(), 0);
  }
}

}  // namespace
}  // namespace hyperex::simulate
