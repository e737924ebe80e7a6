// SPDX-License-Identifier: GPL-3.0-or-later
// Inputs that can be read but do not fit together are refused or cause a warning (warnings_test.cpp
// covers every warning).
#include <gmock/gmock.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "apps/good_inputs.hpp"
#include "apps/program.hpp"

namespace hyperex {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

void add_noise(motion::Motion& m) {
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0, 0.2e-3);
  for (auto& sample : m.positions)
    for (double& x : sample.reshaped()) x += noise(generator);
}

/// The mesh of these inputs is so coarse that the program warns of it.
constexpr const char* kCheckFine = "check scene.toml --set mesh.element_size_mm=5";

class Plausible : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_good_inputs(in(""));
  }

  void write_motion(
      std::size_t first, std::size_t count,
      const std::function<void(motion::Motion&)>& change = [](motion::Motion&) {}) const {
    write_opening(in(""), first, count, change);
  }
};

TEST_F(Plausible, GoodInputsGiveNoWarning) {
  const Outcome checked = call(kCheckFine);
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_THAT(checked.out, Not(HasSubstr("warning")));
}

TEST_F(Plausible, CheckCountsWarnings) {
  io::Landmarks landmarks = good_landmarks();
  landmarks["cheilion_R"] = landmarks["cheek_R"];
  io::write_landmarks(in("face_landmarks.json"), landmarks, io::LengthUnit::millimetre);
  const Outcome checked = call(kCheckFine);
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_THAT(checked.out,
              AllOf(HasSubstr("warning: landmark cheilion_R"), HasSubstr("one warning")));
}

TEST_F(Plausible, AStartInAnExpressionIsMendedAsAdvised) {
  write_motion(40, 41);  // from the widest opening to the end
  const Outcome checked = call("check scene.toml");
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_THAT(checked.out, HasSubstr("motion.rest_s = [1.0"));
  // The advice is correct: with it the face starts at rest, moves to the opening and comes back.
  const Outcome mended = call(
      "run scene.toml --out out --set motion.rest_s=[1.2,1.33] --set time.end_s=0.6"
      " --set time.frame_rate_hz=30");
  EXPECT_EQ(mended.status, 0) << mended.err;
  EXPECT_EQ(text_of("recording.starts_in_expression"), "");
  EXPECT_THAT(text_of("recording.lead_in"), HasSubstr("0.5 s"));
  EXPECT_NEAR(summary()["peak_time_s"].get<double>(), 0.5, 0.05);
  EXPECT_GT(summary()["lip_opening_mm"].get<double>(), 5);
  EXPECT_EQ(call("check scene.toml --set motion.rest_s=40").status, 2);
}

TEST_F(Plausible, SymmetrySaysWhereARecordingStartsOrEndsInAnExpression) {
  const auto said = [&](std::size_t first, std::size_t count) {
    write_motion(first, count);
    const Outcome outcome = call("symmetry motion.csv");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.err;
  };
  EXPECT_THAT(said(0, 81), Not(HasSubstr("in an expression")));
  EXPECT_THAT(said(0, 22), HasSubstr("the recording ends in an expression"));
  EXPECT_THAT(said(40, 41), AllOf(HasSubstr("seems to start in an expression"),
                                  HasSubstr("so give a recording that begins at rest")));
}

TEST_F(Plausible, ExchangedSidesOfARecordingAreRefused) {
  write_motion(0, 16, [](motion::Motion& m) {
    for (auto& sample : m.positions) sample.col(0) *= -1;
  });
  const Outcome checked = call("check scene.toml");
  EXPECT_EQ(checked.status, 2);
  EXPECT_THAT(checked.err, AllOf(HasSubstr("motion.csv: left and right are exchanged"),
                                 HasSubstr("mm rms from those of the same names on the scan")));
}

TEST_F(Plausible, ExchangedSidesAreRefusedWithoutLandmarksToo) {
  replace_in(in("scene.toml"), "landmarks = \"face_landmarks.json\"\n", "");
  write_motion(0, 16, [](motion::Motion& m) {
    for (auto& sample : m.positions) sample.col(0) *= -1;
  });
  const Outcome exchanged = call("check scene.toml");
  EXPECT_EQ(exchanged.status, 2);
  EXPECT_THAT(exchanged.err, HasSubstr("motion.csv: left and right are exchanged"));
}

TEST_F(Plausible, TheSummaryHasTheJitterThatTheRecordingShows) {
  write_motion(0, 81, add_noise);
  const Outcome run = call("run scene.toml --out out");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NEAR(summary()["symmetry"]["jitter_mm"].get<double>(), 0.2, 0.03);
  EXPECT_THAT(text_of("recording.jitter"), HasSubstr(" mm"));
}

TEST_F(Plausible, SymmetryJudgesByTheJitterThatTheRecordingShows) {
  const std::string quiet = "symmetry motion.csv --keep-head --out s.csv";
  write_motion(0, 81, add_noise);
  const Outcome noisy = call(quiet);
  EXPECT_THAT(noisy.out, HasSubstr("estimated from their fourth differences in time: 0.2"));
  EXPECT_THAT(noisy.out, HasSubstr("\nundecided: within what jitter"));
  EXPECT_THAT(call(quiet + " --jitter-mm 0").out, HasSubstr("taken as exact, as --jitter-mm 0"));
  EXPECT_THAT(call(quiet + " --jitter-mm 0.3").out, HasSubstr("as --jitter-mm states it: 0.30 mm"));
  EXPECT_THAT(noisy.out, Not(HasSubstr("repetition: ")));
  EXPECT_THAT(call(quiet + " --jitter-mm 0 --repetition-mm 1.5 --excursions repeated.csv").out,
              HasSubstr("repetition: differences of excursions below 1.5 mm are undecided"));
  EXPECT_THAT(read_file(in("repeated.csv")), HasSubstr(",1.5,1.5,0,")) << "floor, undecided";
  // The run's folder states the jitter that the run used.
  std::filesystem::create_directory(in("ran"));
  std::filesystem::copy_file(in("motion.csv"), in("ran/motion.csv"));
  put(in("ran/summary.json"), R"({"symmetry": {"jitter_mm": 0.17}})");
  EXPECT_THAT(call("symmetry ran --keep-head --out s.csv").out,
              HasSubstr("from the run's summary.json: 0.17 mm"));
  write_motion(0, 12);
  const Outcome short_one = call(quiet);
  EXPECT_THAT(short_one.err, AllOf(HasSubstr("warning: "), HasSubstr("too short"),
                                   HasSubstr("jitter; how much of a difference")));
  EXPECT_THAT(short_one.out, Not(HasSubstr("too short"))) << "it is said once";
}

TEST_F(Plausible, SymmetryDecidesNothingWhereNoiseIsNotKnown) {
  write_motion(0, 16, [](motion::Motion& m) {
    for (const char* name : {"cheilion_L", "ibug68_54"})
      for (std::size_t k = 0; k < m.positions.size(); ++k)
        m.positions[k](m.index_of(name), 0) += 10e-3 * double(k) / 15;
  });
  const auto decided = [&](const std::string& options) {
    const Outcome found = call("symmetry motion.csv --excursions e.csv" + options);
    EXPECT_EQ(found.status, 0) << found.err;
    const std::string text = read_file(in("e.csv")), row = text.substr(text.find("\ncheilion,"));
    return row.substr(1, row.find('\n', 1) - 1) + " " + found.out;
  };
  EXPECT_THAT(decided(""), AllOf(HasSubstr(",,,,, "), HasSubstr("  cannot tell\n"),
                                 HasSubstr("cannot tell: the jitter of the points is not known "
                                           "and may make such a difference\n")));
  EXPECT_THAT(decided(" --jitter-mm 0"),
              AllOf(HasSubstr(",1,0,0,1,1,1 "), Not(HasSubstr("cannot tell"))));
  EXPECT_THAT(decided(" --jitter-mm 0 --keep-head"),
              AllOf(HasSubstr(",,0,0,,, "), HasSubstr("cannot tell: the head's motion is in the "
                                                      "points and may make such a difference\n")));
  EXPECT_THAT(decided(" --keep-head"), HasSubstr("is not known, and both may make such"));
}

TEST_F(Plausible, SymmetryWarnsOfMillisecondsAndRefusesAPairExchanged) {
  const std::string symmetry = "symmetry motion.csv --keep-head --out s.csv";
  write_motion(0, 16, [](motion::Motion& m) {
    for (double& t : m.time_s) t *= 1000;
  });
  EXPECT_THAT(call(symmetry).err, AllOf(HasSubstr("warning: "), HasSubstr("500 s")));
  write_motion(0, 16, [](motion::Motion& m) {
    std::swap(m.names[std::size_t(m.index_of("cheilion_L"))],
              m.names[std::size_t(m.index_of("cheilion_R"))]);
  });
  const Outcome exchanged = call(symmetry);
  EXPECT_NE(exchanged.status, 0);
  EXPECT_THAT(exchanged.err, HasSubstr("exchanged in cheilion_L and cheilion_R"));
}

TEST_F(Plausible, SymmetryMendsAReadingThatJumpsAndNamesThoseThatStayAway) {
  write_motion(0, 16);
  const Outcome sound = call("symmetry motion.csv --jitter-mm 0 --excursions sound.csv");
  ASSERT_EQ(sound.status, 0) << sound.err;
  const auto off_by = [&](double off_m, std::size_t last) {
    write_motion(0, 16, [&](motion::Motion& m) {
      for (std::size_t k = 8; k <= last; ++k) m.positions[k](m.index_of("cheilion_L"), 2) += off_m;
    });
  };
  for (const std::string keep : {"", " --keep-head"}) {
    off_by(0.3, 8);
    const Outcome mended = call("symmetry motion.csv --jitter-mm 0 --excursions e.csv" + keep);
    EXPECT_EQ(mended.status, 0) << mended.err;
    EXPECT_THAT(mended.err, AllOf(HasSubstr("warning: a point jumps away and back"),
                                  HasSubstr("motion.csv:10, point cheilion_L at 0.267 s")));
    off_by(0.05, 14);
    const Outcome away = call("symmetry motion.csv --jitter-mm 0 --out s.csv" + keep);
    EXPECT_EQ(away.status, 0) << away.err;
    EXPECT_THAT(away.err, AllOf(HasSubstr("warning: a point jumps between two readings"),
                                HasSubstr("motion.csv:10, point cheilion_L at 0.267 s")));
  }
  // What was mended moves the corner as far as the sound recording does.
  off_by(0.3, 8);
  call("symmetry motion.csv --jitter-mm 0 --excursions mended.csv");
  const auto excursion_mm = [&](const char* file) {
    const std::string text = read_file(in(file));
    const auto row = text.find("\ncheilion,");
    return row == std::string::npos ? -1 : std::stod(text.substr(row + 10));
  };
  EXPECT_GT(excursion_mm("sound.csv"), 1);
  EXPECT_NEAR(excursion_mm("mended.csv"), excursion_mm("sound.csv"), 0.5);
}

TEST_F(Plausible, SymmetryLeavesOutAWildReadingAtTheEnd) {
  write_motion(0, 16,
               [](motion::Motion& m) { m.positions[15](m.index_of("cheilion_L"), 2) += 0.012; });
  const Outcome mended = call("symmetry motion.csv --jitter-mm 0 --excursions e.csv");
  EXPECT_EQ(mended.status, 0) << mended.err;
  EXPECT_THAT(mended.err, AllOf(HasSubstr("1 such reading was left out"),
                                HasSubstr("motion.csv:17, point cheilion_L at 0.5")));
}

TEST_F(Plausible, SymmetrySaysTheUnitItGuessedAndWhatNoFaceMeasures) {
  const auto scaled = [&](double scale) {
    write_motion(0, 16, [&](motion::Motion& m) {
      keep_mouth_and_headband(m);
      for (Points& sample : m.positions) sample *= scale;
    });
  };
  const std::string symmetry = "symmetry motion.csv --jitter-mm 0";
  scaled(1);
  const Outcome sound = call(symmetry);
  EXPECT_THAT(sound.err, AllOf(Not(HasSubstr("guessed")), Not(HasSubstr("size of a face"))));
  EXPECT_THAT(sound.out, Not(HasSubstr("doubtful")));
  scaled(0.1);
  const Outcome small = call(symmetry);
  EXPECT_THAT(small.err, AllOf(HasSubstr("warning: the recording has not the size of a face"),
                               HasSubstr("as if in cm, and were read as mm")));
  EXPECT_THAT(small.out,
              ContainsRegex("a difference of [^\n]*; doubtful, see the warning above\n"));
  scaled(1 / 25.4);  // inches, without a unit in the names
  std::string table = read_file(in("motion.csv"));
  for (auto at = table.find("_mm"); at != std::string::npos; at = table.find("_mm"))
    table.erase(at, 3);
  put(in("motion.csv"), table);
  EXPECT_THAT(call(symmetry).err,
              AllOf(HasSubstr("motion: cm (guessed: the points then span"),
                    HasSubstr("--unit states it"), HasSubstr("as if in inches")));
}

TEST_F(Plausible, SymmetrySaysThatNothingMovesAsCheckDoes) {
  const std::string still = "warning: nothing moves in the recording";
  EXPECT_THAT(call("symmetry motion.csv").err, Not(HasSubstr(still)));
  write_motion(0, 16, [](motion::Motion& m) {
    for (Points& sample : m.positions) sample = Points(m.positions.front());
  });
  EXPECT_THAT(call(kCheckFine).out, HasSubstr(still));
  for (const std::string keep : {"", " --keep-head"})
    EXPECT_THAT(call("symmetry motion.csv" + keep).err, HasSubstr(still));
  EXPECT_THAT(call("symmetry motion.csv").out, HasSubstr("; doubtful, see the warning above\n"));
}

TEST_F(Plausible, SymmetryRefusesExchangedSidesAsCheckDoes) {
  write_motion(0, 16, [](motion::Motion& m) {
    keep_mouth_and_headband(m);
    for (const auto& [a, b] : {std::pair{"ibug68_48", "ibug68_54"}, {"ibug68_58", "ibug68_56"}})
      std::swap(m.names[std::size_t(m.index_of(a))], m.names[std::size_t(m.index_of(b))]);
  });
  const Outcome exchanged = call("symmetry motion.csv --out s.csv");
  EXPECT_EQ(exchanged.status, 2);
  EXPECT_THAT(exchanged.err, HasSubstr("motion.csv: left and right are exchanged"));
  EXPECT_FALSE(fs::exists(in("s.csv")));
}

TEST_F(Plausible, SymmetryRefusesWhatNoFaceCanReachWithTheHeadToo) {
  for (const double off_m : {0.3, 1e3}) {
    write_motion(0, 16, [&](motion::Motion& m) {
      for (std::size_t k = 8; k < 16; ++k) m.positions[k](m.index_of("cheilion_L"), 2) += off_m;
    });
    for (const std::string keep : {"", " --keep-head"}) {
      const Outcome far = call("symmetry motion.csv --out s.csv" + keep);
      EXPECT_EQ(far.status, 2) << off_m << keep;
      EXPECT_THAT(far.err, HasSubstr(off_m > 1 ? "the points span 1e+06 mm"
                                               : "motion.csv:10, point cheilion_L at 0.267 s"));
      EXPECT_FALSE(fs::exists(in("s.csv")));
    }
  }
}

TEST_F(Plausible, TheDifferenceOfTheCornersIsJudgedAloud) {
  const Outcome alike = call("run scene.toml --out alike");
  EXPECT_THAT(alike.out, ContainsRegex("a difference of 0\\.[0-9]+ mm: undecided, below the floor "
                                       "of 0\\.1[0-9]* mm \\(mesh\\)"));
  write_motion(0, 16, [](motion::Motion& m) {
    for (const char* name : {"cheilion_L", "ibug68_54"})
      for (std::size_t k = 0; k < m.positions.size(); ++k)
        m.positions[k](m.index_of(name), 0) += 4e-3 * double(k) / 15;
  });
  // A short recording, whose jitter is not known.
  const std::string unknown = ", but the recording cannot tell, as its jitter is not known\n";
  EXPECT_THAT(call("run scene.toml --out unknown").out, HasSubstr(unknown));
  EXPECT_THAT(call("symmetry unknown").err, HasSubstr("summary.json says that the jitter"));
  const Outcome apart = call("run scene.toml --out apart --set output.jitter_mm=0");
  EXPECT_THAT(apart.out, Not(HasSubstr(unknown)));
  EXPECT_THAT(apart.out, ContainsRegex("a difference of [0-9.]+ mm: more than the floor of [0-9.]+ "
                                       "mm \\((mesh|jitter|head pose)\\)"));
}

TEST_F(Plausible, PointsThatMayMoveWithTheSkullAreAskedForByName) {
  write_motion(0, 16, [](motion::Motion& m) {
    for (auto& name : m.names) name = "marker_" + name;
  });
  const Outcome checked = call("check scene.toml");
  EXPECT_EQ(checked.status, 2);
  EXPECT_THAT(checked.err,
              AllOf(HasSubstr("the motion has 0 of them. motion.rigid_points names others"),
                    HasSubstr("as points of the skull do: marker_"), HasSubstr(" more")));
}

TEST_F(Plausible, AFileWithoutPaintFailsInCheckAsInRun) {
  io::VertexColours white(good_face().points.rows(), 4);
  white.setConstant(255);
  io::write_ply(in("white.ply"), good_face(), io::LengthUnit::millimetre, {}, white);
  const std::string paint = " --set 'tissue.region=[{painted = \"white.ply\", young_factor = 2}]'";
  for (const std::string command : {"check scene.toml", "run scene.toml --out out"}) {
    const Outcome outcome = call(command + paint);
    EXPECT_EQ(outcome.status, 2) << command;
    EXPECT_THAT(outcome.err, HasSubstr("white.ply: nothing is painted red")) << command;
  }
}

TEST_F(Plausible, TheWarningOnTheSkinAndTheSummarySayOneNumber) {
  put(in("coarse.toml"),
      "scan.file = \"embedded\"\nmotion.file = \"embedded\"\nmesh.element_size_mm = 15\n"
      "mesh.layers = 1\ntime = { step_s = 0.01, end_s = 0.2, frame_rate_hz = 10 }\n");
  const Outcome run = call("run coarse.toml --out out");
  EXPECT_EQ(run.status, 0) << run.err;
  const std::string text = text_of("skin.far_from_scan"), before = "up to ";
  const auto at = text.find(before);
  ASSERT_NE(at, std::string::npos) << text;
  EXPECT_NEAR(std::stod(text.substr(at + before.size())),
              summary()["mesh_quality"]["skin_to_scan_face_max_mm"].get<double>(), 0.051);
}

TEST_F(Plausible, ARunWithoutMotionIsRefused) {
  const Outcome brief = call("check scene.toml --set time.end_s=0.05");
  EXPECT_EQ(brief.status, 2);
  EXPECT_THAT(brief.err, AllOf(HasSubstr("time.end_s = 0.05"), HasSubstr("at least 0.1 s")));
  write_motion(0, 1);
  const Outcome single = call("check scene.toml");
  EXPECT_EQ(single.status, 2);
  EXPECT_THAT(single.err, HasSubstr("motion.csv: has one sample"));
}

TEST_F(Plausible, TheMotionIsReadBeforeLandmarksAreSearched) {
  TriMesh sheet = good_face();
  sheet.points.col(2) *= 0.02;  // no face is found on it
  write_mm(in("face.ply"), sheet);
  replace_in(in("scene.toml"), "landmarks = \"face_landmarks.json\"\n", "");
  put(in("motion.csv"), "");
  const Outcome run = call("run scene.toml --out out");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, AllOf(HasSubstr("motion.csv"), Not(HasSubstr("no face was found"))));
}

TEST_F(Plausible, OnlyACamerasPicturesAreTurnedBack) {
  const Outcome checked = call("check scene.toml --set motion.mirrored=true");
  EXPECT_EQ(checked.status, 2);
  EXPECT_THAT(checked.err,
              AllOf(HasSubstr("motion.mirrored = true"), HasSubstr("no motion.recording")));
}

}  // namespace
}  // namespace hyperex
