// SPDX-License-Identifier: GPL-3.0-or-later
// Whether intervals hold the truth as often as they state: smiles with 0.3 mm of noise of a head
// that moves, drawn again and again. HYPEREX_DRAWS sets the number of draws; docs/visits.md shows
// the table of 200.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>

#include "hyperex/core/run_together.hpp"
#include "hyperex/visits/compare_visits.hpp"
#include "smiling_face.hpp"
#include "support/draws.hpp"

namespace hyperex::visits {
namespace {

constexpr Smile kWhole{}, kWeaker{.right = 0.6};

/// A visit, another with the same smile, and one whose right side is weaker.
struct Draw {
  Comparison same, weaker;
};

MeasuredFace drawn(Smile smile, unsigned seed, const MeasuredFace* first) {
  smile.noise_m = 3e-4;
  smile.head_moves = true;
  smile.seed = seed;
  return measure(recording_of(smile), visits_of(2), std::nullopt, first);
}

const std::vector<Draw>& draws() {
  static const std::vector<Draw> all = [] {
    std::vector<Draw> made(std::size_t(hyperex::test::draws()));
    run_each(made.size(), [&](std::size_t i) {
      const auto seed = 3 * unsigned(i);
      const MeasuredFace first = drawn(kWhole, seed, nullptr);
      const VisitsFile file = visits_of(2);
      made[i].same = compare(file, {{first}, {drawn(kWhole, seed + 1, &first)}});
      made[i].weaker = compare(file, {{first}, {drawn(kWeaker, seed + 2, &first)}});
    });
    return made;
  }();
  return all;
}

std::string name_of(const MeasureOverVisits& one) {
  return one.measure.key + (one.measure.side.empty() ? "" : "_" + one.measure.side);
}

/// The change of each measure without noise and head motion.
std::map<std::string, double> true_changes() {
  const VisitsFile file = visits_of(2);
  const MeasuredFace first = measure(recording_of(kWhole), file, 0.0, nullptr);
  const MeasuredFace second = measure(recording_of(kWeaker), file, 0.0, &first);
  std::map<std::string, double> out;
  for (const MeasureOverVisits& one : compare(file, {{first}, {second}}).measures)
    out[name_of(one)] = one.changes.back()->value;
  return out;
}

struct Held {
  int count = 0;
  double half_width = 0;  ///< mean
};

void expect_intervals_hold_the_truth() {
  const auto truth = true_changes();
  const double all = double(draws().size());
  std::map<std::string, Held> held;
  for (const Draw& draw : draws())
    for (const MeasureOverVisits& one : draw.weaker.measures) {
      const Interval interval = one.changes.back()->measured.value();
      Held& of = held[name_of(one)];
      of.count += interval.low <= truth.at(name_of(one)) && truth.at(name_of(one)) <= interval.high;
      of.half_width += (interval.high - interval.low) / 2 / all;
    }
  ASSERT_GE(held.size(), 20u);
  const double least = all >= 100 ? 0.9 : 0.8;  // few draws scatter
  double sum = 0;
  for (const auto& [name, of] : held) {
    std::printf("| `%s` | %.2f | %.2f | %.1f %% |\n", name.c_str(), truth.at(name), of.half_width,
                100 * of.count / all);
    EXPECT_GE(of.count, least * all) << name;
    sum += of.count;
  }
  EXPECT_GE(sum, 0.93 * all * double(held.size()));
  EXPECT_LT(sum, all * double(held.size())) << "intervals that are never wrong are too wide";
}

void expect_no_change_of_the_same_smile() {
  int beyond = 0, all = 0;
  for (const Draw& draw : draws())
    for (const MeasureOverVisits& one : draw.same.measures) {
      beyond += one.changes.back()->beyond != Beyond::no;
      ++all;
    }
  std::printf("the same smile: %d of %d changes beyond\n", beyond, all);
  EXPECT_LE(beyond, 0.05 * all);
}

void expect_the_weaker_side_alone() {
  const double change_mm = -0.4e3 * kWholeSmile.norm(), all = double(draws().size());
  int found = 0, other = 0;
  double mean = 0;
  for (const Draw& draw : draws())
    for (const MeasureOverVisits& one : draw.weaker.measures) {
      if (one.measure.key != "corner_excursion") continue;
      const Change& change = *one.changes.back();
      (one.measure.side == "R" ? found : other) += change.beyond == Beyond::yes;
      if (one.measure.side == "R") mean += change.value / all;
    }
  std::printf("right corner: %d of %.0f found, mean change %.2f mm of %.2f; left: %d\n", found, all,
              mean, change_mm, other);
  EXPECT_GE(found, 0.95 * all);
  EXPECT_LE(other, 0.05 * all);
  EXPECT_NEAR(mean, change_mm, 0.1 * std::abs(change_mm));
}

// One test, as the draws take most of the time.
TEST(CoverageOfVisits, IntervalsHoldTheTruthAndOnlyChangesAreFound) {
  expect_intervals_hold_the_truth();
  expect_no_change_of_the_same_smile();
  expect_the_weaker_side_alone();
}

}  // namespace
}  // namespace hyperex::visits
