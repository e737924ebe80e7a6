// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/fold_depth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "hyperex/anatomy/landmarks.hpp"
#include "hyperex/io/scan.hpp"

namespace hyperex::metrics {
namespace {

/// A slope with a Gaussian groove whose middle is at 10 mm.
std::vector<double> profile(double depth_mm, double slope, double sigma_mm = 2) {
  std::vector<double> out;
  for (int i = 0; i < 128; ++i) {
    const double s = 0.25 * i;
    out.push_back(slope * s - depth_mm * std::exp(-0.5 * std::pow((s - 10) / sigma_mm, 2)));
  }
  return out;
}

TEST(Groove, HasTheDepthBelowAStraightLineWhateverItsSlope) {
  EXPECT_NEAR(groove_of(profile(3, 0), 0.25).depth_mm, 3, 0.02);
  EXPECT_NEAR(groove_of(profile(3, 0), 0.25).place_mm, 10, 0.26);
  // At right angles to a line that rises by 1 in 1.
  EXPECT_NEAR(groove_of(profile(3, 1), 0.25).depth_mm, 3 / std::sqrt(2.0), 0.05);
  EXPECT_NEAR(groove_of(profile(0, 0.4), 0.25).depth_mm, 0, 1e-12);
  // A bulge is none.
  EXPECT_LT(groove_of(profile(-3, 0, 8), 0.25).depth_mm, 0.7);
  auto torn = profile(3, 0);
  std::fill(torn.begin() + 20, torn.end(), std::nan(""));
  EXPECT_LT(groove_of(torn, 0.25).depth_mm, 0.1);
}

/// The real face: shared/design/fold.md has 3.83 mm for its smile, as the mean of six cuts.
TEST(FoldCuts, OfARealSmileAreAsDeepAsMeasuredBefore) {
  const std::filesystem::path data =
      std::filesystem::path(HYPEREX_SHARED_DIR) / "data/real/spacetime";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "the real smile is not here";
  const io::Scan rest = io::read_scan(data / "neutral.ply"),
                 smile = io::read_scan(data / "smile.ply");
  // Vertices correspond: landmarks of the smile are those of the same vertices.
  const auto at_rest =
      anatomy::complete_landmarks(io::read_landmarks(data / "landmarks.json"), rest.mesh).landmarks;
  io::Landmarks smiling;
  for (const auto& [name, place] : at_rest) {
    Eigen::Index nearest = 0;
    (rest.mesh.points.rowwise() - place.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
    smiling[name] =
        place + (smile.mesh.points.row(nearest) - rest.mesh.points.row(nearest)).transpose();
  }
  const auto mean_depth = [](const TriMesh& skin, const io::Landmarks& landmarks) {
    double sum = 0;
    for (const bool left : {false, true})
      for (const FoldCut& cut : fold_cuts(skin, landmarks, left)) {
        sum += cut.depth_mm / 6;
        EXPECT_EQ(std::isnan(cut.outward_mm), cut.depth_mm < 0.5);
      }
    return sum;
  };
  // A hole over the right fold: nothing is known there.
  TriMesh torn = rest.mesh;
  const Vec3 hole = 0.5 * (at_rest.at("ibug68_31") + at_rest.at("ibug68_48")) + Vec3(-0.006, 0, 0);
  Eigen::Index kept = 0;
  for (Eigen::Index t = 0; t < torn.triangles.rows(); ++t)
    if ((torn.points.row(torn.triangles(t, 0)).transpose() - hole).head<2>().norm() > 0.007)
      torn.triangles.row(kept++) = torn.triangles.row(t);
  torn.triangles.conservativeResize(kept, 3);
  EXPECT_TRUE(std::isnan(fold_cuts(torn, at_rest, false)[1].depth_mm));
  EXPECT_FALSE(std::isnan(fold_cuts(torn, at_rest, true)[1].depth_mm));
  const double before = mean_depth(rest.mesh, at_rest), after = mean_depth(smile.mesh, smiling);
  std::printf("rest %.2f mm, smile %.2f mm\n", before, after);
  EXPECT_NEAR(after, 3.83, 0.4);
  EXPECT_LT(before, after - 1);
}

}  // namespace
}  // namespace hyperex::metrics
