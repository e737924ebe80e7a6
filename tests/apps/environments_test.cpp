// SPDX-License-Identifier: GPL-3.0-or-later
// A run in twenty environments writes the same motion, byte for byte: locales, numbers of threads,
// folders that are not there, closed streams, limits.
#include <fstream>

#include "apps/program.hpp"

namespace hyperex {
namespace {

class Environments : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    std::ofstream(in("scene.toml"))
        << "[scan]\nfile = \"embedded\"\n[motion]\nfile = \"embedded\"\n"
           "[mesh]\nelement_size_mm = 12\nlayers = 1\n[time]\nend_s = 0.2\n"
           "[output]\nvtu = false\nglb = false\nreport = false\n";
  }

  /// The motion that a run writes; `around`: a line of shell with RUN in the place of the program.
  std::string motion_of(std::string around) {
    const std::string out = "out" + std::to_string(runs_++);
    around.replace(around.find("RUN"), 3, "\"$HYPEREX\" run scene.toml --out " + out);
    EXPECT_EQ(shell("( " + around + " ) >log.txt 2>&1"), 0) << around << '\n'
                                                            << read_file(in("log.txt"));
    return read_file(in(out + "/motion.csv"));
  }

 private:
  int runs_ = 0;
};

TEST_F(Environments, ChangeNothingOfARun) {
  const std::string usual = motion_of("RUN");
  ASSERT_GT(usual.size(), 1000u);
  for (const char* around : {
           "env LC_ALL=C RUN",
           "env LC_ALL=POSIX LANG= RUN",
           "env LC_ALL=de_DE.UTF-8 LC_NUMERIC=de_DE.UTF-8 RUN",
           "env LC_ALL=nonsense RUN",
           // The processor's kernel of OpenBLAS stays: another one rounds otherwise.
           "env -i ${OPENBLAS_CORETYPE:+OPENBLAS_CORETYPE=$OPENBLAS_CORETYPE} RUN",
           "env -u HOME RUN",
           "env HOME=/nonexistent TMPDIR=/nonexistent RUN",
           "env OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 RUN",
           "env OMP_NUM_THREADS=64 RUN",
           "env OMP_NUM_THREADS=-3 RUN",
           "env XDG_CACHE_HOME=relative RUN",
           "env XDG_CACHE_HOME=/proc RUN",
           "env TZ=Mars TERM= NO_COLOR=1 RUN",
           "env PATH= RUN",
           "umask 077; RUN",
           "ulimit -n 32; RUN",
           "ulimit -s 1024; RUN",
           "RUN <&-",
           "RUN >&-",
           "RUN 2>&-",
           "RUN <&- >&- 2>&-",
       })
    EXPECT_TRUE(motion_of(around) == usual) << around;
}

}  // namespace
}  // namespace hyperex
