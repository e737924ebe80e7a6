// SPDX-License-Identifier: GPL-3.0-or-later
// The estimated jitter of a recording that was tracked into a file, compared with the true jitter.
#include <gmock/gmock.h>

#include <cmath>

#include "apps/good_inputs.hpp"
#include "apps/program.hpp"
#include "hyperex/geometry/transform.hpp"
#include "hyperex/metrics/symmetry.hpp"
#include "hyperex/motion/jitter.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "hyperex/motion/stabilise.hpp"

namespace hyperex {
namespace {

namespace fs = std::filesystem;
const fs::path kRecordings = fs::path(HYPEREX_SHARED_DIR) / "data/rgbd";

class TrackedJitter : public ProgramTest, public testing::WithParamInterface<std::string> {};

/// Root mean square change of the tracked points' errors from frame to frame, divided by sqrt(2).
/// This is the jitter, since lasting errors change slowly.
double true_jitter_m(const motion::Motion& tracked, const motion::Motion& truth,
                     const std::vector<int>& columns) {
  const auto rows_of = [&](const motion::Motion& m, const Points& sample) {
    Points some(Eigen::Index(columns.size()), 3);
    for (std::size_t i = 0; i < columns.size(); ++i)
      some.row(Eigen::Index(i)) = sample.row(m.index_of(tracked.names[std::size_t(columns[i])]));
    return some;
  };
  const Similarity onto = fit_similarity(rows_of(truth, truth.positions.front()),
                                         rows_of(tracked, tracked.positions.front()));
  double squares = 0, count = 0;
  Points last;
  for (std::size_t k = 0; k < tracked.positions.size(); ++k) {
    const Points error =
        rows_of(tracked, tracked.positions[k]) - onto.apply(rows_of(truth, truth.positions[k]));
    if (k > 0) squares += (error - last).squaredNorm(), count += double(error.size());
    last = error;
  }
  return std::sqrt(squares / count / 2);
}

TEST_P(TrackedJitter, IsEstimatedFromTheFileAlone) {
  const fs::path recorded = kRecordings / GetParam();
  if (!fs::exists(recorded)) GTEST_SKIP() << "no " << recorded;
  ASSERT_EQ(call("track '" + recorded.string() + "' --out m.csv").status, 0);
  put(in("run.toml"), "scan.file = \"embedded\"\nmotion.recording = '" + recorded.string() +
                          "'\nmesh.element_size_mm = 10\nmesh.layers = 1\n"
                          "time = { step_s = 0.05, end_s = 0.2 }\noutput = { glb = false, report = "
                          "false }\n");
  const motion::Motion tracked = motion::stabilise(motion::read_motion(in("m.csv"))).motion;
  const motion::Motion truth =
      motion::stabilise(motion::read_motion(recorded / "truth_landmarks68_camera_m.csv")).motion;
  std::vector<int> columns;
  for (const int k : {48, 54, 36, 45, 40, 41, 46, 47, 31, 35, 50, 52})
    columns.push_back(tracked.index_of("ibug68_" + std::to_string(k)));
  const double estimate_m = motion::jitter_of_motion(tracked, columns),
               true_m = true_jitter_m(tracked, truth, columns),
               at_rest_m = metrics::jitter_at_rest(tracked);
  std::printf("%s: estimated %.3f mm, by the truth %.3f mm, quietest half second %.3f mm\n",
              GetParam().c_str(), 1e3 * estimate_m, 1e3 * true_m, 1e3 * at_rest_m);
  EXPECT_NEAR(estimate_m / true_m, 1, 0.15);
  const Outcome run = call("run run.toml --out out");
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string reported = "estimated from their fourth differences in time: ";
  const auto at = run.err.find(reported);
  ASSERT_NE(at, std::string::npos) << run.err;
  const double rounding_mm = 0.005;
  EXPECT_NEAR(std::stod(run.err.substr(at + reported.size())), 1e3 * true_m,
              0.15e3 * true_m + rounding_mm);
}

INSTANTIATE_TEST_SUITE_P(Recordings, TrackedJitter,
                         testing::Values("subject_A_still", "subject_A_mouth_open",
                                         "subject_A_talk"),
                         [](const auto& tested) { return tested.param; });

}  // namespace
}  // namespace hyperex
