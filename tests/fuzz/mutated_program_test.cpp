// SPDX-License-Identifier: GPL-3.0-or-later
// The same inputs through the program: exit status 0 or 2, a clear line where it refuses, no file
// left that is not whole. HYPEREX_PROGRAM_MUTATIONS sets how many a format.
#include <sys/resource.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <set>

#include "apps/program.hpp"
#include "fuzz/mutate.hpp"
#include "fuzz/readers.hpp"

namespace hyperex::fuzz {
namespace {
namespace fs = std::filesystem;

std::uint64_t program_mutations() {
  const char* text = std::getenv("HYPEREX_PROGRAM_MUTATIONS");
  return text == nullptr ? 4 : std::strtoull(text, nullptr, 10);
}

class MutatedInProgram : public ProgramTest {
 protected:
  void put(const std::string& name, const std::string& bytes) const {
    fs::create_directories(in(name).parent_path());
    std::ofstream(in(name), std::ios::binary | std::ios::trunc) << bytes;
  }
  std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(in("")))
      names.insert(entry.path().string());
    return names;
  }

  /// `name`: where the input goes; `command` reads it and, if at all, writes out.csv.
  void try_reader(const std::string& format, const std::string& name, const std::string& command) {
    for (std::uint64_t number = 0; number < program_mutations(); ++number) {
      // Others than the readers' own test takes first.
      put(name, mutated(reader(format).seeds, 1000000 + number));
      const std::set<std::string> before = files();
      const Outcome outcome = call(command, "ulimit -t 30");
      const std::string which = format + " " + std::to_string(number) + ": " + outcome.err;
      ++statuses_[outcome.status];
      EXPECT_TRUE(outcome.status == 0 || outcome.status == 2) << outcome.status << " " << which;
      if (outcome.status == 2) {
        EXPECT_EQ(fault_of_message(outcome.err), "") << which;
        EXPECT_NE(outcome.err.find("hyperex: "), std::string::npos) << which;
        EXPECT_EQ(files(), before) << which;
      }
      fs::remove(in("out.csv"));
    }
  }

  std::map<int, int> statuses_;
};

TEST_F(MutatedInProgram, EndsInOrder) {
  const std::string scene = "scan = { file = \"embedded\" }\nmotion = { file = \"embedded\" }\n";
  put("base.toml", scene);
  for (const char* mesh : {"ply", "obj", "stl", "gltf", "glb"}) {
    const std::string file = "in." + std::string(mesh);
    try_reader(mesh, file, "compare " + file + " " + file + " --json");
  }
  try_reader("landmarks", "in.json", "check base.toml --set scan.landmarks=in.json");
  try_reader("markups", "in.mrk.json", "check base.toml --set scan.landmarks=in.mrk.json");
  try_reader("csv", "in.csv", "symmetry in.csv --keep-head --out out.csv");
  try_reader("trc", "in.trc", "symmetry in.trc --keep-head --out out.csv");
  try_reader("scene", "in.toml", "check in.toml");
  put("rec/camera.toml", "width=4\nheight=4\nfx=4\nfy=4\ncx=2\ncy=2\n");
  put("rec/rgb.txt", "0 rgb/0.png\n");
  put("rec/rgb/0.png", reader("picture").seeds[0]);
  try_reader("picture", "rec/rgb/0.png", "check base.toml --set motion.recording=rec");
  try_reader("lists", "rec/rgb.txt", "check base.toml --set motion.recording=rec");
  try_reader("camera", "rec/camera.toml", "check base.toml --set motion.recording=rec");
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  EXPECT_LT(usage.ru_maxrss, 2L << 20);
  int sum = 0;
  for (const auto& [status, count] : statuses_) {
    std::printf("status %d: %d inputs\n", status, count);
    sum += count;
  }
  std::printf("%d inputs, most memory %ld MiB\n", sum, usage.ru_maxrss / 1024);
}

}  // namespace
}  // namespace hyperex::fuzz
