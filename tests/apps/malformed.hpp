// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Faulty inputs as a user would give them to the program: each is refused in one clear line, and no
// output is left.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include "apps/good_inputs.hpp"
#include "apps/program.hpp"

namespace hyperex {

using In = std::function<std::filesystem::path(const std::string&)>;

struct Fault {
  std::string name;
  std::function<void(const In&)> spoil;
  std::vector<std::string> reported;  ///< texts that the line must contain
  std::string arguments = "run scene.toml --out out";
  std::string before = "true";
  int status = 2;
};

inline void PrintTo(const Fault& fault, std::ostream* out) {
  *out << fault.name;
}

class GoodInputs : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_good_inputs(in(""));
  }
};

class Malformed : public GoodInputs, public testing::WithParamInterface<Fault> {
 protected:
  void expect_refused(const Fault& fault) const {
    fault.spoil([&](const std::string& name) { return in(name); });
    const auto before = names_in(in(""));
    const Outcome found = call(fault.arguments, fault.before);
    EXPECT_EQ(found.status, fault.status) << found.out << found.err;
    EXPECT_EQ(found.out, "");
    const auto problems = problems_in(found.err);
    ASSERT_EQ(problems.size(), 1u) << found.err;
    std::cout << "  " << problems[0] << '\n';
    for (const auto& word : fault.reported) EXPECT_THAT(problems[0], testing::HasSubstr(word));
    // Nothing follows it.
    EXPECT_THAT(found.err, testing::EndsWith(problems[0] + "\n"));
    EXPECT_EQ(names_in(in("")), before);
  }
};

inline std::string name_of_fault(const testing::TestParamInfo<Fault>& info) {
  return info.param.name;
}

}  // namespace hyperex
