// SPDX-License-Identifier: GPL-3.0-or-later
// Twin experiments with changed tissue (support/muscle_twin.hpp): the program's predictions for
// other tissue and for a weaker muscle are compared with the effect of the true forces.
#include <gtest/gtest.h>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "muscles/a_face.hpp"
#include "simulate/small_face.hpp"
#include "support/muscle_twin.hpp"

namespace hyperex::test {
namespace {

constexpr double kMarkerNoise_m = 0.0003;

class ChangedTwin : public testing::Test {
 protected:
  ChangedTwin() {
    const muscles::test::AFace& face = muscles::test::a_face();
    face_.mesh = std::make_shared<const tissue::TissueMesh>(face.mesh);
    face_.landmarks = face.landmarks;
    face_.options.time.step_s = 0.01;
    const face::FaceFrame frame = face::face_frame(face.landmarks);
    const auto& volume = face.mesh.volume;
    std::vector<double> all(std::size_t(volume.tets.rows()), 2.0), cheek(all.size(), 1.0);
    for (Eigen::Index t = 0; t < volume.tets.rows(); ++t)
      if (frame.local(volume.nodes.row(volume.tets(t, 0)).transpose()).x() > 0.02)
        cheek[std::size_t(t)] = 5;
    changes_ = {
        {"left half stiff", cheek}, {"all stiff", all}, {"weak", {}, {{"zyg_major_L", 0.3}}}};
  }
  TwinAnswer answer(const TwinTruth& truth, const std::vector<std::string>& points) const {
    return twin_answer(face_, truth, left_smile(), changes_, points, kMarkerNoise_m, 5);
  }
  /// |found - true| / true of the left corner's way after a change.
  static double error(const TwinAnswer& a, std::size_t change) {
    return std::abs(a.found[change + 1].left_mm / a.truth[change + 1].left_mm - 1);
  }
  static constexpr std::size_t kCheek = 0, kAll = 1, kWeak = 2;
  TwinFace face_;
  std::vector<TwinChange> changes_;
};

TEST_F(ChangedTwin, CornersAreThoseOfTheTruth) {
  const TwinTruth truth(face_, muscles::muscle_template(), 1, changes_);
  for (const auto& points : {face::all_ibug(), face_.options.drive.points}) {
    const TwinAnswer a = answer(truth, points);
    EXPECT_GT(a.truth[0].left_mm, 7);
    EXPECT_NEAR(a.found[0].left_mm, a.truth[0].left_mm, 0.3) << "the recording is met";
    for (const std::size_t change : {kCheek, kAll, kWeak}) {
      EXPECT_LT(a.truth[change + 1].left_mm, 0.75 * a.truth[0].left_mm) << "there is a change";
      EXPECT_LT(error(a, change), 0.10) << changes_[change].name << ", " << points.size();
      EXPECT_NEAR(a.found[change + 1].right_mm, a.truth[change + 1].right_mm, 0.2);
    }
    EXPECT_GT(correlation(a.true_groups, a.found_groups), 0.95);
  }
}

TEST_F(ChangedTwin, TissueOfAnotherStiffnessCostsLittle) {
  const TwinTruth truth(face_, muscles::muscle_template(), 2, changes_);
  const TwinAnswer a = answer(truth, face::all_ibug());
  for (const std::size_t change : {kCheek, kAll, kWeak}) EXPECT_LT(error(a, change), 0.15);
}

/// The effect of the tissue hardly depends on which muscles the force is attributed to. The effect
/// of a weaker muscle depends on that muscle's share, which is wrong where its line is wrong.
TEST_F(ChangedTwin, DisplacedLinesCostTheAnswerOnOneMuscleMost) {
  const TwinTruth truth(face_, displaced_lines(muscles::muscle_template(), 4, 11), 1, changes_);
  const TwinAnswer a = answer(truth, face::all_ibug());
  EXPECT_LT(error(a, kCheek), 0.10);
  EXPECT_LT(error(a, kAll), 0.10);
  EXPECT_LT(error(a, kWeak), 0.5);
}

}  // namespace
}  // namespace hyperex::test
