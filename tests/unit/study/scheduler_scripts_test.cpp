// SPDX-License-Identifier: GPL-3.0-or-later
// The scripts for schedulers, run with replacements of these; tests/schedulers uses the real ones.
#include "hyperex/study/scheduler_scripts.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "unit/study/study_files.hpp"

namespace hyperex::study {
namespace {
namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

class Slurm : public StudyFiles {
 protected:
  void SetUp() override {
    StudyFiles::SetUp();
    executable("bin/sbatch",
               "#!/bin/bash\n"
               "set -e\n"
               "cat > $DIR/job.sh; bash -n $DIR/job.sh\n"
               "echo \"sbatch $*\" >> $DIR/log\n"
               "n=$(sed -n 's/^#SBATCH --array=1-//p' $DIR/job.sh)\n"
               "grep '^#SBATCH --output' $DIR/job.sh >> $DIR/outputs\n"
               "tasks=$(seq 1 ${n:-0}); ((${n:-0} < 10)) || tasks=\"1 $n\"\n"
               "for i in $tasks; do SLURM_ARRAY_TASK_ID=$i bash $DIR/job.sh; done\n"
               "[[ -n $n ]] || bash $DIR/job.sh\n"
               "id=$(($(cat $DIR/id 2> /dev/null || echo 10) + 1)); echo $id > $DIR/id\n"
               "[[ \"$1\" != --parsable ]] || echo \"$id;cluster\"\n");
    executable("my programs/hyperex", "#!/bin/bash\necho \"$*\" >> $DIR/log\n");
  }
  void executable(const std::string& name, const std::string& text) {
    fs::permissions(write(name, text), fs::perms::owner_all);
  }
  std::vector<std::string> called(std::size_t cases) {
    const fs::path script = write(
        "script.sh",
        slurm_script({*this / "my programs/hyperex", "/it's/a study.toml", *this / "o"}, cases));
    const std::string run = "DIR=" + folder().string() + " PATH=" + (*this / "bin").string() +
                            ":$PATH bash " + script.string();
    EXPECT_EQ(std::system((run + " > /dev/null").c_str()), 0);
    std::istringstream lines(read(*this / "log"));
    std::vector<std::string> all;
    for (std::string line; std::getline(lines, line);) all.push_back(line);
    return all;
  }
};

TEST_F(Slurm, ArrayRunsEachCaseAndThenComesTheTable) {
  const std::string sweep = "sweep /it's/a study.toml --out " + (*this / "o").string();
  EXPECT_THAT(called(3), ElementsAre("sbatch --parsable", sweep + " --case 1", sweep + " --case 2",
                                     sweep + " --case 3", "sbatch --dependency=afterany:11",
                                     sweep + " --collect"));
  EXPECT_THAT(read(*this / "outputs"),
              HasSubstr("\"" + (*this / "o/logs/slurm-%A_%a.txt").string() + "\""));
  EXPECT_TRUE(fs::is_directory(*this / "o/logs"));
}

/// By default Slurm allows task numbers below 1001.
TEST_F(Slurm, ManyCasesAreSeveralArrays) {
  std::vector<std::string> lines = called(2001);
  EXPECT_EQ(lines[lines.size() - 2], "sbatch --dependency=afterany:11:12:13");
  std::erase_if(lines, [](const std::string& line) { return !line.starts_with("sweep"); });
  ASSERT_EQ(lines.size(), 6u);  // of a long array its ends
  const char* const ends[] = {"--case 1",    "--case 1000", "--case 1001",
                              "--case 2000", "--case 2001", "--collect"};
  for (int i = 0; i < 6; ++i)
    EXPECT_TRUE(lines[std::size_t(i)].ends_with(ends[i])) << lines[std::size_t(i)];
}

TEST(Snakefile, NamesEachCaseByItsFolder) {
  const std::string hash(64, 'b');
  const std::string text =
      snakefile({"/bin/hyperex", "/s.toml", "/o"},
                {{hash, files_of_case("/o", "a", hash)}, {hash, files_of_case("/o", "b c", hash)}});
  EXPECT_THAT(text, HasSubstr("CASES = [\n    \"a-bbbbbbbbbb\",\n    \"b_c-bbbbbbbbbb\",\n]\n"));
  EXPECT_THAT(text, HasSubstr("STUDY = \"/s.toml\"\nOUT = \"/o\"\n"));
}

}  // namespace
}  // namespace hyperex::study
