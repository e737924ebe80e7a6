// SPDX-License-Identifier: GPL-3.0-or-later
// Studies, end to end: run, interrupted, continued, failing and refused.
#include <fcntl.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "apps/malformed.hpp"
#include "hyperex/io/text_table.hpp"

namespace hyperex {
namespace {
namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

class Sweep : public GoodInputs {
 protected:
  /// A coarse face that moves for a third of a second: the shortest possible case.
  void write_study(const std::string& rest) const {
    std::ofstream(in("base.toml"))
        << "scan = { file = \"embedded\" }\nmotion = { file = \"embedded\" }\n";
    std::ofstream(in("study.toml"))
        << "scene = \"base.toml\"\nout = \"out\"\n"
           "set = { mesh.element_size_mm = 9, motion.time_scale = 0.1, output.vtu = false, "
           "output.glb = false, output.report = false, output.picture_times_s = [0] }\n"
        << rest;
  }
  std::vector<std::string> column(const std::string& name) const {
    const io::TextTable table = io::read_text_table(in("out/study.csv"));
    const auto at = std::find(table.names.begin(), table.names.end(), name);
    std::vector<std::string> cells;
    for (const auto& row : table.rows)
      cells.push_back(at == table.names.end() ? "no column"
                                              : row[std::size_t(at - table.names.begin())]);
    return cells;
  }
  std::vector<std::string> folders() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(in("out/cases")))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }
};

TEST_F(Sweep, RunsEachCaseOnceAndMakesATable) {
  write_study("[grid]\ntissue.viscosity_pa_s = [0, 5000]\n");
  const Outcome first = call("sweep study.toml --jobs 2");
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_THAT(first.out, HasSubstr("2 cases: 2 finished, 0 failed, 0 not run\n"));
  EXPECT_THAT(first.err, HasSubstr("finished  viscosity_pa_s=5000 ("));
  EXPECT_THAT(first.err, HasSubstr("the driven points follow the recording whatever the tissue"));
  EXPECT_THAT(column("tissue.viscosity_pa_s"), ElementsAre("0", "5000"));
  EXPECT_THAT(column("state"), ElementsAre("finished", "finished"));
  // The measures are those of a run with the same override.
  const Outcome alone = call(
      "run base.toml --out alone --set mesh.element_size_mm=9 --set motion.time_scale=0.1 --set "
      "output.vtu=false --set output.glb=false --set output.report=false --set "
      "'output.picture_times_s=[0]' --set tissue.viscosity_pa_s=5000");
  ASSERT_EQ(alone.status, 0) << alone.err;
  const auto summary = nlohmann::ordered_json::parse(read_file(in("alone/summary.json")));
  EXPECT_EQ(column("max_displacement_mm")[1], summary["max_displacement_mm"].dump());
  EXPECT_EQ(column("symmetry.commissure.excursion_mm.L")[1],
            summary["symmetry"]["commissure"]["excursion_mm"]["L"].dump());
  EXPECT_EQ(read_file(in("alone/motion.csv")),
            read_file(in("out/" + column("folder")[1] + "/motion.csv")));
  EXPECT_NE(column("max_displacement_mm")[0], column("max_displacement_mm")[1]);

  // Finished cases are not run again; a new value runs alone.
  const auto folder = in("out/" + column("folder")[0]);
  const auto written = fs::last_write_time(folder / "summary.json");
  write_study("[grid]\ntissue.viscosity_pa_s = [0, 2500, 5000]\n");
  const Outcome second = call("sweep study.toml");
  EXPECT_EQ(second.status, 0) << second.err;
  EXPECT_THAT(second.out, HasSubstr("3 cases: 3 finished, 0 failed, 0 not run; 2 had been"));
  EXPECT_EQ(fs::last_write_time(folder / "summary.json"), written);
  EXPECT_THAT(column("tissue.viscosity_pa_s"), ElementsAre("0", "2500", "5000"));
}

TEST_F(Sweep, AChangedInputRunsItsCasesAgain) {
  write_study(
      "[[grid.motion]]\nname = \"own\"\nmotion.file = \"motion.csv\"\n"
      "time.end_s = 0.1\n[[grid.motion]]\nname = \"embedded\"\ntime.end_s = 0.1\n");
  ASSERT_EQ(call("sweep study.toml").status, 0);
  const auto before = folders();
  ASSERT_EQ(before.size(), 2u);
  std::ofstream(in("motion.csv"), std::ios::app) << "\n# a remark\n";
  const Outcome list = call("sweep study.toml --list");
  EXPECT_THAT(list.out, HasSubstr("1  not run "));
  EXPECT_THAT(list.out, HasSubstr("2  finished"));
  const Outcome again = call("sweep study.toml");
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr("; 1 had been finished before"));
  EXPECT_EQ(folders().size(), 3u) << "what was computed of the former input stays";
}

TEST_F(Sweep, OneThatFailsIsToldAndTheOthersRun) {
  write_study("[[grid.a]]\nname = \"sound\"\n[[grid.a]]\nname = \"broken\"\n");
  const Outcome listed = call("sweep study.toml --list");
  ASSERT_EQ(listed.status, 0) << listed.err;
  // The inputs are valid, but a file of the user is in the case's folder.
  const std::string hash = listed.out.substr(listed.out.find("2  not run ") + 13, 10);
  const std::string folder = "out/cases/broken-" + hash;
  fs::create_directories(in(folder));
  std::ofstream(in(folder + "/notes.txt")) << "mine";
  const Outcome found = call("sweep study.toml --jobs 1");
  EXPECT_EQ(found.status, 1);
  EXPECT_THAT(found.out, HasSubstr("2 cases: 1 finished, 1 failed, 0 not run"));
  const auto problems = problems_in(found.err);
  ASSERT_EQ(problems.size(), 2u) << found.err;
  EXPECT_THAT(problems[0], HasSubstr("1 case did not finish"));
  EXPECT_THAT(problems[1], HasSubstr("broken failed: "));
  EXPECT_THAT(problems[1], HasSubstr("holds notes.txt"));
  EXPECT_THAT(problems[1], HasSubstr("out/logs/broken-" + hash + ".log"));
  EXPECT_THAT(column("state"), ElementsAre("finished", "failed"));
  EXPECT_THAT(column("message")[1], HasSubstr("holds notes.txt"));
  EXPECT_EQ(read_file(in(folder + "/notes.txt")), "mine");
  // The file is removed: the case runs, and no other.
  fs::remove(in(folder + "/notes.txt"));
  EXPECT_EQ(call("sweep study.toml").status, 0);
  EXPECT_THAT(column("state"), ElementsAre("finished", "finished"));
}

TEST_F(Sweep, TwoAtOnceIntoOneFolderBothEndWell) {
  write_study("[grid]\ntissue.viscosity_pa_s = [0, 5000]\n");
  EXPECT_EQ(shell("{ $HYPEREX sweep study.toml --jobs 1 > ../one.txt 2>&1 & } ; "
                  "$HYPEREX sweep study.toml --jobs 1 > ../two.txt 2>&1; two=$?; wait $!; "
                  "echo $? $two > ../both.txt"),
            0);
  EXPECT_EQ(read_file(in("../both.txt")), "0 0\n")
      << read_file(in("../one.txt")) << read_file(in("../two.txt"));
  EXPECT_THAT(column("state"), ElementsAre("finished", "finished"));
}

TEST_F(Sweep, SingleCasesAndTheirTable) {
  write_study("[grid]\ntissue.viscosity_pa_s = [0, 5000]\n");
  const Outcome one = call("sweep study.toml --case 2");
  ASSERT_EQ(one.status, 0) << one.err;
  EXPECT_FALSE(fs::exists(in("out/study.csv")));
  ASSERT_EQ(folders().size(), 1u);
  EXPECT_TRUE(folders()[0].starts_with("viscosity_pa_s_5000-"));
  EXPECT_THAT(call("sweep study.toml --case 2").err, HasSubstr("finished before: "));
  EXPECT_EQ(call("sweep study.toml --case " + folders()[0]).status, 0);
  EXPECT_EQ(call("sweep study.toml --case viscosity_pa_s=5000").status, 0);
  for (const char* wrong : {"0", "3", "viscosity_pa_s=1", "2x"}) {
    const Outcome refused = call(std::string("sweep study.toml --case ") + wrong);
    EXPECT_EQ(refused.status, 2);
    EXPECT_THAT(refused.err, HasSubstr("expected a number from 1 to 2 or a name of a case"));
  }
  const Outcome table = call("sweep study.toml --collect");
  EXPECT_EQ(table.status, 0) << table.err;
  EXPECT_THAT(column("state"), ElementsAre("not run", "finished"));
}

TEST_F(Sweep, BadInputIsRefusedBeforeTheFirstRuns) {
  struct Bad {
    const char *study, *said;
  };
  for (const Bad& bad :
       {Bad{"[grid]\ntissue.young_kpa = [30, -1]\n",
            "study.toml:5: tissue.young_kpa = -1: expected a number from"},
        Bad{"[grid]\ntissue.yung_kpa = [30]\n",
            "study.toml:5: grid.tissue.yung_kpa: expected a "
            "known key (did you mean tissue.young_kpa?)"},
        Bad{"[grid]\nscan.file = [\"embedded\", \"gone.ply\"]\n",
            "study.toml:5: scan.file = \"gone.ply\": expected"},
        // Detected only where the files that the scene names are read.
        Bad{"[grid]\ntissue.young_kpa = [1, 2, 3]\ndrive.points = [[\"nobody\"]]\n",
            "study.toml:6: drive.points = [\"nobody\"]: expected names of points in the "
            "recording"}}) {
    write_study(bad.study);
    const auto before = names_in(in(""));
    const Outcome refused = call("sweep study.toml");
    EXPECT_EQ(refused.status, 2);
    const auto problems = problems_in(refused.err);
    ASSERT_EQ(problems.size(), 1u) << refused.err;
    EXPECT_THAT(problems[0], HasSubstr(bad.said));
    EXPECT_EQ(names_in(in("")), before);
  }
  write_study("[grid]\ntissue.young_kpa = [30]\n");
  fs::create_directory(in("out"));
  std::ofstream(in("out/thesis.tex")) << "mine";
  const Outcome refused = call("sweep study.toml");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("out: holds thesis.tex, which no sweep wrote"));
  EXPECT_EQ(names_in(in("out")).size(), 1u);
}

class SweepInterrupted : public Sweep {
 protected:
  pid_t start() const {
    const std::string study = in("study.toml"), err = in("err.txt");
    const pid_t program = ::fork();
    if (program == 0) {
      const int to = ::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
      ::dup2(to, 1);
      ::dup2(to, 2);
      std::signal(SIGINT, SIG_DFL);  // ignored where the tests run in the background of a shell
      ::execl(HYPEREX_PROGRAM, HYPEREX_PROGRAM, "sweep", study.c_str(), "--jobs", "1", nullptr);
      ::_exit(127);
    }
    return program;
  }
  /// A folder under a temporary name, while a case is running.
  fs::path half_written() const {
    std::error_code error;
    for (fs::directory_iterator at(in("out/cases"), error), end; !error && at != end;
         at.increment(error))
      if (at->path().filename().string().starts_with(".")) return at->path();
    return {};
  }
  bool wait_for(const std::function<bool()>& what) const {
    for (int tries = 0; tries < 6000 && !what(); ++tries)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return what();
  }
};

TEST_F(SweepInterrupted, GoesOnWhereItWas) {
  // The second would take minutes.
  write_study(
      "[[grid.a]]\nname = \"short\"\n[[grid.a]]\nname = \"long\"\n"
      "time.step_s = 3.1e-4\ntime.end_s = 600\n");
  for (const int signal : {SIGINT, SIGTERM}) {
    const pid_t program = start();
    ASSERT_TRUE(wait_for([&] {
      const fs::path path = half_written();
      return path.filename().string().starts_with(".long");
    })) << read_file(in("err.txt"));
    ::kill(program, signal);
    int status = 0;
    ::waitpid(program, &status, 0);
    EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : 0, 128 + signal);
    const std::string said = read_file(in("err.txt"));
    EXPECT_THAT(said, HasSubstr("1 of 2 cases finished; the same command goes on with the others"));
    EXPECT_THAT(said, HasSubstr("hyperex: interrupted"));
    EXPECT_EQ(half_written(), fs::path()) << "its run was ended and has tidied up";
    EXPECT_THAT(column("state"), ElementsAre("finished", "not run"));
    ASSERT_EQ(folders().size(), 1u);
  }
  const auto written = fs::last_write_time(in("out/cases/" + folders()[0] + "/summary.json"));
  write_study(
      "[[grid.a]]\nname = \"short\"\n[[grid.a]]\nname = \"long\"\n"
      "time.step_s = 3.1e-3\n");
  const Outcome rest = call("sweep study.toml");
  EXPECT_EQ(rest.status, 0) << rest.err;
  EXPECT_THAT(rest.out, HasSubstr("2 cases: 2 finished, 0 failed, 0 not run; 1 had been"));
  EXPECT_EQ(fs::last_write_time(in("out/" + column("folder")[0] + "/summary.json")), written);
}

TEST_F(SweepInterrupted, AKilledSweepTakesItsRunsAlong) {
  write_study("[[grid.a]]\nname = \"long\"\ntime.step_s = 3.1e-4\ntime.end_s = 600\n");
  const pid_t program = start();
  ASSERT_TRUE(wait_for([&] { return !half_written().empty(); })) << read_file(in("err.txt"));
  ::kill(program, SIGKILL);
  ::waitpid(program, nullptr, 0);
  EXPECT_TRUE(wait_for([&] { return half_written().empty(); }));
  EXPECT_TRUE(wait_for(
      [&] { return call("sweep study.toml --list").out.find("not run") != std::string::npos; }));
}

/// The study of docs/studies.md, which is examples/study.toml without its comments.
TEST_F(Sweep, ThePagesExampleRuns) {
  const std::string page = read_file(HYPEREX_SOURCE_DIR "/docs/studies.md"), fence = "```toml\n";
  const auto begin = page.find(fence) + fence.size();
  fs::create_directory(in("examples"));
  fs::copy_file(HYPEREX_SOURCE_DIR "/examples/mouth_open.toml", in("examples/mouth_open.toml"));
  std::ofstream(in("examples/study.toml")) << page.substr(begin, page.find("```", begin) - begin);
  const Outcome found = call("sweep examples/study.toml");
  ASSERT_EQ(found.status, 0) << found.err;
  const Outcome listed =
      call("sweep '" HYPEREX_SOURCE_DIR "/examples/study.toml' --list --out out/study");
  EXPECT_EQ(listed.status, 0) << listed.err;
  for (const char* line :
       {"    1  finished", "    2  finished", "    3  finished", "    4  finished"})
    EXPECT_THAT(listed.out, HasSubstr(line)) << "the same hashes in another folder";
  // A stiff right cheek restrains the right side, as the page's Python code would show.
  const io::TextTable table = io::read_text_table(in("out/study/study.csv"));
  const auto cell = [&](std::size_t row, const std::string& name) {
    const auto at = std::find(table.names.begin(), table.names.end(), name);
    EXPECT_NE(at, table.names.end()) << name;
    return table.rows[row].at(std::size_t(at - table.names.begin()));
  };
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_EQ(cell(1, "cheeks"), "right stiff");
  const std::string right = "symmetry.excursions.cheek.excursion_mm.R";
  EXPECT_NE(cell(0, right), cell(1, right));
  for (const char* name :
       {"symmetry.commissure.excursion_mm.L", "symmetry.commissure.floor_mm", "seconds.total"})
    EXPECT_GT(std::stod(cell(3, name)), 0) << name;
}

TEST_F(Sweep, ExampleAndHelp) {
  const Outcome help = call("sweep --help");
  EXPECT_EQ(help.status, 0);
  EXPECT_THAT(help.out, HasSubstr("Example: hyperex sweep examples/study.toml"));
  const Outcome listed = call("sweep '" HYPEREX_SOURCE_DIR "/examples/study.toml' --list --out o");
  EXPECT_EQ(listed.status, 0) << listed.err;
  EXPECT_THAT(listed.out, HasSubstr("    4  not run "));
  EXPECT_EQ(call("sweep study.toml --list --slurm").status, 2);
  EXPECT_EQ(call("sweep").status, 2);
}

}  // namespace
}  // namespace hyperex
