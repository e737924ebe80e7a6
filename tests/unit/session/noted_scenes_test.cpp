// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/noted_scenes.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "hyperex/core/note_kinds.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/session/face_session.hpp"
#include "hyperex/session/inputs.hpp"
#include "support/note_matchers.hpp"
#include "support/video.hpp"
#include "unit/scene/scene_files.hpp"

namespace hyperex::session {
namespace {
using test::NotedScene;

TEST(NotedScenes, AreThereForEveryWarning) {
  for (const NoteKind& kind : note_kinds()) {
    if (kind.severity != Severity::warning) continue;
    const auto count = std::ranges::count(test::noted_scenes(), kind.id, &NotedScene::id);
    EXPECT_EQ(count + long(test::warnings_without_scene().count(kind.id)), 1) << kind.id;
  }
}

class NotedWhenRead : public testing::TestWithParam<NotedScene> {};

TEST_P(NotedWhenRead, ByReadingTheInputs) {
  if (GetParam().id == "recording.mirror_unknown") {
    SKIP_WITHOUT_VIDEO();
  }
  const scene::SceneFolder folder;
  const auto file = write_noted_scene(GetParam(), folder / "noted");
  const Inputs inputs = read_inputs(scene::read_scene(file), Extent::quick);
  EXPECT_THAT(notes_of(inputs.notes, Severity::warning),
              testing::Contains(test::is_warning(GetParam().id)));
}

std::vector<NotedScene> when_read() {
  std::vector<NotedScene> some = test::noted_scenes();
  std::erase_if(some, [](const NotedScene& scene) { return !scene.when_read; });
  return some;
}
std::string name_of(const testing::TestParamInfo<NotedScene>& of) {
  std::string name = of.param.id;
  std::ranges::replace(name, '.', '_');
  return name;
}
/// The notes that a C++ program receives.
class NotedInASession : public testing::TestWithParam<NotedScene> {};

TEST_P(NotedInASession, ByRunningIt) {
  if (GetParam().id == "recording.mirror_unknown")
    GTEST_SKIP() << "a whole video takes long; it is noted when read";
  const scene::SceneFolder folder;
  std::vector<Note> heard;
  FaceSession face(write_noted_scene(GetParam(), folder / "noted"), {},
                   {.note = [&](const Note& note) { heard.push_back(note); }});
  face.run();
  face.find_certainty();
  EXPECT_THAT(face.warnings(), testing::Contains(test::is_warning(GetParam().id)));
  EXPECT_THAT(heard, testing::Contains(test::is_warning(GetParam().id)));
}

/// Warnings about the files that a run writes do not come from a session.
std::vector<NotedScene> of_sessions() {
  std::vector<NotedScene> some = test::noted_scenes();
  std::erase_if(some, [](const NotedScene& scene) { return scene.id.starts_with("output."); });
  return some;
}
INSTANTIATE_TEST_SUITE_P(Of, NotedInASession, testing::ValuesIn(of_sessions()), name_of);
INSTANTIATE_TEST_SUITE_P(Of, NotedWhenRead, testing::ValuesIn(when_read()), name_of);

}  // namespace
}  // namespace hyperex::session
