// SPDX-License-Identifier: GPL-3.0-or-later
// Two recordings of one face, compared by points that the user chose to hold the head.
#include <fstream>
#include <functional>
#include <limits>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/motion/embedded_motion.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "hyperex/visits/compare_visits.hpp"
#include "hyperex/visits/summary.hpp"
#include "unit/studio/session_fixture.hpp"

namespace hyperex::studio {
namespace {

using testing::HasSubstr;

/// The mouth opens; four points of a band slip by `slip_m` over the whole recording.
motion::Motion opening_with_band(double opening_deg, double slip_m, const std::string& name) {
  motion::MouthOpeningOptions options;
  options.peak_deg = opening_deg;
  options.head_moves = false;
  motion::Motion motion =
      motion::embedded_mouth_opening(anatomy::embedded_face().landmarks, options);
  const Points rest = motion.positions.front();
  const auto brow = [&](int i) { return rest.row(motion.index_of(face::ibug(i))).eval(); };
  const Eigen::RowVector3d places[] = {brow(17), brow(19), brow(24), brow(26)};
  for (std::size_t k = 0; k < motion.positions.size(); ++k) {
    Points& at = motion.positions[k];
    const double share = double(k) / double(motion.positions.size() - 1);
    at.conservativeResize(at.rows() + 4, Eigen::NoChange);
    for (int i = 0; i < 4; ++i)
      at.row(at.rows() - 4 + i) =
          places[i] + Eigen::RowVector3d(0, 0.03 + 0.02 * (i % 2) + slip_m * share, -0.01);
  }
  for (int i = 1; i <= 4; ++i) motion.names.push_back(name + std::to_string(i));
  return motion;
}

TEST_F(StudioSession, VisitsHoldTheHeadByThePointsThatTheUserChose) {
  open();
  visits::VisitsFile file;
  // How far the corners go depends on the head's pose, the opening of the lips does not.
  file.expression = *visits::expression_named("smile");
  const auto drop = [&](const std::string& name, const motion::Motion& motion) {
    visits::VisitEntry visit;
    visit.label = name;
    visit.recordings = {folder_.path() / "own" / "uploads" / name};
    motion::write_motion_csv(visit.recordings.front(), motion);
    EXPECT_FALSE(ask("open", {{"what", "current"}, {"recording", name}}).contains("error"));
    file.visits.push_back(visit);
  };
  const auto compared = [&] {
    return ask("compare_visits", {{"expression", "smile"}, {"name", "change"}});
  };
  const json band = {"head_1", "head_2", "head_3", "head_4"};
  drop("visit1.csv", opening_with_band(12, 0.01, "head_"));
  EXPECT_FALSE(set({{"motion.rigid_points", band}}, 0).contains("error"));
  drop("visit2.csv", opening_with_band(8, -0.01, "head_"));
  const auto by_landmarks = visits::summary(visits::compare_visits(file));
  file.rigid_points = band.get<std::vector<std::string>>();
  const auto by_band = visits::summary(visits::compare_visits(file));
  ASSERT_NE(by_band, by_landmarks);
  EXPECT_EQ(compared()["sentences"].get<std::vector<std::string>>(), by_band)
      << "chosen for the recording before";
  EXPECT_FALSE(set({{"motion.rigid_points", band}}, 0).contains("error"));
  EXPECT_EQ(compared()["sentences"].get<std::vector<std::string>>(), by_band)
      << "chosen for the present one";
  drop("visit3.csv", opening_with_band(8, 0.01, "hat_"));
  EXPECT_THAT(compared().value("error", ""), HasSubstr("visit3.csv has no point head_1"));
}

/// One reading is empty, another one has the zeros that some systems write.
TEST_F(StudioSession, VisitsFillTheGapsOfChosenPointsAsARunDoes) {
  open();
  const auto drop = [&](const std::string& name, double opening_deg, double slip_m) {
    motion::Motion motion = opening_with_band(opening_deg, slip_m, "head_");
    const int row = motion.index_of("head_2");
    motion.positions[5].row(row).setConstant(std::numeric_limits<double>::quiet_NaN());
    motion.positions[9].row(row).setZero();
    motion::write_motion_csv(folder_.path() / "own" / "uploads" / name, motion);
    EXPECT_FALSE(ask("open", {{"what", "current"}, {"recording", name}}).contains("error"));
  };
  drop("visit1.csv", 12, 0.01);
  EXPECT_FALSE(set({{"motion.rigid_points", {"head_1", "head_2", "head_4"}}}, 0).contains("error"));
  drop("visit2.csv", 8, -0.01);
  const json answer = ask("compare_visits", {{"expression", "mouth open"}, {"name", "change"}});
  ASSERT_FALSE(answer.contains("error")) << answer;
  for (const char* file : {"visit_1.csv", "visit_2.csv"}) {
    const motion::Motion compared = motion::read_motion(folder_.path() / "own" / file);
    const int row = compared.index_of("head_2");
    for (const std::size_t lost : {5u, 9u}) {
      const Points& at = compared.positions[lost];
      EXPECT_LT((compared.positions[lost - 1].row(row) - at.row(row)).norm(), 0.001) << file;
    }
  }
}

/// A face that weights move has no band, and its head is still.
TEST_F(StudioSession, VisitsHoldTheHeadByNoChosenPointsWhereWeightsMoveAFace) {
  open();
  const auto drop = [&](const std::string& name,
                        const std::function<void(const fs::path&)>& write) {
    write(folder_.path() / "own" / "uploads" / name);
    EXPECT_FALSE(ask("open", {{"what", "current"}, {"recording", name}}).contains("error"));
  };
  const auto weights = [](const fs::path& file) {
    std::ofstream out(file);
    out << "time_s,jawOpen\n";
    for (int k = 0; k <= 30; ++k) out << k / 30.0 << ',' << std::min(0.5, k / 30.0) << '\n';
  };
  const auto points = [](const fs::path& file) {
    motion::write_motion_csv(file, opening_with_band(12, 0.01, "head_"));
  };
  const auto compared = [&] {
    return ask("compare_visits", {{"expression", "mouth open"}, {"name", "change"}});
  };
  const json band = {"head_1", "head_2", "head_3", "head_4"};
  drop("visit1.csv", points);
  EXPECT_FALSE(set({{"motion.rigid_points", band}}, 0).contains("error"));
  drop("visit2.csv", weights);
  json answer = compared();
  EXPECT_FALSE(answer.contains("error")) << answer;
  drop("visit3.csv", points);
  EXPECT_FALSE(set({{"motion.rigid_points", band}}, 0).contains("error"));
  answer = compared();
  EXPECT_FALSE(answer.contains("error")) << answer;
}

}  // namespace
}  // namespace hyperex::studio
