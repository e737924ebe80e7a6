// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/study/run_cases.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/file.h>

#include <map>

#include "hyperex/study/study_folder.hpp"
#include "unit/study/study_files.hpp"

namespace hyperex::study {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

/// A script replaces hyperex: `run SCENE --out FOLDER --set title="BEHAVIOUR"`.
class RunCases : public StudyFiles {
 protected:
  void SetUp() override {
    StudyFiles::SetUp();
    program_ = write(
        "program.sh",
        "#!/bin/bash\n"
        "count() { (\n"
        "  flock 9; n=$(cat " +
            (*this / "now").string() +
            " 2> /dev/null || echo 0)\n"
            "  n=$((n $1)); echo $n > " +
            (*this / "now").string() +
            "\n"
            "  echo $n >> " +
            (*this / "most").string() + ") 9> " + (*this / "lock").string() +
            "; }\n"
            "count +1\n"
            "echo \"in $PWD: $*\"\n"
            "case \"$6\" in\n"
            "  *fail*) echo 'hyperex: no luck' >&2; echo 'hyperex: none at all' >&2; exit 1 ;;\n"
            "  *killed*) kill -9 $$ ;;\n"
            "  *half*) mkdir -p \"$4\"; exit 0 ;;\n"
            "  *wait*) trap 'touch " +
            (*this / "ended").string() + "; exit 143' TERM; touch " + (*this / "begun").string() +
            "; while true; do sleep 0.05; done ;;\n"
            "  *slow*) sleep 0.3 ;;\n"
            "esac\n"
            "mkdir -p \"$4\" && echo '{}' > \"$4/summary.json\"\n"
            "count -1\n");
    fs::permissions(program_, fs::perms::owner_all);
  }

  Study titled(const std::string& titles) {
    Study s = study("[grid]\ntitle = [" + titles + "]\n");
    make_study_folder(s.out);
    return s;
  }
  std::map<std::string, Outcome> run(const Study& s, int jobs, std::function<bool()> stop = {}) {
    const auto planned = plan_cases(s);
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < planned.size(); ++i) all.push_back(i);
    std::map<std::string, Outcome> outcomes;
    RunOptions options;
    options.program = program_;
    options.jobs = jobs;
    options.stop = std::move(stop);
    options.ended = [&](std::size_t i, const Outcome& outcome) {
      outcomes[s.cases[i].name] = outcome;
    };
    run_cases(s, planned, all, options);
    return outcomes;
  }

  fs::path program_;
};

TEST_F(RunCases, OneThatFailsStopsNoOther) {
  const Study s = titled("\"fail\", \"good\", \"killed\", \"half\"");
  const auto outcomes = run(s, 2);
  ASSERT_EQ(outcomes.size(), 4u);
  EXPECT_EQ(outcomes.at("title=good").state, State::finished);
  EXPECT_EQ(outcomes.at("title=fail").state, State::failed);
  EXPECT_EQ(outcomes.at("title=fail").message, "no luck; none at all");
  EXPECT_EQ(outcomes.at("title=killed").message, "ended by signal 9 (Killed)");
  EXPECT_EQ(outcomes.at("title=half").state, State::failed) << "without a summary none is finished";

  const auto planned = plan_cases(s);
  EXPECT_EQ(state_of(planned[0].files), State::failed);
  EXPECT_EQ(state_of(planned[1].files), State::finished);
  const std::string log = read(planned[1].files.log);
  EXPECT_THAT(log, HasSubstr("$ cd " + folder().string() + " && " + program_.string() + " run "));
  EXPECT_THAT(log, HasSubstr("in " + fs::canonical(folder()).string() + ": run"));
  EXPECT_THAT(log, HasSubstr("\nhyperex sweep: finished in "));
}

TEST_F(RunCases, AreSoManyAtOnceAndNoMore) {
  const auto outcomes =
      run(titled("\"slow1\", \"slow2\", \"slow3\", \"slow4\", \"slow5\", \"slow6\""), 3);
  EXPECT_EQ(outcomes.size(), 6u);
  std::istringstream lines(read(*this / "most"));
  int most = 0;
  for (int n = 0; lines >> n;) most = std::max(most, n);
  EXPECT_EQ(most, 3);
}

TEST_F(RunCases, StoppedOnesAreEndedAndNotRun) {
  const Study s = titled("\"wait\", \"good\"");
  const auto outcomes = run(s, 1, [&] { return fs::exists(*this / "begun"); });
  EXPECT_TRUE(fs::exists(*this / "ended")) << "the process was told, and waited for";
  EXPECT_EQ(outcomes.at("title=wait").state, State::not_run);
  EXPECT_EQ(outcomes.count("title=good"), 0u);
  EXPECT_EQ(state_of(plan_cases(s)[0].files), State::not_run);
  EXPECT_THAT(read(plan_cases(s)[0].files.log), HasSubstr("interrupted"));
}

TEST_F(RunCases, OneThatAnotherProcessRunsIsLeftAlone) {
  const Study s = titled("\"good\"");
  const CaseFiles files = plan_cases(s)[0].files;
  const int other = ::open(files.log.c_str(), O_RDWR | O_CREAT, 0600);
  ASSERT_EQ(::flock(other, LOCK_EX), 0);
  EXPECT_EQ(state_of(files), State::running);
  EXPECT_EQ(run(s, 1).at("title=good").state, State::running);
  EXPECT_FALSE(fs::exists(files.folder));
  ::close(other);
  EXPECT_EQ(state_of(files), State::not_run);
  EXPECT_EQ(run(s, 1).at("title=good").state, State::finished);
}

TEST_F(RunCases, FilesOfTheUsersAreNoLogs) {
  const Study s = titled("\"good\"");
  const CaseFiles files = plan_cases(s)[0].files;
  write("study_out/logs/" + files.log.filename().string(), "my notes\n");
  EXPECT_THAT(refusal([&] { run(s, 1); }), HasSubstr("is no log of a case"));
  EXPECT_EQ(read(files.log), "my notes\n");
  fs::remove(files.log);
  write("elsewhere.txt", "$ mine\n");
  fs::create_symlink(*this / "elsewhere.txt", files.log);
  EXPECT_THAT(refusal([&] { run(s, 1); }), HasSubstr("cannot be written"));
  EXPECT_EQ(read(*this / "elsewhere.txt"), "$ mine\n");
}

TEST_F(RunCases, ProcessorsAreShared) {
  const std::vector<int> all = own_processors();
  ASSERT_FALSE(all.empty());
  EXPECT_GE(default_jobs(), 1);
  EXPECT_LE(default_jobs(), int(all.size()));
  write("program.sh",
        "#!/bin/bash\ngrep Cpus_allowed_list /proc/self/status\n"
        "mkdir -p \"$4\"; echo '{}' > \"$4/summary.json\"\n");
  const int jobs = int(all.size());
  const Study s = titled("\"one\"");
  run(s, jobs);
  EXPECT_THAT(read(plan_cases(s)[0].files.log),
              HasSubstr("Cpus_allowed_list:\t" + std::to_string(all[0]) + "\n"));
}

TEST(ShellLine, IsWhatAShellTakes) {
  EXPECT_EQ(shell_line({{"/bin/x", "--set", "title=it's [1]"}, "/a b"}),
            "cd '/a b' && /bin/x --set 'title=it'\\''s [1]'");
}

}  // namespace
}  // namespace hyperex::study
