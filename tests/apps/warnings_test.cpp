// SPDX-License-Identifier: GPL-3.0-or-later
// The program shows every warning: `hyperex run` in its log and in summary.json, `hyperex check`
// what the inputs alone show.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "apps/program.hpp"
#include "support/noted_scenes.hpp"
#include "support/video.hpp"

namespace hyperex {
namespace {
using testing::HasSubstr;

class Warnings : public ProgramTest, public testing::WithParamInterface<test::NotedScene> {};

TEST_P(Warnings, AreShownByTheProgram) {
  const auto& noted = GetParam();
  if (noted.id == "recording.mirror_unknown") {
    SKIP_WITHOUT_VIDEO();
  }
  write_noted_scene(noted, in(""));
  if (noted.id == "recording.mirror_unknown") {  // a run would have to track a whole video
    EXPECT_THAT(call("check scene.toml").out, HasSubstr("set motion.mirrored to true or false"));
    return;
  }
  const Outcome run = call("run scene.toml --out out");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto summary = nlohmann::json::parse(read_file(in("out/summary.json")));
  std::string text;
  for (const auto& remark : summary["remarks"])
    if (remark["id"] == noted.id) {
      text = remark["text"];
      EXPECT_EQ(remark["severity"], "warning");
    }
  ASSERT_NE(text, "") << summary["remarks"].dump(1);
  EXPECT_THAT(summary["warnings"], testing::Contains(text));
  EXPECT_THAT(run.err, HasSubstr(text));
  if (noted.when_read) {
    EXPECT_THAT(call("check scene.toml").out, HasSubstr("warning: " + text));
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Warnings, testing::ValuesIn(test::noted_scenes()), [](const auto& of) {
  std::string name = of.param.id;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
});

}  // namespace
}  // namespace hyperex
