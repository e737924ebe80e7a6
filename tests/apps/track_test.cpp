// SPDX-License-Identifier: GPL-3.0-or-later
// `hyperex track` on valid and faulty recordings of the embedded face.
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "apps/malformed.hpp"
#include "support/face_recording.hpp"
#include "support/test_file.hpp"

namespace hyperex {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr int kFrames = 7;

/// Rendered once.
const fs::path& face_recording() {
  static const struct Made {
    const TestFolder folder;
    Made() { test::write_face_recording(folder, kFrames); }
  } made;
  return made.folder;
}

class Track : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    fs::copy(face_recording(), in("rec"), fs::copy_options::recursive);
  }
};

TEST_F(Track, JsonIsTheScoreAndNothingElse) {
  const Outcome outcome = call("track --score rec --json");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  // parse() throws where anything else is printed.
  const auto score = nlohmann::ordered_json::parse(outcome.out);
  std::vector<std::string> keys;
  for (const auto& [key, value] : score.items()) keys.push_back(key);
  EXPECT_THAT(keys, testing::ElementsAre("frames", "lost", "rotation_deg", "translation_mm",
                                         "deformation_mm", "jaw_correlation", "rest_jitter_mm"));
  for (const char* pair : {"rotation_deg", "translation_mm", "deformation_mm"}) {
    EXPECT_EQ(score[pair].size(), 2u);
    EXPECT_LE(score[pair]["median"].get<double>(), score[pair]["p95"].get<double>()) << pair;
  }
  EXPECT_EQ(score["frames"], kFrames);
  EXPECT_EQ(score["lost"], 0);
  EXPECT_LT(score["rotation_deg"]["p95"].get<double>(), 1);
  EXPECT_LT(score["deformation_mm"]["median"].get<double>(), 2);
  EXPECT_TRUE(score["jaw_correlation"].is_null());  // it does not move
}

TEST_F(Track, WritesMotionPoseUnitsAndArkitsWeights) {
  const Outcome outcome = call("track rec --out m.csv --trc m.trc");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const char* name : {"m.csv", "m.pose.csv", "m.units.csv", "m.arkit.csv"}) {
    const std::string text = read_file(in(name));
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), kFrames + 1) << name;
    EXPECT_THAT(text, testing::StartsWith("time_s,")) << name;
  }
  EXPECT_THAT(read_file(in("m.csv")), HasSubstr("pronasale_x_mm"));
  EXPECT_THAT(read_file(in("m.units.csv")), HasSubstr("jawOpen [AU26+AU27]"));
  EXPECT_TRUE(fs::exists(in("m.trc")));
}

TEST_F(Track, FramesThatAreTornAreMarkedAndTheRestGoesOn) {
  tear(in("rec/rgb/0.133333.jpg"), 0.4);
  fs::remove(in("rec/depth/0.166667.png"));
  const Outcome outcome = call("track --score rec --json");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto score = nlohmann::ordered_json::parse(outcome.out);
  EXPECT_EQ(score["lost"], 2);
  EXPECT_LT(score["rotation_deg"]["p95"].get<double>(), 1);
}

TEST_F(Track, APhotographIsFittedAndItsScaleTold) {
  const Outcome outcome = call("track rec/rgb/0.000000.jpg --out m.csv --eye-distance-mm 88");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err,
              testing::AllOf(HasSubstr("88 mm"), HasSubstr("eye"), HasSubstr("field of view")));
  const std::string text = read_file(in("m.csv"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
}

TEST_F(Track, CandideRuns) {
  const fs::path file = fs::path(HYPEREX_SHARED_DIR) / "data/candide/candide3.wfm";
  if (!fs::exists(file)) GTEST_SKIP() << file << " is not here";
  const Outcome outcome =
      call("track rec --out m.csv --score rec --json --model 'candide:" + file.string() + "'");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(nlohmann::ordered_json::parse(outcome.out)["lost"], 0);
  EXPECT_THAT(read_file(in("m.units.csv")), HasSubstr("Jaw drop [AU26+AU27]"));
}

class FaultyRecording : public Malformed {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    fs::copy(face_recording(), in("rec"), fs::copy_options::recursive);
  }
};

TEST_P(FaultyRecording, IsRefusedInOneLine) {
  expect_refused(GetParam());
}

void for_each_picture(const fs::path& folder, const std::function<void(const fs::path&)>& act) {
  for (const auto& entry : fs::directory_iterator(folder)) act(entry.path());
}

const std::vector<Fault> kFaults = {
    {"NoSuchFolder", [](const In&) {}, {"gone", "no such folder"}, "track gone --out m.csv"},
    {"FolderOfRecordings", [](const In&) {}, {"is no recording", "rec"}, "track . --out m.csv"},
    {"NoRecordingNamed", [](const In&) {}, {"no recording is named"}, "track --out m.csv"},
    {"AMesh",
     [](const In& in) { put(in("me.PLY"), "ply\n"); },
     {"me.PLY", "is a mesh", "hyperex landmarks"},
     "track me.PLY --out m.csv"},
    {"ScoreWithoutTruth",
     [](const In& in) { fs::remove(in("rec/truth_pose.csv")); },
     {"truth_pose.csv"},
     "track --score rec --json --out m.csv"},
    {"TruthOfOtherTimes",
     [](const In& in) { replace_in(in("rec/truth_weights.csv"), "0.033333", "0.040000"); },
     {"truth_weights.csv:3", "time_s", "0.04"},
     "track --score rec --out m.csv"},
    {"AllPicturesTorn",
     [](const In& in) {
       for_each_picture(in("rec/rgb"), [](const fs::path& file) { tear(file, 0.3); });
     },
     {"rec", "torn"},
     "track rec --out m.csv"},
    {"AllDepthMissing",
     [](const In& in) {
       for_each_picture(in("rec/depth"), [](const fs::path& file) { fs::remove(file); });
     },
     {"rec", "depth/", "no such file"},
     "track rec --out m.csv"},
    {"CameraMissing",
     [](const In& in) { fs::remove(in("rec/camera.toml")); },
     {"camera.toml", "missing"},
     "track rec --out m.csv"},
    {"CameraWithoutFocalLength",
     [](const In& in) { replace_in(in("rec/camera.toml"), "fx", "focal"); },
     {"camera.toml", "fx"},
     "track rec --out m.csv"},
    {"CameraIsNoToml",
     [](const In& in) { put(in("rec/camera.toml"), "width: 360\n"); },
     {"camera.toml:1"},
     "track rec --out m.csv"},
    {"CameraOfOtherPictures",
     [](const In& in) { replace_in(in("rec/camera.toml"), "width = 360", "width = 640"); },
     {"rec", "360 x 360", "640 x 360"},
     "track rec --out m.csv"},
    {"NoFaceInView",
     [](const In& in) {
       for_each_picture(in("rec/rgb"), [](const fs::path& file) {
         cv::imwrite(file.string(), cv::Mat(360, 360, CV_8UC3, cv::Scalar::all(120)));
       });
     },
     {"rec: no face was found"},
     "track rec --out m.csv --trc m.trc"},
    {"NoFaceBeforeADevice",
     [](const In& in) {
       for_each_picture(in("rec/rgb"), [](const fs::path& file) {
         cv::imwrite(file.string(), cv::Mat(360, 360, CV_8UC3, cv::Scalar::all(120)));
       });
     },
     {"play:rec: no face was found"},
     "track --device play:rec --out m.csv"},
    {"PhotographWithoutAFace",
     [](const In& in) {
       cv::imwrite(in("wall.png").string(), cv::Mat(200, 300, CV_8UC3, cv::Scalar::all(90)));
     },
     {"wall.png: no face was found"},
     "track wall.png --out m.csv"},
    {"PhotographTorn",
     [](const In& in) {
       fs::copy_file(in("rec/rgb/0.000000.jpg"), in("me.jpg"));
       tear(in("me.jpg"), 0.3);
     },
     {"me.jpg: torn"},
     "track me.jpg --out m.csv"},
    {"UnknownModel",
     [](const In&) {},
     {"--model", "canonicle", "candide:FILE"},
     "track rec --model canonicle --out m.csv"},
    {"ModelTorn",
     [](const In& in) { put(in("face.wfm"), "# VERTEX LIST:\n3\n0 0 0\n1 0\n"); },
     {"face.wfm:4"},
     "track rec --model candide:face.wfm --out m.csv"},
    {"OutputInNoFolder", [](const In&) {}, {"no/m.csv"}, "track rec --out no/m.csv"},
    {"NothingToDo", [](const In&) {}, {"--out"}, "track rec"},
};
INSTANTIATE_TEST_SUITE_P(Track, FaultyRecording, testing::ValuesIn(kFaults), name_of_fault);

}  // namespace
}  // namespace hyperex
