// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/run_together.hpp"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

#include "support/refusal.hpp"

namespace hyperex {
namespace {

std::string thrown_by(const std::function<void()>& first, const std::function<void()>& second) {
  return test::refusal<std::exception>([&] { run_together({first, second}); });
}

TEST(RunTogether, AnExceptionInOneCutsNoLoopOfTheOtherShort) {
  constexpr int steps = 200;
  std::atomic<int> done{0};
  std::atomic<bool> begun{false};
  const auto fails = [&] {
    // Once the other is under way; where there is one thread alone, it never will be.
    for (int tries = 0; tries < 200 && !begun; ++tries)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    throw std::runtime_error("no space left");
  };
  const auto counts = [&] {
    tbb::parallel_for(0, steps, [&](int) {
      begun = true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      ++done;
    });
  };
  EXPECT_EQ(thrown_by(fails, counts), "no space left");
  EXPECT_EQ(done, steps);
  done = 0;
  begun = false;
  EXPECT_EQ(thrown_by(counts, fails), "no space left");
  EXPECT_EQ(done, steps);
}

TEST(RunTogether, TheFirstOnesExceptionIsTold) {
  const auto a = [] { throw std::runtime_error("a"); };
  const auto b = [] { throw std::runtime_error("b"); };
  for (int time = 0; time < 20; ++time) EXPECT_EQ(thrown_by(a, b), "a");
  EXPECT_EQ(thrown_by([] {}, b), "b");
  EXPECT_EQ(thrown_by([] {}, [] {}), "");
}

TEST(RunEach, AnExceptionInOneCutsNoLoopOfAnotherShort) {
  std::atomic<int> begun{0}, whole{0};
  const auto body = [&](std::size_t i) {
    if (i == 0) {
      for (int tries = 0; tries < 200 && begun == 0; ++tries)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      throw std::runtime_error("no memory is left");
    }
    ++begun;
    std::atomic<int> done{0};
    tbb::parallel_for(0, 100, [&](int) {
      std::this_thread::sleep_for(std::chrono::microseconds(200));
      ++done;
    });
    if (done == 100) ++whole;
  };
  EXPECT_THROW(run_each(8, body), std::runtime_error);
  EXPECT_EQ(whole, begun);
}

TEST(RunEach, RunsAllAndThrowsTheFirst) {
  std::vector<int> seen(100, 0);
  run_each(100, [&](std::size_t i) { ++seen[i]; });
  EXPECT_EQ(seen, std::vector<int>(100, 1));
  run_each(0, [](std::size_t) { throw std::runtime_error("never"); });
}

}  // namespace
}  // namespace hyperex
