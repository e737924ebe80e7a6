// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/remarks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace hyperex
