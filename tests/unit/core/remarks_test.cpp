// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/remarks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace hyperex {
namespace {

TEST(Remarks, AreHeardByTheListenerAlone) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  remark(Remark::warning, "nobody listens");
  std::vector<std::string> heard;
  listen_to_remarks([&](Remark kind, const std::string& sentence) {
    heard.push_back((kind == Remark::warning ? "warning: " : "note: ") + sentence);
  });
  remark(Remark::warning, "a texture is missing");
  remark(Remark::note, "a folder was removed");
  listen_to_remarks({});
  remark(Remark::note, "nobody listens any more");
  EXPECT_THAT(heard,
              testing::ElementsAre("warning: a texture is missing", "note: a folder was removed"));
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

// A listener in Python, for example, waits for the interpreter's lock.
TEST(Remarks, AListenerMayWaitForALockThatARemarkingThreadHolds) {
  std::mutex interpreter;
  std::atomic<int> heard = 0;
  std::promise<void> listening;
  listen_to_remarks([&](Remark, const std::string& sentence) {
    if (sentence == "waits") {
      listening.set_value();
      const std::lock_guard lock(interpreter);
    }
    ++heard;
  });
  std::thread waits;
  {
    const std::lock_guard lock(interpreter);
    waits = std::thread([] { remark(Remark::note, "waits"); });
    listening.get_future().wait();
    auto other = std::async(std::launch::async, [] { remark(Remark::note, "holds the lock"); });
    EXPECT_EQ(other.wait_for(std::chrono::seconds(10)), std::future_status::ready);
  }
  waits.join();
  listen_to_remarks({});
  EXPECT_EQ(heard, 2);
}

}  // namespace
}  // namespace hyperex
