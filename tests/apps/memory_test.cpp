// SPDX-License-Identifier: GPL-3.0-or-later
// A run that finds too little memory ends in one line with status 1 and leaves nothing.
#include <cmath>
#include <string>
#include <vector>

#include "apps/malformed.hpp"
#include "support/sanitizers.hpp"

namespace hyperex {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

class TooLittleMemory : public ProgramTest {
 protected:
  void SetUp() override {
#if HYPEREX_SANITIZED
    GTEST_SKIP() << "a sanitizer takes more addresses than any limit leaves, and allocates itself";
#endif
    ProgramTest::SetUp();
    put(in("x.toml"),
        "scan = { file = \"embedded\" }\nmotion = { file = \"embedded\" }\n"
        "mesh = { element_size_mm = 9 }\ntime = { end_s = 0.3 }\n"
        "[[variant]]\nname = \"stiff\"\ntissue.young_kpa = 300\n");
  }

  /// Whether it succeeded.
  bool ends_well(const std::string& before, const std::string& more = "") const {
    fs::remove_all(in("out"));
    const Outcome outcome =
        call("run x.toml --out out --no-cache" + more, before + " && ulimit -t 60");
    const auto reported = problems_in(outcome.err);
    if (outcome.status == 0) {
      EXPECT_THAT(reported, testing::IsEmpty()) << before;
      EXPECT_TRUE(fs::exists(in("out/summary.json"))) << before;
      EXPECT_TRUE(fs::exists(in("out/variants/stiff"))) << before;
    } else {
      EXPECT_EQ(outcome.status, 1) << before << '\n' << outcome.err;
      EXPECT_EQ(reported.size(), 1u) << before << '\n' << outcome.err;
      EXPECT_THAT(outcome.err, HasSubstr("memory")) << before;
      EXPECT_FALSE(fs::exists(in("out"))) << before;
    }
    for (const auto& entry : fs::directory_iterator(in("")))
      EXPECT_NE(entry.path().filename().string().front(), '.') << before << ": " << entry.path();
    return outcome.status == 0;
  }
};

TEST_F(TooLittleMemory, ByALimitEndsInOneLine) {
  std::vector<int> limits_kb{1433600};
  for (int kb = 200000; kb <= 1500000; kb += 100000) limits_kb.push_back(kb);
  // A mesh as by default: the larger limits end within the run, not before it.
  int succeeded = 0;
  for (const int kb : limits_kb)
    succeeded += ends_well("ulimit -v " + std::to_string(kb), " --set mesh.element_size_mm=3.3");
  EXPECT_LT(succeeded, int(limits_kb.size()) - 3) << "so little is not enough";
  EXPECT_TRUE(ends_well("ulimit -v unlimited"));
}

TEST_F(TooLittleMemory, AtAnyAllocationEndsInOneLine) {
  const std::string preload = "export LD_PRELOAD='" FAILING_NEW "'";
  const auto count = [&](const std::string& arguments) {
    const Outcome outcome = call(arguments, preload + " FAILING_NEW_COUNT=../count");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return std::stol(read_file(in("../count")));
  };
  const long before_main = count("--version"), all = count("run x.toml --out out --no-cache");
  ASSERT_GT(all, 100 * before_main) << "what libraries take before main() is little";
  constexpr int kTrials = 24;
  int failed = 0;
  for (int i = 0; i < kTrials; ++i) {
    // The steps grow from 100 allocations on: the program's parts differ in how often they
    // allocate.
    const double share = std::pow(double(all) / double(before_main), double(i) / kTrials);
    const long at = long(double(before_main) * share) + 100;
    for (const int lasting : {1, 20})
      failed += !ends_well(preload + " FAILING_NEW=" + std::to_string(at) +
                           " FAILING_NEW_FOR=" + std::to_string(lasting));
  }
  EXPECT_GT(failed, kTrials) << "most are not made up for";
}

}  // namespace
}  // namespace hyperex
