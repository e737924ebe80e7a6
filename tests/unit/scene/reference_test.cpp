// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>

#include "hyperex/core/files.hpp"
#include "hyperex/scene/keys.hpp"
#include "unit/scene/scene_files.hpp"

namespace hyperex::scene {
namespace {

TEST(Reference, PageIsUpToDate) {
  const std::string page =
      read_file(std::filesystem::path(HYPEREX_SOURCE_DIR) / "docs" / "scene.md");
  EXPECT_TRUE(page == reference_markdown())
      << "docs/scene.md is not that of the table of keys; make it again with\n"
         "  build/release/bin/hyperex scene-reference > docs/scene.md";
}

TEST(Reference, HasARowForEachKey) {
  const std::string page = reference_markdown();
  for (const Key& key : keys()) {
    const std::string section = section_of(key.name);
    const auto start = page.find(section.empty() ? "## Top level" : "## [" + section + "]");
    ASSERT_NE(start, std::string::npos) << key.name;
    const std::string part = page.substr(start, page.find("\n## ", start + 1) - start);
    const std::string name = section.empty() ? key.name : key.name.substr(section.size() + 1);
    const std::string row = key.kind == Kind::rows ? "[[" + key.name + "]]" : name;
    EXPECT_THAT(part, testing::HasSubstr("| `" + row + "` |")) << key.name;
  }
}

TEST(Reference, SaysHowFarPatchesOfTheChinFade) {
  const std::string page = reference_markdown();
  const auto row = page.find("| `patch_radius_mm` |");
  ASSERT_NE(row, std::string::npos);
  EXPECT_THAT(page.substr(row, page.find('\n', row) - row),
              testing::AllOf(testing::HasSubstr("points of the chin fade out over a further 20 mm"),
                             testing::HasSubstr("unless the radius is 0")));
}

TEST(Reference, ExampleIsASoundScene) {
  const std::string page = reference_markdown();
  const auto start = page.find("```toml\n") + 8;
  const SceneFolder folder;
  const auto file = folder.write("s.toml", page.substr(start, page.find("```", start) - start));
  EXPECT_EQ(sentences(problems_of(file)), "");
}

}  // namespace
}  // namespace hyperex::scene
