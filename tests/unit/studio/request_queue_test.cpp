// SPDX-License-Identifier: GPL-3.0-or-later
#include "request_queue.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace hyperex::studio {
namespace {

constexpr std::chrono::milliseconds kNow{0};

Request set(std::int64_t id, int face, bool live) {
  return {id,
          "set",
          {{"changes", nlohmann::json::object()}, {"face", face}, {"live", live}, {"time_s", 0}}};
}

TEST(RequestQueue, OfLiveChangesOfOneFaceTheLastCounts) {
  RequestQueue queue;
  for (int id = 1; id <= 4; ++id) queue.push(set(id, 1, true));
  queue.push(set(5, 2, true));
  queue.push(set(6, 2, false));
  queue.push(set(7, 2, true));
  std::vector<Request> superseded;
  EXPECT_EQ(queue.pop(kNow, superseded)->id, 4);
  EXPECT_EQ(superseded.size(), 3U);
  superseded.clear();
  EXPECT_EQ(queue.pop(kNow, superseded)->id, 6) << "what is let go makes what was dragged needless";
  ASSERT_EQ(superseded.size(), 1U);
  EXPECT_EQ(superseded[0].id, 5);
  superseded.clear();
  EXPECT_EQ(queue.pop(kNow, superseded)->id, 7) << "what is let go itself stays";
  EXPECT_TRUE(superseded.empty());
  EXPECT_FALSE(queue.pop(kNow, superseded));
}

TEST(RequestQueue, OfConsecutiveSlicesTheLastCounts) {
  RequestQueue queue;
  for (int id = 1; id <= 3; ++id) queue.push({id, "ct_slice", {{"axis", 1}, {"share", 0.1 * id}}});
  queue.push(set(4, 1, true));
  std::vector<Request> superseded;
  EXPECT_EQ(queue.pop(kNow, superseded)->id, 3);
  EXPECT_EQ(superseded.size(), 2U);
  superseded.clear();
  EXPECT_EQ(queue.pop(kNow, superseded)->id, 4);
  EXPECT_TRUE(superseded.empty());
}

TEST(RequestQueue, WaitsForWhatComesInTime) {
  RequestQueue queue;
  std::vector<Request> superseded;
  EXPECT_FALSE(queue.pop(std::chrono::milliseconds(1), superseded));
  std::thread late([&] { queue.push(set(1, 1, true)); });
  const auto came = queue.pop(std::chrono::minutes(1), superseded);
  late.join();
  ASSERT_TRUE(came);
  EXPECT_TRUE(is_live(*came));
  EXPECT_FALSE(is_live(set(2, 1, false)));
}

TEST(RequestQueue, TakesNoMoreThanItHolds) {
  RequestQueue queue;
  for (std::size_t i = 0; i < RequestQueue::kMost; ++i) EXPECT_TRUE(queue.push({1, "undo", {}}));
  EXPECT_FALSE(queue.push({1, "undo", {}}));
  queue.close();
  std::vector<Request> superseded;
  EXPECT_FALSE(queue.pop(RequestQueue::kForever, superseded));
}

}  // namespace
}  // namespace hyperex::studio
