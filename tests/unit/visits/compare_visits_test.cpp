// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/visits/compare_visits.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "hyperex/metrics/symmetry.hpp"
#include "hyperex/visits/summary.hpp"
#include "smiling_face.hpp"

namespace hyperex::visits {
namespace {
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

const MeasureOverVisits& named(const Comparison& comparison, const std::string& key,
                               const std::string& side) {
  for (const MeasureOverVisits& one : comparison.measures)
    if (one.measure.key == key && one.measure.side == side) return one;
  throw std::invalid_argument(key);
}

/// Visits of exact points; jitter is stated as 0 unless it is left unknown.
Comparison of_smiles(const std::vector<std::vector<Smile>>& visits,
                     std::optional<double> jitter_m = 0.0, double repetition_m = 1.5e-3) {
  VisitsFile file = visits_of(visits.size());
  file.repetition_m = repetition_m;
  std::vector<std::vector<MeasuredFace>> faces;
  for (const auto& smiles : visits) {
    std::vector<MeasuredFace> visit;
    for (const Smile& smile : smiles) {
      const MeasuredFace* first = !faces.empty()   ? &faces.front().front()
                                  : !visit.empty() ? &visit.front()
                                                   : nullptr;
      visit.push_back(measure(recording_of(smile), file, jitter_m, first));
    }
    faces.push_back(std::move(visit));
  }
  return compare(file, std::move(faces));
}

/// The error that a repetition of 1.5 mm means for a change of one corner's excursion.
TEST(CompareVisits, RepetitionIsTheIntervalOfAnExcursion) {
  const Comparison two = of_smiles({{Smile{}}, {Smile{.right = 0.6}}});
  const Change& right = *named(two, "corner_excursion", "R").changes.back();
  EXPECT_NEAR(right.value, -0.4e3 * kWholeSmile.norm(), 0.05);
  // Exact points leave the head's pose, which is small here, and repetition.
  EXPECT_NEAR(right.all->high - right.value, 1.5, 0.3);
  EXPECT_GE(right.all->high - right.value, 1.5);
  EXPECT_LT(right.measured->high - right.value, 1.0);
  EXPECT_EQ(right.beyond, Beyond::yes);
  EXPECT_EQ(right.largest, "repetition");
  const Change& left = *named(two, "corner_excursion", "L").changes.back();
  EXPECT_NEAR(left.value, 0, 0.02);
  EXPECT_EQ(left.beyond, Beyond::no);
  // Two corners of independent errors.
  const Change& difference = *named(two, "corner_difference", "").changes.back();
  EXPECT_NEAR(difference.all->high - difference.value, std::sqrt(2.0) * 1.5, 0.5);
}

TEST(CompareVisits, TheStretchIsThatOfTheSymmetryCurve) {
  const Smile uneven{.right = 0.6};
  const Comparison one = of_smiles({{uneven}});
  const metrics::SymmetryCurve curve = metrics::symmetry_of(recording_of(uneven));
  double farthest = 0;
  for (std::size_t k = 0; k < curve.time_s.size(); ++k)
    farthest = std::max(farthest, curve.xi_right[k] - curve.xi_left[k]);
  ASSERT_GT(farthest, 0.05);
  EXPECT_NEAR(named(one, "stretch_difference", "").values[0]->value, 100 * farthest, 0.2);
}

TEST(CompareVisits, WithoutRepetitionMeasurementAloneDecides) {
  const Comparison two = of_smiles({{Smile{}}, {Smile{.right = 0.6}}}, 0.0, 0);
  const Change& right = *named(two, "corner_excursion", "R").changes.back();
  EXPECT_DOUBLE_EQ(right.all->low, right.measured->low);
  EXPECT_NE(right.largest, "repetition");
}

TEST(CompareVisits, UnknownJitterCannotTellOfALargeChange) {
  const Comparison two = of_smiles({{Smile{}}, {Smile{.right = 0.6}}}, std::nullopt);
  const Change& right = *named(two, "corner_excursion", "R").changes.back();
  EXPECT_EQ(right.beyond, Beyond::cannot_tell);
  EXPECT_FALSE(right.measured);
  EXPECT_FALSE(right.all) << "it would be that of repetition alone";
  EXPECT_EQ(named(two, "corner_excursion", "L").changes.back()->beyond, Beyond::no);
  const std::vector<std::string> sentences = summary(two);
  EXPECT_THAT(sentences[0], AllOf(HasSubstr("cannot be told"), Not(HasSubstr("95 %"))));
  EXPECT_THAT(sentences[1],
              AllOf(HasSubstr("within what repetition alone makes"), Not(HasSubstr("95 %"))));
}

TEST(CompareVisits, AChangeBeyondRepetitionIsNotWithinRepetitionAlone) {
  Estimate first, second;
  for (Estimate* one : {&first, &second}) {
    one->errors.add(metrics::ErrorPart::repetition, 0.5);
    one->errors.add(metrics::ErrorPart::head_pose, 1.5);
  }
  const auto changed_by = [&](double change) {
    second.value = change;
    return *over_visits(measure_named("corner_excursion", "R"), {first, second}).changes.back();
  };
  EXPECT_TRUE(changed_by(1.9).within_repetition) << "1.96 mm by repetition alone";
  EXPECT_FALSE(changed_by(-2.1).within_repetition);
  EXPECT_EQ(changed_by(-2.1).beyond, Beyond::no) << "3.92 mm by both";

  Comparison two = of_smiles({{Smile{}}, {Smile{.right = 0.6}}});
  two.measures = {named(two, "corner_excursion", "R")};
  Change& change = *two.measures[0].changes.back();
  change = {.value = 2, .beyond = Beyond::no, .largest = "repetition"};
  EXPECT_THAT(summary(two)[0], AllOf(HasSubstr("2.0 mm more, within what repetition and the known "
                                               "errors of measurement make"),
                                     Not(HasSubstr("alone"))));
  change.within_repetition = true;
  EXPECT_THAT(summary(two)[0], HasSubstr("2.0 mm more, within what repetition alone makes"));
}

TEST(CompareVisits, AnIntervalAroundNoChangeHasAWordAtBothBounds) {
  Comparison two = of_smiles({{Smile{}}, {Smile{.right = 0.6}}});
  two.measures = {named(two, "corner_excursion", "R")};
  Change& change = *two.measures[0].changes.back();
  change = {.value = -0.1, .all = Interval{-1.8, 1.6}, .beyond = Beyond::no, .largest = ""};
  EXPECT_THAT(summary(two)[0], HasSubstr("0.1 mm less (95 %: 1.8 less to 1.6 more), within"));
  change = {.value = -4.1, .all = Interval{-5.9, -2.3}, .beyond = Beyond::yes, .largest = ""};
  EXPECT_THAT(summary(two)[0], HasSubstr("4.1 mm less (95 %: 2.3 to 5.9), beyond"));
  change = {.value = -0.0484, .all = Interval{-1.0, 0.9}, .beyond = Beyond::no, .largest = ""};
  EXPECT_THAT(summary(two)[0], HasSubstr("no change (95 %: 1.0 mm less to 0.9 mm more), within"));
}

TEST(CompareVisits, FacesOfDifferentScalesAreNotCompared) {
  const VisitsFile file = visits_of(3);
  motion::Motion small = recording_of({});
  small.source = "small.csv";
  for (Points& at : small.positions) at *= 0.1;
  const MeasuredFace first = measure(recording_of({}), file, 0.0, nullptr);
  const MeasuredFace second = measure(recording_of({.right = 0.6}), file, 0.0, &first);
  const MeasuredFace third = measure(small, file, 0.0, &first);
  ASSERT_TRUE(third.other_scale);
  EXPECT_NEAR(*third.other_scale, 0.1, 1e-6);
  EXPECT_FALSE(second.other_scale);
  const Comparison three = compare(file, {{first}, {second}, {third}});
  const MeasureOverVisits& right = named(three, "corner_excursion", "R");
  EXPECT_TRUE(right.values[2]) << "the value stays";
  EXPECT_TRUE(right.changes[1]);
  for (const MeasureOverVisits& one : three.measures)
    EXPECT_FALSE(one.changes[2]) << one.measure.key;
  EXPECT_THAT(summary(three)[0],
              AllOf(HasSubstr("not compared, as the face at rest is 0.1 times as large in "
                              "small.csv as in smile.csv"),
                    Not(HasSubstr("less")), Not(HasSubstr("beyond"))));
  // Its scatter does not count, and neither does a visit of which one recording is small.
  const Comparison mixed = compare(file, {{first}, {second, third}, {second}});
  EXPECT_FALSE(named(mixed, "corner_excursion", "R").changes[1]);
  EXPECT_TRUE(named(mixed, "corner_excursion", "R").changes[2]);
  EXPECT_EQ(named(mixed, "corner_excursion", "R").recorded_repetition, 0);
}

TEST(CompareVisits, TheUnchangedSideDoesNotFollowLess) {
  const Comparison two = of_smiles({{Smile{}}, {Smile{.right = 0.5}}});
  const Change& left = *named(two, "corner_follows", "L").changes.back();
  EXPECT_NEAR(left.value, 0, 0.5);
  EXPECT_EQ(left.beyond, Beyond::no);
  const Change& right = *named(two, "corner_follows", "R").changes.back();
  EXPECT_NEAR(right.value, -50, 0.5);
  EXPECT_EQ(right.beyond, Beyond::yes);
}

TEST(CompareVisits, RemarksBeginWithTheOrderOfTheVisits) {
  Comparison two = of_smiles({{Smile{}}, {Smile{}}});
  two.file.order_remark = "the visits were sorted";
  EXPECT_EQ(remarks(two).front(), "the visits were sorted");
}

TEST(CompareVisits, RecordingsOfAVisitMeasureItsRepetition) {
  const std::vector<double> before{0.9, 1.0, 1.1}, after{0.5, 0.7};
  std::vector<std::vector<Smile>> smiles(2);
  for (const double right : before) smiles[0].push_back({.right = right});
  for (const double right : after) smiles[1].push_back({.right = right});
  const Comparison two = of_smiles(smiles);
  EXPECT_TRUE(two.repetition_measured);
  const MeasureOverVisits& right = named(two, "corner_excursion", "R");
  const double whole_mm = 1e3 * kWholeSmile.norm();
  // Squares about the means: 0.02 and 0.02 of the whole smile, with 3 degrees of freedom.
  const double deviation = whole_mm * std::sqrt((0.02 + 0.02) / 3);
  EXPECT_NEAR(right.recorded_repetition, deviation, 0.01 * deviation);
  EXPECT_NEAR(right.changes.back()->value, -0.4 * whole_mm, 0.05);
  constexpr double t_of_3 = 3.182446;
  EXPECT_NEAR(right.changes.back()->all->high - right.changes.back()->value,
              t_of_3 * deviation * std::sqrt(1.0 / 3 + 1.0 / 2), 0.02 * whole_mm);
  EXPECT_THAT(repetition_sentence(two), HasSubstr("measured"));
}

/// The points of a recording without those of these names.
motion::Motion without_points(motion::Motion m, const std::vector<std::string>& names) {
  for (const std::string& name : names) m.names[std::size_t(m.index_of(name))] = "other_" + name;
  return m;
}

TEST(CompareVisits, ASideThatIsNotRecordedIsNamed) {
  const VisitsFile file = visits_of(2);
  const motion::Motion whole = recording_of({}), half = without_points(whole, {"ibug68_48"});
  const MeasuredFace both = measure(whole, file, 0.0, nullptr),
                     left = measure(half, file, 0.0, nullptr),
                     left_later = measure(half, file, 0.0, &both);
  EXPECT_EQ(summary(compare(file, {{both}, {left_later}}))[0],
            "Right corner of the mouth: 11.5 mm (day 1), not recorded (day 2): not compared.");
  const std::vector<std::string> never = summary(compare(file, {{left}, {left}}));
  EXPECT_EQ(never[0], "Right corner of the mouth: not recorded at any visit.");
  EXPECT_THAT(never[1], testing::StartsWith("Left corner of the mouth: 11."));
  EXPECT_EQ(summary(compare(visits_of(1), {{left}}))[0],
            "Right corner of the mouth: not recorded.");
}

/// The smile of `excursion_mm`, each measure of its right corner from a first to a last value.
Comparison of_right_corner(double change_mm,
                           const std::map<std::string, std::pair<double, double>>& parts) {
  Comparison two = of_smiles({{Smile{}}, {Smile{}}});
  for (MeasureOverVisits& one : two.measures) {
    if (one.measure.side != "R") continue;
    if (one.measure.key == "corner_excursion") {
      one.values[1]->value = one.values[0]->value + change_mm;
      one.changes[1] = Change{.value = change_mm,
                              .all = Interval{change_mm - 2, change_mm + 2},
                              .beyond = std::abs(change_mm) > 2 ? Beyond::yes : Beyond::no,
                              .largest = ""};
    }
    if (const auto part = parts.find(one.measure.key); part != parts.end()) {
      const auto [first, last] = part->second;
      one.values[0]->value = first;
      one.values[1]->value = last;
      const double half = one.measure.unit == "mm" ? 2 : 15;
      one.changes[1] = Change{.value = last - first,
                              .all = Interval{last - first - half, last - first + half},
                              .beyond = std::abs(last - first) > half ? Beyond::yes : Beyond::no,
                              .largest = ""};
    }
  }
  return two;
}

TEST(CompareVisits, AChangeOfDirectionStandsInTheSentence) {
  const auto right = [](double change_mm,
                        const std::map<std::string, std::pair<double, double>>& parts) {
    return summary(of_right_corner(change_mm, parts))[0];
  };
  EXPECT_THAT(right(-0.3, {{"corner_up", {3.9, -3.9}}, {"smile_angle", {40, -129}}}),
              HasSubstr("within what measurement and repetition make, but its direction has "
                        "changed (upward 3.9 to -3.9 mm)."));
  EXPECT_THAT(right(-4, {{"corner_outward", {5, -1}}, {"corner_forward", {-6, 9}}}),
              HasSubstr("make, and its direction has changed (outward 5.0 to -1.0 mm, forward "
                        "-6.0 to 9.0 mm)."));
  EXPECT_THAT(right(-0.3, {{"smile_angle", {40, 70}}}),
              HasSubstr("but its direction has changed (angle 40 to 70 degrees)."));
  for (const std::pair<double, double>& angles :
       {std::pair{40.0, 50.0}, {-175.0, 178.0}, {170.0, -178.0}})
    EXPECT_THAT(right(-0.3, {{"smile_angle", angles}}), Not(HasSubstr("direction")));
  EXPECT_THAT(right(-0.3, {{"smile_angle", {-100.0, 160.0}}}), HasSubstr("direction"));
  EXPECT_THAT(right(-0.3, {{"corner_up", {0.9, -0.9}}}), Not(HasSubstr("direction")));
  EXPECT_THAT(right(-0.3, {{"corner_up", {9.0, 5.0}}}), Not(HasSubstr("direction")));
  EXPECT_THAT(right(-10.5, {{"corner_up", {9.0, -0.9}}}), Not(HasSubstr("direction")))
      << "1 mm has none";
}

TEST(CompareVisits, TheLargestChangeThatIsBeyondComesFirst) {
  const auto first_words = [](double right, double left) {
    const auto sentences = summary(of_smiles({{Smile{}}, {Smile{.right = right, .left = left}}}));
    return sentences[0].substr(0, 5) + sentences[1].substr(0, 5);
  };
  EXPECT_EQ(first_words(1, 0.6), "Left Right");
  EXPECT_EQ(first_words(0.6, 1), "RightLeft ");
  EXPECT_EQ(first_words(0.7, 0.4), "Left Right");
  EXPECT_EQ(first_words(0.4, 0.7), "RightLeft ");
  EXPECT_EQ(first_words(1, 0.95), "RightLeft ") << "within what repetition makes";
}

TEST(CompareVisits, ADoubtStandsBesideTheComparison) {
  Comparison two = of_smiles({{Smile{}}, {Smile{.right = 0.6}}});
  EXPECT_THAT(summary(two), testing::Each(Not(HasSubstr("oubtful"))));
  for (const std::size_t visit : {0u, 1u}) {
    Comparison doubted = two;
    doubted.faces[visit][0].doubts = {"it may be another person"};
    const std::vector<std::string> sentences = summary(doubted);
    for (const std::size_t side : {0u, 1u})
      EXPECT_THAT(sentences[side],
                  HasSubstr(" what measurement and repetition make; doubtful, as said below."));
    EXPECT_EQ(sentences[2], "Doubtful: it may be another person.");
    EXPECT_EQ(sentences.size(), 4u);
    EXPECT_THAT(remarks(doubted), testing::IsEmpty());
  }
  Comparison three = of_smiles({{Smile{}}, {Smile{}}, {Smile{.right = 0.6}}});
  three.faces[1][0].doubts = {"it may be another person"};
  EXPECT_THAT(summary(three), testing::Each(Not(HasSubstr("oubtful")))) << "not compared there";
  EXPECT_THAT(remarks(three), testing::ElementsAre("it may be another person"));
}

TEST(CompareVisits, SayWhatChangedInSentences) {
  const std::vector<std::string> sentences = summary(of_smiles({{Smile{}}, {Smile{.right = 0.6}}}));
  ASSERT_EQ(sentences.size(), 3u);
  EXPECT_THAT(sentences[0], testing::StartsWith("Right corner of the mouth: 11.5 mm (day 1)"));
  EXPECT_THAT(sentences[0], HasSubstr("4.6 mm less"));
  EXPECT_THAT(sentences[0], HasSubstr("beyond what"));
  EXPECT_THAT(sentences[1], HasSubstr("within what"));
  EXPECT_THAT(summary(of_smiles({{Smile{}}}))[0], HasSubstr("11.5 mm (day 1)."));
  EXPECT_THAT(sentences.back(), HasSubstr("Healthy adults move the corner of the mouth by 9.3 mm"));
  Comparison dated = of_smiles({{Smile{}}});
  dated.file.visits[0].label = "2026-03-01";
  EXPECT_THAT(summary(dated)[0], HasSubstr("11.5 mm on 2026-03-01."));
  Comparison pucker = of_smiles({{Smile{}}});
  pucker.file.expression = *expression_named("pucker");
  EXPECT_EQ(summary(pucker).size(), 2U) << "no norm of a smile";
}

}  // namespace
}  // namespace hyperex::visits
