// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "hyperex/session/remarks_json.hpp"

namespace hyperex::session {
namespace {

using nlohmann::json;

TEST(Remarks, AreValuesWithAnId) {
  const std::vector<Note> notes = {
      {"contact.none", Severity::note, "nothing touches", "contact.lips"},
      {"variant.no_effect", Severity::warning, "nothing changes", "muscles.gain", "weak"}};
  EXPECT_EQ(json(remarks_json(notes)), json({{{"id", "contact.none"},
                                              {"severity", "note"},
                                              {"text", "nothing touches"},
                                              {"key", "contact.lips"}},
                                             {{"id", "variant.no_effect"},
                                              {"severity", "warning"},
                                              {"text", "nothing changes"},
                                              {"key", "muscles.gain"},
                                              {"variant", "weak"}}}));
  EXPECT_EQ(json(remarks_json({})), json::array());
}

}  // namespace
}  // namespace hyperex::session
