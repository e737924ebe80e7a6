// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/recorded_sides.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "hyperex/metrics/symmetry_json.hpp"

namespace hyperex::metrics {
namespace {

/// Corners of the mouth and brows that move by `mm` on the right and 5 mm on the left.
motion::Motion both_sides(double mm) {
  motion::Motion motion;
  motion.names = {"cheilion_L", "cheilion_R", "ibug68_54", "ibug68_48", "ibug68_26", "ibug68_17"};
  for (int k = 0; k <= 10; ++k) {
    Points at = Points::Zero(6, 3);
    for (int p = 0; p < 6; ++p)
      at.row(p) << (p % 2 == 0 ? 0.02 : -0.02), 0.01 * (p / 2), 1e-4 * k * (p % 2 == 0 ? 5.0 : mm);
    motion.time_s.push_back(k / 10.0);
    motion.positions.push_back(at);
  }
  return motion;
}

/// Points of these names, far from the face but for the first, `near_m` above the right corner.
motion::Motion recording(const std::vector<std::string>& names, double near_m) {
  motion::Motion recorded;
  recorded.names = names;
  recorded.time_s = {0};
  Points at = Points::Constant(Eigen::Index(names.size()), 3, 1);
  at.row(0) << -0.02, near_m, 0;
  recorded.positions = {at};
  return recorded;
}

SymmetryMeasures measured(const std::vector<std::string>& recorded, double near_m = 1) {
  const motion::Motion motion = both_sides(4);
  SymmetryMeasures all;
  all.curve = symmetry_without_points(motion);
  for (std::size_t k = 0; k < motion.time_s.size(); ++k)
    all.curve.xi_left[k] = all.curve.xi_right[k] = all.curve.s[k] = 0.1;
  all.curve.noise.assign(motion.time_s.size(), 0.01);
  all.excursions = excursions_of(motion);
  withhold_unrecorded(all, motion, recording(recorded, near_m));
  return all;
}

const PairExcursion& named_pair(const SymmetryMeasures& of, const std::string& name) {
  for (const PairExcursion& pair : of.excursions.pairs)
    if (pair.name == name) return pair;
  throw std::logic_error(name);
}

TEST(RecordedSides, OfAWholeRecordingKeepAllFigures) {
  const SymmetryMeasures all = measured({"48", "cheilion_L", "ibug68_17", "ibug68_26"});
  for (const PairExcursion& pair : all.excursions.pairs) {
    EXPECT_TRUE(pair.left_recorded && pair.right_recorded) << pair.name;
    EXPECT_NEAR(pair.difference_mm(), 1, 1e-6) << pair.name;
  }
  EXPECT_TRUE(all.curve.known());
}

TEST(RecordedSides, OneCornerAloneHasAFigureAndNoneComparesTheTwo) {
  const SymmetryMeasures all = measured({"ibug68_54"});
  for (const char* name : {"cheilion", "ibug68_48/54"}) {
    const PairExcursion& pair = named_pair(all, name);
    EXPECT_TRUE(pair.left_recorded);
    EXPECT_FALSE(pair.right_recorded);
    EXPECT_NEAR(pair.left_side.excursion_mm, 5, 1e-6);
    EXPECT_TRUE(std::isnan(pair.right_side.excursion_mm));
    EXPECT_TRUE(std::isnan(pair.right_side.path_mm));
    EXPECT_TRUE(std::isnan(pair.right_side.peak_speed_mm_s));
    EXPECT_TRUE(std::isnan(pair.excursion_ratio));
    EXPECT_EQ(pair.decided(false), std::nullopt);
  }
  // Brows of which neither is recorded are those of the run, and say so.
  EXPECT_FALSE(named_pair(all, "ibug68_17/26").left_recorded);
  EXPECT_NEAR(named_pair(all, "ibug68_17/26").left_side.excursion_mm, 5, 1e-6);
  const Commissure& mouth = all.excursions.commissure;
  EXPECT_NEAR(mouth.left_mm.back(), 5, 1e-6);
  EXPECT_TRUE(std::isnan(mouth.right_mm.back()));
  EXPECT_TRUE(std::isnan(mouth.right_mm_s.back()));
  EXPECT_EQ(all.curve.xi_left.back(), 0.1);
  EXPECT_TRUE(std::isnan(all.curve.xi_right.back()));
  EXPECT_FALSE(all.curve.known());
  const nlohmann::ordered_json json = summary_of(all);
  EXPECT_EQ(json["commissure"]["recorded"]["R"], false);
  EXPECT_TRUE(json["commissure"]["excursion_mm"]["R"].is_null());
  EXPECT_TRUE(json["commissure"]["difference_mm"].is_null());
  EXPECT_TRUE(json["commissure"]["undecided"].is_null());
  EXPECT_EQ(json["verdict"], "not known, as a corner of the mouth is not recorded");
}

TEST(RecordedSides, APointOfAnotherNameShowsThePlaceWhereItLies) {
  EXPECT_TRUE(named_pair(measured({"my mark", "ibug68_54"}, 14e-3), "cheilion").right_recorded);
  EXPECT_FALSE(named_pair(measured({"my mark", "ibug68_54"}, -16e-3), "cheilion").right_recorded);
}

TEST(RecordedSides, WithoutCornersThereAreNoFiguresOfThem) {
  const SymmetryMeasures all = measured({"ibug68_17"});
  EXPECT_TRUE(std::isnan(named_pair(all, "cheilion").left_side.excursion_mm));
  EXPECT_TRUE(std::isnan(named_pair(all, "cheilion").right_side.excursion_mm));
  EXPECT_TRUE(std::isnan(named_pair(all, "ibug68_17/26").left_side.excursion_mm));
  EXPECT_NEAR(named_pair(all, "ibug68_17/26").right_side.excursion_mm, 4, 1e-6);
}

}  // namespace
}  // namespace hyperex::metrics
