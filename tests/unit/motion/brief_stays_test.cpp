// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/brief_stays.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/motion/wild_samples.hpp"
#include "unit/motion/motions.hpp"

namespace hyperex::motion {
namespace {

constexpr Eigen::Index kMiddle = 4;

/// Nine points 10 mm apart in a plane, which breathe by 1 mm.
Motion nine_points(double rate_hz = 30, const std::string& middle = "p4") {
  return testing::sampled(int(2 * rate_hz), 1 / rate_hz,
                          {"p0", "p1", "p2", "p3", middle, "p5", "p6", "p7", "p8"},
                          [](double t, int p, int axis) {
                            const double place = axis == 2 ? 0 : 0.01 * (axis ? p / 3 : p % 3);
                            return 0.1 + place + (axis == 1 ? 1e-3 * std::sin(2 * M_PI * t) : 0);
                          });
}

/// Samples `first` on of the middle one are off.
Motion off_by(double off_m, std::size_t count, Motion motion, std::size_t first = 20) {
  for (std::size_t k = first; k < first + count; ++k) motion.positions[k](kMiddle, 2) += off_m;
  return motion;
}

double farthest_mm(const Motion& a, const Motion& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.positions.size(); ++k)
    most = std::max(most, 1e3 * (a.positions[k] - b.positions[k]).cwiseAbs().maxCoeff());
  return most;
}

/// Nothing is mended or named.
void expect_kept(const Motion& motion, const std::string& why) {
  const MendedMotion mended = without_wild_samples(motion);
  EXPECT_TRUE(mended.wild.empty()) << why;
  EXPECT_TRUE(mended.jumps.empty()) << why;
  EXPECT_EQ(farthest_mm(mended.motion, motion), 0) << why;
}

TEST(BriefStays, AreInterpolated) {
  for (const double rate_hz : {24.0, 30.0, 60.0, 120.0})
    for (const std::size_t count : {2, 3})
      for (const double off_m : {0.006, 0.01, 0.015, 0.019}) {
        const Motion sound = nine_points(rate_hz);
        const MendedMotion mended = without_wild_samples(off_by(off_m, count, sound));
        ASSERT_EQ(mended.wild.size(), count) << off_m << " m at " << rate_hz << " Hz";
        EXPECT_EQ(mended.wild[0].point, "p4");
        EXPECT_EQ(mended.wild[0].sample, 20u);
        EXPECT_NEAR(mended.wild[0].off_m, off_m, 3e-4);
        EXPECT_TRUE(mended.jumps.empty());
        EXPECT_LT(farthest_mm(mended.motion, sound), 0.3);
      }
}

TEST(BriefStays, OfEightReadingsAreInterpolatedAtSixtyHertz) {
  const Motion sound = nine_points(60);
  const MendedMotion mended = without_wild_samples(off_by(0.01, 8, sound));
  EXPECT_EQ(mended.wild.size(), 8u);
  EXPECT_LT(farthest_mm(mended.motion, sound), 0.3);
}

TEST(BriefStays, ThatAreLongerAreNamedOnTheWayThereAndBack) {
  const Motion motion = off_by(0.01, 8, nine_points());
  const MendedMotion kept = without_wild_samples(motion);
  EXPECT_TRUE(kept.wild.empty());
  EXPECT_EQ(farthest_mm(kept.motion, motion), 0);
  ASSERT_EQ(kept.jumps.size(), 2u);
  EXPECT_EQ(kept.jumps[0].point, "p4");
  EXPECT_EQ(kept.jumps[0].sample, 20u);
  EXPECT_EQ(kept.jumps[1].sample, 28u);
  EXPECT_NEAR(kept.jumps[0].off_m, 0.01, 5e-4);
  expect_kept(off_by(0.01, 9, nine_points()), "0.33 s");
}

TEST(BriefStays, MayBeFarAndAreNamedOnce) {
  const MendedMotion far = without_wild_samples(off_by(0.05, 8, nine_points()));
  EXPECT_EQ(far.jumps.size(), 2u);
  EXPECT_EQ(without_wild_samples(off_by(0.05, 5, nine_points())).wild.size(), 5u);
}

TEST(BriefStays, EndWhereThePointComesFrom) {
  expect_kept(off_by(0.0045, 3, nine_points()), "less than 5 mm");
  expect_kept(off_by(0.01, 40, nine_points()), "it never comes back");
  Motion farther = off_by(0.01, 3, nine_points());
  for (std::size_t k = 23; k < farther.positions.size(); ++k)
    farther.positions[k](kMiddle, 2) -= 0.008;
  expect_kept(farther, "18 mm back");
  Motion there = off_by(0.008, 4, nine_points());
  there.positions[21](kMiddle, 0) += 0.004;
  expect_kept(there, "it moves there");
  Motion nears = off_by(0.006, 3, nine_points());
  nears.positions[19](kMiddle, 2) += 0.003;
  expect_kept(nears, "it is on its way");
}

TEST(BriefStays, OfNeighboursTooAreMovements) {
  Motion motion = off_by(0.01, 3, nine_points());
  for (std::size_t k = 20; k < 23; ++k) motion.positions[k](kMiddle + 1, 2) += 0.004;
  expect_kept(motion, "the point beside it moves as well");
  Motion back = off_by(0.01, 3, nine_points());
  for (std::size_t k = 23; k < 30; ++k) back.positions[k](kMiddle + 1, 2) += 0.004;
  expect_kept(back, "on the way back");
}

TEST(BriefStays, OfPointsThatAlwaysShakeAreNothing) {
  Motion motion = off_by(0.006, 3, nine_points());
  for (std::size_t k = 0; k < motion.positions.size(); k += 2)
    if (k < 18 || k > 25) motion.positions[k](kMiddle, 2) += 0.0015;
  expect_kept(motion, "eight times the usual");
}

TEST(BriefStays, OfLidsAreBlinks) {
  for (const char* lid : {"ibug68_37", "left_upper_lid", "Leye_Up"})
    expect_kept(off_by(0.01, 3, nine_points(30, lid)), lid);
  for (const char* other : {"ibug68_36", "Leyebrow_M"})
    EXPECT_EQ(without_wild_samples(off_by(0.01, 3, nine_points(30, other))).wild.size(), 3u)
        << other;
}

TEST(BriefStays, OfSlowRecordingsMayBeReal) {
  expect_kept(off_by(0.01, 2, nine_points(20)), "20 Hz");
  Motion gap = off_by(0.01, 2, nine_points());
  for (std::size_t k = 20; k < gap.time_s.size(); ++k) gap.time_s[k] += 0.05;
  expect_kept(gap, "after a pause");
}

/// Two points are exchanged in some samples.
Motion exchanged(Eigen::Index a, Eigen::Index b, std::size_t count) {
  Motion motion = nine_points();
  for (std::size_t k = 20; k < 20 + count; ++k) {
    const Eigen::RowVector3d was = motion.positions[k].row(a);
    motion.positions[k].row(a) = motion.positions[k].row(b).eval();
    motion.positions[k].row(b) = was;
  }
  return motion;
}

TEST(BriefStays, ExchangedNeighboursAreInterpolatedFromOneSampleOn) {
  for (const std::size_t count : {1, 2, 5}) {
    const MendedMotion mended = without_wild_samples(exchanged(kMiddle, 5, count));
    ASSERT_EQ(mended.wild.size(), 2 * count);
    EXPECT_EQ(mended.wild[0].point, "p4");
    EXPECT_EQ(mended.wild[1].point, "p5");
    EXPECT_EQ(mended.wild[1].sample, 20u);
    EXPECT_NEAR(mended.wild[0].off_m, 0.01, 3e-4);
    EXPECT_LT(farthest_mm(mended.motion, nine_points()), 0.3);
  }
  EXPECT_EQ(without_wild_samples(exchanged(kMiddle, 5, 8)).jumps.size(), 4u);
}

/// The whole of a recording, and every second sample as if it were twice as fast.
void expect_no_stays(const Motion& motion) {
  for (const std::size_t nth : {1, 2}) {
    Motion thinned = motion;
    thinned.time_s.clear();
    thinned.positions.clear();
    thinned.lines.clear();
    for (std::size_t k = 0; k < motion.positions.size(); k += nth) {
      thinned.time_s.push_back(motion.time_s[k] / double(nth));
      thinned.positions.push_back(motion.positions[k]);
    }
    const MendedMotion mended = without_wild_samples(thinned);
    EXPECT_TRUE(mended.wild.empty()) << motion.source << ", each sample of " << nth;
    EXPECT_TRUE(mended.jumps.empty()) << motion.source << ", each sample of " << nth;
  }
}

TEST(BriefStays, AreNotInRecordingsOfFaces) {
  const std::vector<Motion> recordings = testing::recordings_of_faces();
  if (recordings.empty()) GTEST_SKIP() << "the shared recordings are not here";
  for (const Motion& recording : recordings) expect_no_stays(recording);
}

}  // namespace
}  // namespace hyperex::motion
