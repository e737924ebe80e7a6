// SPDX-License-Identifier: GPL-3.0-or-later
#include "request_queue.hpp"

#include <gtest/gtest.h>

namespace hyperex::studio {
namespace {

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
  EXPECT_EQ(queue.pop(false, superseded)->id, 4);
  EXPECT_EQ(superseded.size(), 3U);
  superseded.clear();
  EXPECT_EQ(queue.pop(false, superseded)->id, 6)
      << "what is let go makes what was dragged needless";
  ASSERT_EQ(superseded.size(), 1U);
  EXPECT_EQ(superseded[0].id, 5);
  superseded.clear();
  EXPECT_EQ(queue.pop(false, superseded)->id, 7) << "what is let go itself stays";
  EXPECT_TRUE(superseded.empty());
  EXPECT_FALSE(queue.pop(false, superseded));
}

TEST(RequestQueue, TakesNoMoreThanItHolds) {
  RequestQueue queue;
  for (std::size_t i = 0; i < RequestQueue::kMost; ++i) EXPECT_TRUE(queue.push({1, "undo", {}}));
  EXPECT_FALSE(queue.push({1, "undo", {}}));
  queue.close();
  std::vector<Request> superseded;
  EXPECT_FALSE(queue.pop(true, superseded));
}

}  // namespace
}  // namespace hyperex::studio
