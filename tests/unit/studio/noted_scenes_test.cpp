// SPDX-License-Identifier: GPL-3.0-or-later
// The studio's page receives every warning that the program prints.
#include "support/noted_scenes.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "hyperex/core/files.hpp"
#include "open_face.hpp"
#include "support/test_file.hpp"

namespace hyperex::studio {
namespace {
using hyperex::test::NotedScene;

class NotedInTheStudio : public testing::TestWithParam<NotedScene> {};

TEST_P(NotedInTheStudio, IsAmongTheRemarksOfThePage) {
  if (GetParam().id == "recording.mirror_unknown")
    GTEST_SKIP() << "a whole video takes long; it is noted when read";
  const TestFolder folder;
  const auto file = write_noted_scene(GetParam(), folder.path() / "noted");
  OpenFace face(read_file(file), file, {}, [](const std::string&) {});
  face.run({});
  face.session().find_certainty();
  report::BinaryBlock block;
  const nlohmann::json remarks = face.replay(block, false)["summary"]["remarks"];
  EXPECT_TRUE(std::ranges::any_of(remarks, [&](const nlohmann::json& remark) {
    return remark["id"] == GetParam().id && remark["severity"] == "warning";
  })) << remarks.dump(1);
}

/// Without the warnings about files, since the studio writes files only when they are saved.
std::vector<NotedScene> of_the_studio() {
  std::vector<NotedScene> some = hyperex::test::noted_scenes();
  std::erase_if(some, [](const NotedScene& scene) { return scene.id.starts_with("output."); });
  return some;
}
INSTANTIATE_TEST_SUITE_P(Of, NotedInTheStudio, testing::ValuesIn(of_the_studio()),
                         [](const auto& of) {
                           std::string name = of.param.id;
                           std::ranges::replace(name, '.', '_');
                           return name;
                         });

}  // namespace
}  // namespace hyperex::studio
