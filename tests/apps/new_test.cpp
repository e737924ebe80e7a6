// SPDX-License-Identifier: GPL-3.0-or-later
// `hyperex new`: from a scan and a recording to a scene that runs.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <utility>

#include "apps/good_inputs.hpp"
#include "apps/program.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "support/video.hpp"

namespace hyperex {
namespace {

using testing::HasSubstr;

class NewCommand : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_good_inputs(in(""));
  }
};

TEST_F(NewCommand, WritesASceneThatPassesTheCheck) {
  const Outcome made = call("new face.ply motion.csv --out me.toml");
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("next: hyperex check me.toml"));
  EXPECT_THAT(read_file(in("me.toml")), HasSubstr("unit = \"mm\"  # mm, guessed by its size"));
  const Outcome checked = call("check me.toml");
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_THAT(checked.out, HasSubstr("no problems found"));
}

/// Three minutes, whose frames for ParaView would take more than output.most_gb.
TEST_F(NewCommand, OfALongTakeWritesASceneThatPassesTheCheckToo) {
  std::string weights = "time_s,mouthSmileLeft,mouthSmileRight\n";
  for (int k = 0; k <= 1800; ++k)
    weights += fmt::format("{0:.1f},{1:.4f},{1:.4f}\n", k / 10.0, 0.5 - 0.5 * std::cos(k / 10.0));
  put(in("long.csv"), weights);
  const Outcome made = call("new embedded long.csv --out me.toml");
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(read_file(in("me.toml")), HasSubstr("\nvtu_every = "));
  EXPECT_THAT(read_file(in("me.toml")), HasSubstr("# The recording lasts 180 s."));
  EXPECT_THAT(made.out,
              testing::AllOf(HasSubstr("a run: "), HasSubstr(" on two idle processors"),
                             testing::EndsWith("a part of it, 6 s from 90 s on: hyperex run "
                                               "me.toml --out out/me --set time.start_s=90 --set "
                                               "time.end_s=6\n")));
  EXPECT_EQ(call("check me.toml --set time.start_s=90 --set time.end_s=6").status, 0);
  const Outcome checked = call("check me.toml");
  EXPECT_EQ(checked.status, 0) << checked.err;
  const Outcome refused = call("check me.toml --set output.vtu_every=1");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("or more, which leaves 20 % to spare"));
  ASSERT_EQ(call("new embedded embedded --out short.toml").status, 0);
  EXPECT_THAT(read_file(in("short.toml")), testing::Not(HasSubstr("vtu_every")));
  EXPECT_THAT(read_file(in("short.toml")), testing::Not(HasSubstr("The recording lasts")));
}

TEST_F(NewCommand, ItsVariantIsLeftOutOfTheCheckAsOfARun) {
  ASSERT_EQ(call("new face.ply motion.csv --out me.toml").status, 0);
  EXPECT_THAT(call("check me.toml").out, HasSubstr("; without its variant, "));
  const Outcome checked = call("check me.toml --no-variants");
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_THAT(checked.out, HasSubstr("on two idle processors; contact adds up to "));
  EXPECT_THAT(checked.out, testing::Not(HasSubstr("without its variant")));
}

/// A gain on a muscle that rests would answer nothing.
TEST_F(NewCommand, SuggestsMusclesThatASmileUses) {
  ASSERT_EQ(
      call("new embedded '" HYPEREX_SOURCE_DIR "/examples/smile_arkit.csv' --out me.toml").status,
      0);
  const std::string scene = read_file(in("me.toml")), words = "; one muscle: ";
  const auto at = scene.find(words);
  ASSERT_NE(at, std::string::npos) << scene;
  const std::string muscle =
      scene.substr(at + words.size(), scene.find('\n', at) - at - words.size());
  put(in("me.toml"),
      scene + "\n[[variant]]\nname = \"one muscle\"\nmuscles.gain = { " + muscle + " = 0.3 }\n");
  const Outcome run = call(
      "run me.toml --out out --set output.vtu=false --set output.glb=false --set "
      "output.report=false");
  ASSERT_EQ(run.status, 0) << run.err;
  const nlohmann::json found = summary();
  for (const auto& remark : found["remarks"])
    EXPECT_THAT(remark["id"].get<std::string>(), testing::Not(HasSubstr("hardly_used")))
        << remark["text"];
  const nlohmann::json& table = found["variants"]["table"];
  ASSERT_EQ(table.size(), 3u);
  for (const std::size_t variant : {1, 2})
    EXPECT_LT(table[variant]["commissure_R_mm"].get<double>(),
              0.95 * table[0]["commissure_R_mm"].get<double>())
        << variant;
}

TEST_F(NewCommand, NamesFilesAsSeenFromTheScenesFolder) {
  std::filesystem::create_directory(in("scenes"));
  ASSERT_EQ(call("new face.ply embedded --out scenes/me.toml").status, 0);
  EXPECT_THAT(read_file(in("scenes/me.toml")), HasSubstr("file = \"../face.ply\""));
  EXPECT_EQ(call("check scenes/me.toml").status, 0);
}

TEST_F(NewCommand, NamesTheStillPointsOfAFileThatHasItsOwn) {
  write_opening(in(""), 0, 16, keep_mouth_and_headband);
  const Outcome made = call("new face.ply motion.csv --out me.toml");
  ASSERT_EQ(made.status, 0) << made.err;
  const std::string scene = read_file(in("me.toml"));
  for (int i = 1; i <= 6; ++i) EXPECT_THAT(scene, HasSubstr("\"head_" + std::to_string(i) + "\""));
  const Outcome checked = call("check me.toml");
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_THAT(checked.out, HasSubstr("no problems found"));
  // The same with landmarks, by which the recording is laid on the scan.
  const Outcome aligned = call("check me.toml --set scan.landmarks=face_landmarks.json");
  EXPECT_EQ(aligned.status, 0) << aligned.err;
  EXPECT_THAT(aligned.out, HasSubstr("aligned by 7 common points"));
}

/// Landmarks of the face give a pose; points of the skull give a better one.
TEST_F(NewCommand, NamesTheBandOfAFileThatHasLandmarksToo) {
  write_opening(in(""), 0, 41, add_headband);
  const Outcome made = call("new face.ply motion.csv --out me.toml");
  ASSERT_EQ(made.status, 0) << made.err;
  const std::string scene = read_file(in("me.toml"));
  EXPECT_THAT(scene, HasSubstr("rigid_points = [\"head_1\", \"head_2\", \"head_3\", "
                               "\"head_4\", \"head_5\", \"head_6\"]"));
  EXPECT_THAT(scene, HasSubstr("# These keep still against each other"));
  EXPECT_THAT(made.out, HasSubstr("the head is held by head_1, head_2, head_3, head_4, head_5, "
                                  "head_6, which keep still against each other"));
  // A scene that does not name them is told so.
  const std::string sentence =
      "while head_1, head_2, head_3, head_4, head_5, head_6 keep still against each other, as "
      "points of the skull do, and are not used; ";
  EXPECT_THAT(call("check scene.toml").out,
              HasSubstr(sentence + "name them in motion.rigid_points"));
  put(in("v.toml"),
      "patient = \"P\"\n[[visit]]\ndate = 2026-03-01\nrecording = \"motion.csv\"\n"
      "jitter_mm = 0\n");
  // symmetry and visits use the same points.
  const std::string held =
      "the head is held by head_1, head_2, head_3, head_4, head_5, head_6, which keep still "
      "against each other; ";
  EXPECT_THAT(call("visits v.toml").err,
              HasSubstr(held + "the same in every recording; rigid_points of the visits changes"));
  const Outcome own = call("symmetry motion.csv --jitter-mm 0 --excursions own.csv");
  EXPECT_THAT(own.err, HasSubstr(held + "--rigid-points changes that"));
  ASSERT_EQ(call("symmetry motion.csv --jitter-mm 0 --excursions named.csv --rigid-points "
                 "head_1,head_2,head_3,head_4,head_5,head_6")
                .status,
            0);
  EXPECT_EQ(read_file(in("own.csv")), read_file(in("named.csv")));
  for (const std::string& used :
       {call("check me.toml --set scan.landmarks=face_landmarks.json").out,
        call("symmetry motion.csv --jitter-mm 0 --rigid-points head_1,head_2,head_3").err})
    EXPECT_THAT(used, testing::Not(HasSubstr("are not used")));
}

TEST_F(NewCommand, AShortGapCostsNoMarkerOfTheBand) {
  const std::string band =
      "rigid_points = [\"head_1\", \"head_2\", \"head_3\", \"head_4\", \"head_5\", "
      "\"head_6\"]";
  const auto write = [&](bool loses_a_sample) {
    write_opening(in(""), 0, 41, [&](motion::Motion& m) {
      add_headband(m);
      const double nan = std::numeric_limits<double>::quiet_NaN();
      for (std::size_t k = 20; k < 23; ++k)
        m.positions[k].row(m.index_of("head_3")).setConstant(nan);
      if (loses_a_sample) m.positions[10].setConstant(nan);
    });
  };
  write(true);
  ASSERT_EQ(call("new face.ply motion.csv --out lost.toml").status, 0);
  EXPECT_THAT(read_file(in("lost.toml")), HasSubstr(band));
  EXPECT_EQ(call("check lost.toml").status, 0);
  write(false);
  ASSERT_EQ(call("new face.ply motion.csv --out me.toml").status, 0);
  EXPECT_THAT(read_file(in("me.toml")), HasSubstr(band));
  EXPECT_THAT(call("symmetry motion.csv").err,
              HasSubstr("the head is held by head_1, head_2, head_3, head_4, head_5, head_6, "));
}

TEST_F(NewCommand, SaysAtOnceWhatARunWouldRefuse) {
  const auto made_of = [&](const std::string& name, const auto& change) {
    write_opening(in(""), 0, 16, [&](motion::Motion& m) {
      keep_mouth_and_headband(m);
      change(m);
    });
    const Outcome made = call("new face.ply motion.csv --out " + name + ".toml");
    EXPECT_EQ(made.status, 0) << made.err;
    EXPECT_EQ(call("check " + name + ".toml").status, 2);
    return made.err;
  };
  EXPECT_THAT(made_of("headless",
                      [](motion::Motion& m) {
                        for (Points& at : m.positions) at.conservativeResize(7, Eigen::NoChange);
                        m.names.resize(7);
                      }),
              testing::AllOf(HasSubstr("warning: "), HasSubstr("record three such points or more"),
                             HasSubstr("hyperex symmetry works without them")));
  EXPECT_THAT(made_of("words",
                      [](motion::Motion& m) {
                        for (int k = 0; k < 7; ++k)
                          m.names[std::size_t(k)] =
                              k == 0 ? "right mouth corner" : "lip " + std::to_string(k);
                      }),
              testing::AllOf(HasSubstr("shares 0 point names with the scan's landmarks"),
                             HasSubstr("did you mean ibug68_48 by right mouth corner?")));
}

/// The scene is written all the same: the recording may be corrected.
TEST_F(NewCommand, WarnsOfExchangedSides) {
  write_opening(in(""), 0, 16, [](motion::Motion& m) {
    for (Points& at : m.positions) at.col(0) *= -1;
  });
  const Outcome made = call("new face.ply motion.csv --out me.toml");
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.err, testing::AllOf(HasSubstr("warning: "),
                                       HasSubstr("motion.csv: left and right are exchanged: the "
                                                 "points are ")));
  EXPECT_TRUE(std::filesystem::exists(in("me.toml")));
  const Outcome checked = call("check me.toml");
  EXPECT_EQ(checked.status, 2);
  EXPECT_THAT(checked.err, HasSubstr("motion.csv: left and right are exchanged: the points are "));
  write_opening(in(""), 0, 16);
  EXPECT_THAT(call("new face.ply motion.csv --out right.toml").err,
              testing::Not(HasSubstr("exchanged")));
}

/// Weights of a blink alone, through a new scene and a run, to closed lids.
TEST_F(NewCommand, WeightsOfABlinkCloseTheLids) {
  std::string weights = "time_s,eyeBlinkLeft,eyeBlinkRight\n";
  for (int k = 0; k <= 15; ++k) {
    const double weight = 0.99 * std::min(1.0, k / 12.0);
    weights += fmt::format("{0:.4f},{1:.4f},{1:.4f}\n", k / 30.0, weight);
  }
  put(in("blink.csv"), weights);
  const Outcome made = call("new face.ply blink.csv --out me.toml");
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(read_file(in("me.toml")), HasSubstr("arkit = \"blink.csv\""));
  const Outcome run = call(
      "run me.toml --out out --set scan.landmarks=face_landmarks.json --set output.report=false "
      "--set output.glb=false --set output.vtu=false");
  ASSERT_EQ(run.status, 0) << run.err;
  const motion::Motion moved = motion::read_motion(in("out/motion.csv"));
  const auto aperture_mm = [&](const Points& sample, int upper, int lower) {
    const int up = moved.index_of(face::ibug(upper)), down = moved.index_of(face::ibug(lower));
    return 1e3 * (sample.row(up) - sample.row(down)).norm();
  };
  for (const auto& [upper, lower] : {std::pair{37, 41}, {38, 40}, {43, 47}, {44, 46}}) {
    EXPECT_GT(aperture_mm(moved.positions.front(), upper, lower), 4) << upper;
    EXPECT_LT(aperture_mm(moved.positions.back(), upper, lower), 1) << upper;
  }
}

TEST_F(NewCommand, RefusesANameThatASceneCannotHoldInOneLine) {
  std::filesystem::copy_file(in("face.ply"), in("caf\xe9.ply"));
  const Outcome made = call("new 'caf\xe9.ply' motion.csv --out a.toml");
  EXPECT_EQ(made.status, 2);
  EXPECT_THAT(made.err, HasSubstr("caf\\xe9.ply: the name is not in UTF-8"));
  EXPECT_EQ(std::count(made.err.begin(), made.err.end(), '\n'), 1) << made.err;
  EXPECT_FALSE(std::filesystem::exists(in("a.toml")));
}

TEST_F(NewCommand, PrintsNoControlCharacters) {
  std::filesystem::rename(in("face.ply"), in("a\x1b[31m.ply"));
  const Outcome made = call("new 'a\x1b[31m.ply' motion.csv");
  EXPECT_EQ(made.status, 0) << made.err;
  const Outcome checked = call("check 'a\x1b[31m.toml'");
  EXPECT_EQ((made.out + made.err + checked.out + checked.err).find('\x1b'), std::string::npos)
      << checked.out;
}

TEST_F(NewCommand, RefusesWhatIsNoRecording) {
  put(in("notes.md"), "# What was recorded\n");
  const Outcome text = call("new face.ply notes.md --out a.toml");
  EXPECT_EQ(text.status, 2);
  EXPECT_THAT(text.err, HasSubstr("notes.md: is no recording that can be read; expected a CSV"));
  const Outcome swapped = call("new motion.csv face.ply --out a.toml");
  EXPECT_EQ(swapped.status, 2);
  EXPECT_THAT(swapped.err, HasSubstr("the scan comes first, then the recording; expected hyperex "
                                     "new face.ply motion.csv"));
  const Outcome twice = call("new face.ply face.ply --out a.toml");
  EXPECT_EQ(twice.status, 2);
  EXPECT_THAT(twice.err, HasSubstr("face.ply: is a scan; expected a recording"));
  put(in("results.csv"), "point,excursion_L_mm\nalare,1.5\n");
  const Outcome results = call("new face.ply results.csv --out a.toml");
  EXPECT_EQ(results.status, 2);
  EXPECT_THAT(results.err,
              HasSubstr("results.csv: this is no recording: it has no column of time"));
  EXPECT_FALSE(std::filesystem::exists(in("a.toml")));
}

TEST_F(NewCommand, RefusesAnEmptyTableInOneLine) {
  put(in("empty.csv"), "");
  put(in("times.csv"), "time_s\n0\n");
  for (const auto& [file, why] :
       {std::pair{"empty.csv", "empty.csv: is empty; expected a table whose first line names"},
        {"times.csv", "times.csv: there are no points: expected NAME_x"}}) {
    const Outcome made = call(std::string("new face.ply ") + file + " --out a.toml");
    EXPECT_EQ(made.status, 2);
    EXPECT_THAT(problems_in(made.err), testing::ElementsAre(HasSubstr(why)));
    EXPECT_FALSE(std::filesystem::exists(in("a.toml")));
  }
}

TEST_F(NewCommand, RefusesARecordingOfOneSampleAndWarnsOfAFew) {
  const std::string weights = "time_s,jawOpen\n", first = weights + "0,0\n";
  put(in("none.csv"), weights);
  put(in("one.csv"), first);
  put(in("point.csv"), "time_s,a_x_mm,a_y_mm,a_z_mm\n0,0,0,0\n");
  for (const auto& [file, why] :
       {std::pair{"none.csv", "none.csv: fewer than two rows; expected a recording"},
        {"one.csv", "one.csv: fewer than two rows; expected a recording"},
        {"point.csv", "point.csv: has one sample, and nothing moves; expected two or more"}})
    expect_refused(std::string("new embedded ") + file + " --out a.toml", why);
  put(in("few.csv"), first + "0.5,0.5\n");
  const Outcome few = call("new embedded few.csv --out few.toml");
  EXPECT_EQ(few.status, 0);
  EXPECT_THAT(few.err, HasSubstr("warning: the recording has 2 samples in 0.5 s"));
  EXPECT_THAT(call("check few.toml").out,
              testing::AllOf(HasSubstr("warning: the recording has 2 samples"),
                             HasSubstr("but one warning")));
  // Keyframes are few by intention.
  put(in("keys.csv"), first + "0.3,0.5\n1,0\n");
  EXPECT_THAT(call("new embedded keys.csv --out keys.toml").err,
              testing::Not(HasSubstr("3 samples")));
  EXPECT_THAT(call("check keys.toml").out,
              testing::AllOf(HasSubstr("3 rows are taken for keyframes"),
                             HasSubstr("no problems found in what was checked\n")));
}

TEST_F(NewCommand, RefusesAPictureAsAMotionAsCheckAndRunDo) {
  cv::imwrite(in("grey.png").string(), cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(90)));
  const Outcome made = call("new face.ply grey.png --out a.toml");
  EXPECT_EQ(made.status, 2);
  EXPECT_THAT(made.err,
              HasSubstr("grey.png: is one picture, which has no motion; expected a video"));
  EXPECT_FALSE(std::filesystem::exists(in("a.toml")));
  for (const char* command : {"check scene.toml", "run scene.toml --out out"}) {
    const Outcome refused = call(std::string(command) + " --set motion.recording=grey.png");
    EXPECT_EQ(refused.status, 2) << command;
    EXPECT_THAT(problems_in(refused.err),
                testing::ElementsAre(HasSubstr(
                    "motion.recording = \"grey.png\": expected a video or a depth camera's "
                    "recording, as one picture has no motion")));
  }
}

TEST_F(NewCommand, RefusesAVideoThatCannotBeRead) {
  SKIP_WITHOUT_VIDEO();
  put(in("broken.mp4"), std::string(5000, '\x7f'));
  const Outcome made = call("new face.ply broken.mp4 --out a.toml");
  EXPECT_EQ(made.status, 2);
  EXPECT_THAT(problems_in(made.err),
              testing::ElementsAre(HasSubstr("broken.mp4: no video that can be read")));
  EXPECT_FALSE(std::filesystem::exists(in("a.toml")));
}

TEST_F(NewCommand, OverwritesNothingAndRefusesWhatIsNotThere) {
  put(in("face.toml"), "mine");
  const Outcome again = call("new face.ply motion.csv");
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(again.err, HasSubstr("face.toml: is there already"));
  EXPECT_EQ(read_file(in("face.toml")), "mine");
  const Outcome gone = call("new face.ply nowhere.csv --out a.toml");
  EXPECT_EQ(gone.status, 2);
  EXPECT_THAT(gone.err, HasSubstr("nowhere.csv: there is no such file; expected a recording"));
  const Outcome wrong = call("new motion.csv motion.csv --out a.toml");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_FALSE(std::filesystem::exists(in("a.toml")));
}

}  // namespace
}  // namespace hyperex
