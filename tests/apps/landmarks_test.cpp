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
#include "support/half_face.hpp"
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

TEST_F(LandmarksCommand, PrintsNoControlCharacters) {
  write_mm(in("a\x1b[31m.ply"), good_face());
  for (const char* arguments : {"landmarks 'a\x1b[31m.ply' --out 'l\x1b[31m.json' --picture "
                                "'p\x1b[31m.png'",
                                "landmarks 'gone\x1b[31m.ply' --out l.json"}) {
    const Outcome outcome = call(arguments);
    EXPECT_EQ((outcome.out + outcome.err).find('\x1b'), std::string::npos)
        << outcome.out << outcome.err;
  }
  EXPECT_TRUE(fs::exists(in("l\x1b[31m.json")));
}

TEST_F(LandmarksCommand, WarnsOfAScanOfHalfAFace) {
  write_mm(in("half.ply"), test::half_face(good_face(), true));
  const Outcome found = call("landmarks half.ply --out l.json --unit mm");
  EXPECT_EQ(found.status, 0) << found.err;
  EXPECT_THAT(found.err,
              HasSubstr("half.ply: the right half of the face is missing from the scan"));
  // A scene of it is refused, before and by a run.
  write_good_inputs(in(""));
  fs::rename(in("half.ply"), in("face.ply"));
  replace_in(in("scene.toml"), "landmarks = \"face_landmarks.json\"\n", "");
  for (const char* arguments : {"check scene.toml", "run scene.toml --out out"}) {
    const Outcome refused = call(arguments);
    EXPECT_EQ(refused.status, 2) << arguments;
    EXPECT_THAT(problems_in(refused.err),
                testing::ElementsAre(HasSubstr("face.ply: the right half of the face is missing")));
  }
  write_mm(in("whole.ply"), good_face());
  EXPECT_THAT(call("landmarks whole.ply --out l.json --unit mm").err,
              testing::Not(HasSubstr("is missing")));
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
  EXPECT_THAT(checked.out, testing::AllOf(HasSubstr("the scene names no landmarks: 92 were found"),
                                          HasSubstr("aligned by ")));
  EXPECT_THAT(
      session::check(scene::read_scene(in("scene.toml")), nullptr, session::CheckDepth::inputs),
      testing::Contains(test::is_note("landmarks.not_searched")));
  const Outcome run = call("run scene.toml --out out");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(text_of("landmarks.found"), HasSubstr("92"));
}

/// Another person's recording: a check sees it, and meshes the face, without a file of landmarks.
TEST_F(LandmarksCommand, ACheckJudgesTheFitByFoundLandmarks) {
  write_good_inputs(in(""));
  replace_in(in("scene.toml"), "landmarks = \"face_landmarks.json\"\n", "");
  write_opening(in(""), 0, 16, [](motion::Motion& m) {
    for (Points& at : m.positions) at *= 1.2;
  });
  const Outcome checked = call("check scene.toml");
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_THAT(checked.out, testing::AllOf(HasSubstr("warning: the recording has not the size of"),
                                          HasSubstr("but ")));
  // What a run would refuse of the landmarks and the mesh, a check refuses.
  const Outcome wrong = call("check scene.toml --set 'drive.still_points=[\"antenna\"]'");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("antenna"));
  EXPECT_EQ(call("check scene.toml --set mesh.element_size_mm=30").status, 2);
  const std::string cached = "export XDG_CACHE_HOME='" + in("cache").string() + "'";
  const auto err = [&](const char* more) {
    return call(std::string("check scene.toml ") + more, cached).err;
  };
  EXPECT_THAT(err(""), testing::Not(HasSubstr("using the landmarks")));
  EXPECT_THAT(err(""), HasSubstr("using the landmarks that an earlier run"));
  EXPECT_THAT(err("--no-cache"), testing::Not(HasSubstr("using the landmarks")));
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
