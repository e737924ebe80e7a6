// SPDX-License-Identifier: GPL-3.0-or-later
// The same inputs through the program: exit status 0 or 2, a clear line where it refuses, no file
// left that is not whole. HYPEREX_PROGRAM_MUTATIONS sets how many a format.
#include <sys/resource.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

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
    try_seeds(format, reader(format).seeds, name, command);
  }
  void try_seeds(const std::string& format, const std::vector<std::string>& seeds,
                 const std::string& name, const std::string& command) {
    for (std::uint64_t number = 0; number < program_mutations(); ++number) {
      // Others than the readers' own test takes first.
      put(name, mutated(seeds, 1000000 + number));
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
  put("arkit.toml", "scan.file = \"embedded\"\nmotion.arkit = \"w.csv\"\n");
  put("openface.toml", "scan.file = \"embedded\"\nmotion.openface = \"au.csv\"\n");
  try_seeds("arkit",
            {"time_s,eyeBlinkLeft,jawOpen,mouthSmileLeft\n0,0,0,0\n0.1,0.5,0.2,1e-1\n0.2,1,,0\n",
             "Timecode,BlendShapeCount,EyeBlinkLeft,JawOpen\n16:07:12:05.613,61,0,0.1\n"
             "16:07:12:06.613,61,0.5,0.2\n"},
            "w.csv", "check arkit.toml");
  try_seeds("openface",
            {"frame, timestamp, confidence, success, AU01_r, AU12_r, AU25_r\n"
             "1, 0, 0.96, 1, 0, 0, 0\n2, 0.083, 0.96, 1, 0.5, 1.2, 3\n3, 0.167, 0.9, 0, 1, 1, 1\n"},
            "au.csv", "check openface.toml");
  try_seeds("study",
            {"title = \"s\"\nscene = \"base.toml\"\nout = \"swept\"\n[set]\n"
             "mesh.element_size_mm = 7\n[grid]\ntissue.young_kpa = [50, 1e2]\n[[grid.cheeks]]\n"
             "name = \"stiff\"\ntissue.region = [{ name = \"cheek_R\", young_factor = 10 }]\n"},
            "s.toml", "sweep s.toml --list");
  put("w.csv", "time_s,jawOpen\n0,0\n0.1,0.5\n0.2,1\n");
  try_reader("candide", "in.wfm", "check arkit.toml --set motion.candide=in.wfm");
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
