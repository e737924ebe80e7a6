// SPDX-License-Identifier: GPL-3.0-or-later
// The outputs of a run: files that can be moved and passed on.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <utility>

#include "apps/good_inputs.hpp"
#include "apps/program.hpp"
#include "hyperex/core/files.hpp"
#include "support/vtu_reader.hpp"

namespace hyperex {
namespace {
namespace fs = std::filesystem;

/// A run with a variant, from a folder named after a patient.
class RunOutputs : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    fs::create_directories(in("patients/Smith_John"));
    write_good_inputs(in("patients/Smith_John"));
  }
  void run(const std::string& out, const std::string& more = "") {
    const std::string scene = "'" + in("patients/Smith_John/scene.toml").string() + "'";
    put(in("patients/Smith_John/weights.csv"), "weight\n" + weights());
    std::string text = read_file(in("patients/Smith_John/scene.toml"));
    put(in("patients/Smith_John/scene.toml"),
        text +
            "[[variant]]\nname = \"stiff\"\ntissue = { region = [{ painted = \"weights.csv\", "
            "young_factor = 3 }] }\n");
    const Outcome outcome = call("run " + scene + " --out " + out + " " + more);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }

 private:
  static std::string weights() {
    std::string text;
    const Points points = good_face().points;
    for (Eigen::Index v = 0; v < points.rows(); ++v) text += points(v, 0) < -0.02 ? "1\n" : "0\n";
    return text;
  }
};

/// Every file below a folder.
std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  return files;
}

TEST_F(RunOutputs, NameNoFolderOfThisMachine) {
  run("out");
  const auto files = files_in(in("out"));
  EXPECT_GT(files.size(), 10u);
  for (const fs::path& file : files) {
    const std::string bytes = read_file(file);
    for (const std::string& betrayed :
         {in("").string(), std::string("Smith_John"), std::string(".tmp")})
      EXPECT_EQ(bytes.find(betrayed), std::string::npos) << file << " holds " << betrayed;
  }
}

TEST_F(RunOutputs, SayWhereTheGlbIsCoarserThanWanted) {
  const std::string scene = "run '" + in("patients/Smith_John/scene.toml").string() +
                            "' --out out --set output.glb=true --set time.end_s=0.5 --set "
                            "time.frame_rate_hz=60";
  const Outcome coarse =
      call(scene + " --set output.glb_tolerance_mm=0.01 --set output.glb_max_mb=0.1");
  EXPECT_THAT(coarse.out, testing::ContainsRegex(
                              "performance\\.glb +Blender, three\\.js; the motion to [0-9.]+ mm; "
                              "for 0\\.01 mm set output\\.glb_max_mb above 0\\.1\n"))
      << coarse.err;
  EXPECT_THAT(call(scene).out, testing::ContainsRegex("performance\\.glb +Blender, three\\.js\n"));
}

/// docs/outputs.md: right, then left, in every table; points in motion.csv stand by name.
TEST_F(RunOutputs, TheRightSideComesFirst) {
  run("out", "--set output.report=false --set output.vtu=false --set output.glb=false");
  int pairs = 0;
  for (const fs::path& file : files_in(in("out"))) {
    if (file.extension() != ".csv" || file.filename() == "motion.csv") continue;
    const std::string text = read_file(file);
    const std::string head = "," + text.substr(0, text.find('\n')) + ",";
    const std::regex left(",([A-Za-z0-9_]*_)L(_[A-Za-z0-9_]*)?(?=,)");
    for (std::sregex_iterator it(head.begin(), head.end(), left), end; it != end; ++it) {
      if ((*it)[1].str().ends_with("ratio_R_")) continue;
      const std::string right = "," + (*it)[1].str() + "R" + (*it)[2].str() + ",";
      EXPECT_LT(head.find(right), std::size_t(it->position())) << file << ": " << it->str();
      ++pairs;
    }
    if (head.find(",side,") != std::string::npos) {
      EXPECT_LT(text.find(",R,"), text.find(",L,")) << file;
    }
  }
  EXPECT_GT(pairs, 20) << "columns of curves, excursions, variants and muscles";
}

/// Points with noise, brows that rise and a cheek's outline that moves.
TEST_F(RunOutputs, SayWhatDroveAndWhatTheHeadsPoseMayMake) {
  write_opening(in("patients/Smith_John"), 0, 16, [](motion::Motion& m) {
    for (std::size_t k = 0; k < m.positions.size(); ++k)
      for (Eigen::Index p = 0; p < m.positions[k].rows(); ++p)
        for (int c = 0; c < 3; ++c)
          m.positions[k](p, c) += 3e-4 * std::sin(37.0 * double(k) + 17.0 * double(p) + 5.0 * c);
    for (const auto& [name, up_m] : {std::pair{"ibug68_19", 6e-3}, {"ibug68_3", 8e-3}})
      for (std::size_t k = 0; k < m.positions.size(); ++k)
        m.positions[k](m.index_of(name), 1) += up_m * std::min(1.0, double(k) / 6);
  });
  const Outcome done = call(
      "run patients/Smith_John/scene.toml --out out --set output.vtu=false "
      "--set output.glb=false --set output.report=false --set output.jitter_mm=0.2");
  ASSERT_EQ(done.status, 0) << done.err;
  const auto corners = summary()["symmetry"]["commissure"];
  const auto part = [&](const char* name) { return corners[name].get<double>(); };
  EXPECT_GT(part("pose_floor_mm"), 0.01);
  EXPECT_NEAR(part("floor_mm"),
              std::hypot(part("jitter_floor_mm"), part("mesh_floor_mm"), part("pose_floor_mm")),
              1e-9);
  const auto rough = summary()["roughness_at_peak"];
  EXPECT_GT(rough["rms_mm"].get<double>(), 0);
  EXPECT_GT(rough["p99_mm"].get<double>(), rough["rms_mm"].get<double>());
  for (const char* key : {"brows_rms_mm", "corners_rms_mm", "chin_rms_mm"})
    EXPECT_TRUE(rough[key].is_number()) << key;
  EXPECT_THAT(text_of("drive.parts_joined"),
              testing::HasSubstr("driven in addition to the mouth, since they move: brows ("));
  EXPECT_THAT(text_of("drive.measured_not_driven"),
              testing::HasSubstr("recorded, but not driven: outline of the face ("));
  // The options name the points that drove, not the default ones alone.
  const auto points = summary()["options"]["drive"]["points"];
  EXPECT_THAT(points, testing::Contains("ibug68_19"));
  EXPECT_THAT(points, testing::Contains("ibug68_48"));
  EXPECT_THAT(points, testing::Not(testing::Contains("ibug68_3")));
}

TEST_F(RunOutputs, FramesOpenAfterTheFolderWasMoved) {
  run("out", "--set time.frame_rate_hz=20 --set output.vtu_every=2 --set output.variants_vtu=true");
  fs::rename(in("out"), in("elsewhere"));
  for (const fs::path& folder : {in("elsewhere"), in("elsewhere/variants/stiff")}) {
    const std::string series = read_file(folder / "frames.pvd");
    const std::regex entry("timestep=\"([^\"]*)\"[^>]*file=\"([^\"]*)\"");
    std::vector<std::string> times;
    for (std::sregex_iterator it(series.begin(), series.end(), entry), end; it != end; ++it) {
      times.push_back((*it)[1]);
      const std::string vtu = read_file(folder / (*it)[2].str());
      std::smatch size;
      ASSERT_TRUE(std::regex_search(
          vtu, size, std::regex("NumberOfPoints=\"([0-9]+)\" NumberOfCells=\"([0-9]+)\"")));
      const std::size_t points = std::stoul(size[1]), cells = std::stoul(size[2]);
      EXPECT_GT(cells, 1000u);
      EXPECT_EQ(test::unpacked<float>(vtu, "Points").size(), 3 * points);
      EXPECT_EQ(test::unpacked<float>(vtu, "displacement \\(m\\)").size(), 3 * points);
      EXPECT_EQ(test::unpacked<float>(vtu, "von Mises stress \\(kPa\\)").size(), cells);
      EXPECT_EQ(test::unpacked<std::uint8_t>(vtu, "inverted").size(), cells);
      const auto corners = test::unpacked<std::int32_t>(vtu, "connectivity");
      ASSERT_EQ(corners.size(), 4 * cells);
      EXPECT_LT(*std::max_element(corners.begin(), corners.end()), std::int32_t(points));
    }
    ASSERT_GE(times.size(), 2u);
    EXPECT_EQ(times[0], "0");
    EXPECT_EQ(times[1], "0.1") << "every second frame";
    EXPECT_EQ(files_in(folder / "frames").size(), times.size());
  }
}

/// The size of the outputs is stated before the run, and a run that would write too much does not
/// begin.
TEST_F(RunOutputs, AreStatedBeforeAndBounded) {
  put(in("x.toml"),
      "scan = { file = \"embedded\" }\nmotion = { file = \"embedded\" }\n"
      "mesh = { element_size_mm = 9 }\noutput = { report = false, glb = false }\n"
      "[[variant]]\nname = \"stiff\"\ntissue.young_kpa = 300\n");
  const Outcome checked = call("check x.toml");
  ASSERT_EQ(checked.status, 0) << checked.err;
  EXPECT_THAT(checked.out, testing::ContainsRegex("a run: 81 frames, from 0 s to [0-9.]+ s of the "
                                                  "recording; about [0-9]+ MB on disk"));
  EXPECT_THAT(checked.out, testing::HasSubstr("without its variant, "));
  for (const char* command : {"check x.toml", "run x.toml --out o"}) {
    const Outcome refused =
        call(std::string(command) + " --set output.most_gb=0.1 --set time.frame_rate_hz=1000");
    EXPECT_EQ(refused.status, 2) << command;
    EXPECT_THAT(refused.err, testing::HasSubstr("output.most_gb = 0.1: expected "));
    EXPECT_FALSE(fs::exists(in("o")));
  }
  // Before meshing, which alone would take minutes here.
  const Outcome fine = call("run x.toml --out o --set mesh.element_size_mm=0.5", "ulimit -t 20");
  EXPECT_EQ(fine.status, 2) << fine.err;
  EXPECT_THAT(fine.err, testing::HasSubstr("output.most_"));
  const Outcome run = call("run x.toml --out o --no-variants --set time.start_s=1");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_FALSE(fs::exists(in("o/variants")));
  const auto summary = nlohmann::json::parse(read_file(in("o/summary.json")));
  EXPECT_EQ(summary["frames"], 66) << "2.67 s less 1 s, and half a second from rest into it";
  // The estimate is correct to within a half.
  std::uintmax_t bytes = 0;
  for (const fs::path& file : files_in(in("o"))) bytes += fs::file_size(file);
  put(in("y.toml"),
      "scan = { file = \"embedded\" }\nmotion = { file = \"embedded\" }\ntime.start_s = 1\n"
      "mesh = { element_size_mm = 9 }\noutput = { report = false, glb = false }\n");
  const Outcome again = call("check y.toml");
  std::smatch found;
  ASSERT_TRUE(std::regex_search(again.out, found, std::regex("about ([0-9]+) MB on disk")))
      << again.out << again.err;
  EXPECT_NEAR(std::stod(found[1]) * 1e6 / double(bytes), 1, 0.5);
}

}  // namespace
}  // namespace hyperex
