// SPDX-License-Identifier: GPL-3.0-or-later
// `hyperex landmarks`, and scenes that name no landmarks.
#include "hyperex/io/landmarks.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "apps/good_inputs.hpp"
#include "apps/program.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/session/face_session.hpp"
#include "support/note_matchers.hpp"

namespace hyperex {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

class LandmarksCommand : public ProgramTest {};

double median_error_mm(const io::Landmarks& found, const io::Landmarks& truth) {
  std::vector<double> errors;
  for (const auto& [name, at] : truth) errors.push_back(1e3 * (found.at(name) - at).norm());
  std::nth_element(errors.begin(), errors.begin() + std::ptrdiff_t(errors.size() / 2),
                   errors.end());
  return errors[errors.size() / 2];
}

TEST_F(LandmarksCommand, WritesLandmarksInTheScansUnit) {
  write_mm(in("face.ply"), good_face());
  const Outcome outcome = call("landmarks face.ply --out l.json --unit mm");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, testing::AllOf(HasSubstr("landmarks from 14 pictures"),
                                          HasSubstr("written to l.json; --picture")));
  EXPECT_THAT(read_file(in("l.json")), HasSubstr("\"units\": \"mm\""));
  EXPECT_LT(median_error_mm(io::read_landmarks(in("l.json")), good_landmarks()), 4);
  const auto files = [&] {  // and no other files
    return std::distance(fs::directory_iterator(in("")), fs::directory_iterator());
  };
  EXPECT_EQ(files(), 2);
  const Outcome drawn = call("landmarks face.ply --out l.json --unit mm --picture p.png");
  EXPECT_EQ(drawn.status, 0) << drawn.err;
  EXPECT_THAT(drawn.out, HasSubstr("written to l.json; look at p.png"));
  EXPECT_GT(fs::file_size(in("p.png")), 10000u);
  EXPECT_EQ(files(), 3);
}

TEST_F(LandmarksCommand, RefusesInOneLineAndLeavesNothing) {
  TriMesh sheet = good_face();
  sheet.points.col(2) *= 0.02;  // a flattened face, on which no face is found
  write_mm(in("sheet.ply"), sheet);
  for (const auto& [arguments, words] :
       {std::pair{"landmarks sheet.ply --out l.json --unit mm", "no face was found"},
        {"landmarks gone.ply --out l.json", "gone.ply"},
        {"landmarks sheet.ply --out no/l.json", "there is no folder"},
        {"landmarks sheet.ply --out l.json --picture l.json", "is named for two outputs"}}) {
    const Outcome outcome = call(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    const auto line = outcome.err.find("hyperex: ");
    ASSERT_NE(line, std::string::npos) << outcome.err;
    EXPECT_THAT(outcome.err.substr(line), HasSubstr(words));
    EXPECT_EQ(outcome.err.find('\n', line), outcome.err.size() - 1) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_FALSE(fs::exists(in("l.json"))) << arguments;
    EXPECT_FALSE(fs::exists(in("l.png"))) << arguments;
  }
}

TEST_F(LandmarksCommand, ASceneWithoutLandmarksHasThemFound) {
  write_good_inputs(in(""));
  replace_in(in("scene.toml"), "landmarks = \"face_landmarks.json\"\n", "");
  const Outcome checked = call("check scene.toml");
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_THAT(session::check(scene::read_scene(in("scene.toml"))),
              testing::Contains(test::is_note("landmarks.not_searched")));
  const Outcome run = call("run scene.toml --out out");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(text_of("landmarks.found"), HasSubstr("92"));
}

TEST_F(LandmarksCommand, AMeshWithoutLandmarksHasThemFound) {
  write_good_inputs(in(""));
  fs::remove(in("face_landmarks.json"));
  const Outcome outcome =
      call("mesh face.ply --unit mm --out out.vtu --element-size-mm 12 --layers 1");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("no landmarks beside the scan"));
  EXPECT_TRUE(fs::exists(in("out.vtu")));
}

TEST_F(LandmarksCommand, CheckLooksAtARecordingsFirstFace) {
  const fs::path recording = fs::path(HYPEREX_SHARED_DIR) / "data/rgbd/subject_A_talk";
  if (!fs::exists(recording)) GTEST_SKIP() << "no " << recording;
  write_good_inputs(in(""));
  replace_in(in("scene.toml"), "file = \"motion.csv\"", "recording = \"recording\"");
  fs::create_directory_symlink(recording, in("recording"));
  const Outcome checked = call("check scene.toml");
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_THAT(checked.out, HasSubstr("there is a face in frame 0 of the recording; not checked"));
  EXPECT_THAT(checked.out, HasSubstr("aligned by"));
  const Outcome wrong = call("check scene.toml --set 'drive.points=[\"nowhere\"]'");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("nowhere"));
}

}  // namespace
}  // namespace hyperex
