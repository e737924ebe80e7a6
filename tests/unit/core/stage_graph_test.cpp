// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/stage_graph.hpp"

#include <gtest/gtest.h>

namespace hyperex {
namespace {

/// Two numbers, their sum, a number found on the way, the stages that depend on it, and a memory
/// that is refilled.
struct Sums : StageGraph {
  Source a{*this, "a"}, b{*this, "b"};
  Cached<int> sum{*this, "sum", {a, b}};
  Checked<int> parity{*this, "parity", {sum}};
  Cached<int> rests{*this, "rests", {parity}};
  Owned<int> memory{*this, "memory", {a, {b, OnChange::refill}}};
  Owned<int> reads_memory{*this, "reads memory", {memory}};
  Cached<int> load{*this, "load", {a, {b, OnChange::drop_unless_held}}};
  Cached<int> reads_load{*this, "reads load", {load}};

  int a_now = 2, b_now = 3;
  void ensure_all() {
    const auto number = [](int n) { return std::make_shared<const int>(n); };
    sum.ensure([&] { return number(a_now + b_now); });
    parity.set(sum.value() % 2);
    rests.ensure([&] { return number(10 * parity.value()); });
    memory.ensure([&] { return a_now * b_now; }, [&](int& m) { m = a_now * b_now; });
    reads_memory.ensure([&] { return memory.value() + 1; });
    load.ensure([&] { return number(a_now - b_now); });
    reads_load.ensure([&] { return number(-load.value()); });
  }
  std::vector<int> counts() const {
    std::vector<int> out;
    for (const Stage* stage : stages()) out.push_back(stage->computed());
    return out;
  }
};
//                                  a  b sum par rests mem reads load reads
using Counts = std::vector<int>;

TEST(StageGraph, ComputesWhatIsRequiredOnce) {
  Sums s;
  s.ensure_all();
  s.ensure_all();
  EXPECT_EQ(s.counts(), (Counts{0, 0, 1, 0, 1, 1, 1, 1, 1}));
  EXPECT_EQ(s.sum.value(), 5);
  EXPECT_EQ(s.reads_memory.value(), 7);
}

TEST(StageGraph, DropsWhatNamesAnInputThatChanges) {
  Sums s;
  s.ensure_all();
  s.a_now = 7;
  s.a.change();
  for (const bool has : {s.sum.has_value(), s.memory.has_value(), s.reads_memory.has_value(),
                         s.load.has_value(), s.reads_load.has_value()})
    EXPECT_FALSE(has);
  s.ensure_all();
  EXPECT_EQ(s.sum.value(), 10);
  EXPECT_EQ(s.reads_memory.value(), 22);
  EXPECT_EQ(s.reads_load.value(), -4);
}

TEST(StageGraph, ACheckedValueStopsAChangeThatLeavesItEqual) {
  Sums s;
  s.ensure_all();
  s.a_now = 4;  // the sum stays odd
  s.a.change();
  s.ensure_all();
  EXPECT_EQ(s.counts(), (Counts{0, 0, 2, 0, 1, 2, 2, 2, 2}));
  s.a_now = 5;
  s.a.change();
  s.ensure_all();
  EXPECT_EQ(s.counts(), (Counts{0, 0, 3, 0, 2, 3, 3, 3, 3}));
  EXPECT_EQ(s.rests.value(), 0);
}

TEST(StageGraph, ARefilledStageKeepsItsMemoryAndDropsWhatRestsOnIt) {
  Sums s;
  s.ensure_all();
  const int* place = &s.memory.value();
  s.b_now = 5;
  s.b.change();
  EXPECT_TRUE(s.memory.has_value());
  EXPECT_FALSE(s.memory.is_up_to_date());
  EXPECT_FALSE(s.reads_memory.has_value());
  s.ensure_all();
  EXPECT_EQ(&s.memory.value(), place);
  EXPECT_EQ(s.reads_memory.value(), 11);
}

TEST(StageGraph, ARefillThatFailsIsTriedAgain) {
  Sums s;
  s.ensure_all();
  s.b.change();
  const auto fails = [](int&) { throw std::runtime_error("no"); };
  EXPECT_THROW(s.memory.ensure([] { return 0; }, fails), std::runtime_error);
  EXPECT_FALSE(s.memory.is_up_to_date());
  s.b_now = 8;
  s.ensure_all();
  EXPECT_EQ(s.memory.value(), 16);
}

TEST(StageGraph, AHeldStageOutlivesTheInputsThatMayNotChangeIt) {
  Sums s;
  s.ensure_all();
  s.load.hold();
  s.b_now = 9;
  s.b.change();
  s.ensure_all();
  EXPECT_EQ(s.load.value(), -1);
  EXPECT_EQ(s.reads_load.computed(), 1);
  s.a.change();
  EXPECT_FALSE(s.load.has_value()) << "others still do";
}

TEST(StageGraph, CopiesShareWhatDoesNotChange) {
  Sums s;
  s.ensure_all();
  s.load.hold();
  Sums copy;
  copy.share(s);
  EXPECT_EQ(copy.sum.pointer(), s.sum.pointer());
  EXPECT_EQ(copy.parity.value(), 1);
  EXPECT_TRUE(copy.load.held());
  EXPECT_FALSE(copy.memory.has_value());
  s.a.change();
  EXPECT_TRUE(copy.sum.has_value());
}

TEST(StageGraph, AMemoryIsTakenToBeRefilled) {
  Sums s, other;
  s.ensure_all();
  other.b_now = 11;
  other.memory.take(s.memory);
  EXPECT_FALSE(s.memory.has_value());
  EXPECT_FALSE(s.reads_memory.has_value());
  bool made = false;
  int before = 0;
  other.memory.ensure([&] { return made = true, 0; }, [&](int& m) { before = m, m = 22; });
  EXPECT_EQ(before, 6);
  EXPECT_FALSE(made);
  EXPECT_EQ(other.memory.value(), 22);
}

TEST(StageGraph, AnotherValueDropsWhatRestsOnTheOneBeforeAndMoreOfItDoesNot) {
  Sums s;
  s.ensure_all();
  s.load.complete(std::make_shared<const int>(4));
  EXPECT_TRUE(s.reads_load.has_value());
  s.load.keep(std::make_shared<const int>(5));
  EXPECT_EQ(s.load.value(), 4) << "there is one";
  s.load.replace(std::make_shared<const int>(6));
  EXPECT_FALSE(s.reads_load.has_value());
  EXPECT_EQ(s.load.value(), 6);
}

TEST(StageGraph, NamesItsInputs) {
  const Sums s;
  EXPECT_EQ(s.sum.inputs_in_words(), "a, b");
  EXPECT_EQ(s.memory.inputs_in_words(), "a; refilled after b");
  EXPECT_EQ(s.load.inputs_in_words(), "a; unless held b");
  EXPECT_EQ(s.a.inputs_in_words(), "");
}

TEST(StageGraphDeathTest, AStageReadsOnlyWhatItNames) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  Sums s;
  s.ensure_all();
  s.b.change();
  s.load.replace(std::make_shared<const int>(1));
  EXPECT_DEATH(s.sum.ensure([&] { return std::make_shared<const int>(s.load.value()); }),
               "\"sum\" names its input \"load\"");
}

}  // namespace
}  // namespace hyperex
