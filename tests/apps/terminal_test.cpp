// SPDX-License-Identifier: GPL-3.0-or-later
// What a run tells a terminal while it works.
#include "apps/good_inputs.hpp"
#include "apps/program.hpp"
#include "support/on_terminal.hpp"

namespace hyperex {
namespace {

class OnATerminal : public ProgramTest {};

/// Each bar begins at once, and its seconds go on by themselves (Progress). So every second shows
/// that the program works, also while it meshes and writes, which report nothing.
TEST_F(OnATerminal, EveryStageOfARunHasABar) {
  put(in("scene.toml"),
      "[scan]\nfile = \"embedded\"\n[motion]\nfile = \"embedded\"\n[mesh]\nelement_size_mm = 8\n"
      "layers = 1\n[time]\nend_s = 0.2\n[output]\nvtu = false\nreport = false\n");
  int status = -1;
  const std::string told =
      test::on_terminal([&] { status = shell("$HYPEREX run scene.toml --out out >out.txt"); });
  EXPECT_EQ(status, 0) << told;
  std::size_t from = 0;
  for (const char* stage : {"reading scan and recording", "meshing the soft tissue", "simulating",
                            "measuring", "writing pictures and files"}) {
    const auto begins = told.find("\r" + std::string(stage), from);
    ASSERT_NE(begins, std::string::npos) << stage << " is missing in\n" << told;
    const auto ends = told.find("100 %", begins);
    ASSERT_NE(ends, std::string::npos) << stage << " does not end in\n" << told;
    EXPECT_THAT(told.substr(begins, ends - begins), testing::HasSubstr(".]   0 %")) << stage;
    from = ends;
  }
}

}  // namespace
}  // namespace hyperex
