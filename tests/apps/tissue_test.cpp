// SPDX-License-Identifier: GPL-3.0-or-later
// Tissue that varies over the face, end to end.
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/good_inputs.hpp"
#include "apps/program.hpp"
#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/io/csv.hpp"
#include "hyperex/io/scan.hpp"
#include "support/vtu_reader.hpp"

namespace hyperex {
namespace {

using testing::HasSubstr;

class Tissue : public ProgramTest {
 protected:
  /// A short, coarse run of an example; the skin at its peak.
  Eigen::VectorXf peak_mm(const std::string& example) {
    const Outcome run =
        call("run '" HYPEREX_SOURCE_DIR "/examples/" + example + ".toml' --out " + example +
             // Without the shape prior: shapes of real faces do not include a stiff cheek.
             " --set muscles.shape_prior=false"
             " --set time.end_s=0.7 --set mesh.element_size_mm=5"
             " --set output.vtu=false --set output.glb=false"
             " --set output.report=false --set 'output.picture_times_s=[0]'");
    EXPECT_EQ(run.status, 0) << run.err;
    const auto scalars = io::read_ply_scalars(in(example + "/skin_peak.ply"));
    return scalars.at(0).values;
  }
};

/// Statistics of `values` near a place of the face, on its right or left side.
struct Spread {
  double mean = 0, deviation = 0;
};
Spread near(const Eigen::VectorXf& values, const Points& at, const Vec3& place, double radius_m) {
  double sum = 0, squares = 0;
  int count = 0;
  for (Eigen::Index v = 0; v < at.rows(); ++v)
    if ((at.row(v).transpose() - place).norm() < radius_m) {
      sum += values[v];
      squares += double(values[v]) * values[v];
      ++count;
    }
  const double mean = sum / count;
  return {mean, std::sqrt(squares / count - mean * mean)};
}

TEST_F(Tissue, AStiffCheekMovesMoreEvenlyAndLessTowardsTheJaw) {
  const Eigen::VectorXf same = peak_mm("mouth_open"), stiff = peak_mm("stiff_cheek");
  const anatomy::EmbeddedFace face = anatomy::embedded_face();
  const Points& at = face.mesh.points;
  ASSERT_EQ(stiff.size(), same.size());
  // The stiff cheek moves as one piece: its displacements differ less from place to place.
  const Vec3 right = face.landmarks.at("cheek_R"), left = face.landmarks.at("cheek_L");
  const double radius_m = 0.02;
  EXPECT_LT(near(stiff, at, right, radius_m).deviation,
            0.85 * near(same, at, right, radius_m).deviation);
  EXPECT_NEAR(near(stiff, at, left, radius_m).deviation / near(same, at, left, radius_m).deviation,
              1, 0.025);
  // Below it, where the jaw pulls, the skin moves less than on the other side.
  const Vec3 below = 0.5 * (right + face.landmarks.at("ibug68_5"));
  const Vec3 mirrored(-below.x(), below.y(), below.z());
  const double on_right = near(stiff, at, below, 0.012).mean / near(same, at, below, 0.012).mean;
  const double on_left =
      near(stiff, at, mirrored, 0.012).mean / near(same, at, mirrored, 0.012).mean;
  EXPECT_LT(on_right, 0.93);
  EXPECT_NEAR(on_left, 1, 0.01);

  const auto summary = nlohmann::json::parse(read_file(in("stiff_cheek/summary.json")));
  EXPECT_EQ(summary["tissue"]["viscosity_pa_s"], (nlohmann::json{476.8, 476.8}));
  EXPECT_DOUBLE_EQ(summary["tissue"]["young_kpa"][0], 192.4);
  EXPECT_DOUBLE_EQ(summary["tissue"]["young_kpa"][1], 962);
  EXPECT_EQ(summary["options"]["tissue"]["region"][0]["name"], "cheek_R");
  EXPECT_GT(read_file(in("stiff_cheek/tissue_map.png")).size(), 5000u);
  EXPECT_FALSE(std::filesystem::exists(in("mouth_open/tissue_map.png")));
}

/// Two rows of elements of 3 mm: the upper one holds all of the skin.
TEST_F(Tissue, LayersAreInTheFramesAndInTheSummary) {
  put(in("layers.toml"),
      "scan = { file = \"embedded\" }\nmotion = { file = \"embedded\" }\n"
      "mesh = { element_size_mm = 12, layers = 2, thickness_mm = 6 }\n"
      "time = { step_s = 0.01, end_s = 0.2, frame_rate_hz = 10 }\n"
      "output = { glb = false, report = false, picture_times_s = [0] }\n"
      "tissue.young_kpa = 100\n"
      "tissue.layer = [{ name = \"skin\", thickness_mm = 2, young_factor = 4 }]\n");
  const Outcome run = call("run layers.toml --out layers");
  ASSERT_EQ(run.status, 0) << run.err;
  std::vector<float> young =
      test::unpacked<float>(read_file(in("layers/frames/frame_0000.vtu")), "Young[^\"]*");
  ASSERT_GT(young.size(), 100u);
  std::ranges::sort(young);
  EXPECT_EQ(young.front(), 100);
  EXPECT_LE(young.back(), 400);
  // Half of the elements lie below the skin; where the layer was not thinned the others are mixed.
  EXPECT_EQ(young[young.size() / 3], 100);
  EXPECT_NEAR(young[young.size() * 2 / 3], 300, 1);
  const auto summary = nlohmann::json::parse(read_file(in("layers/summary.json")));
  EXPECT_EQ(summary["tissue"]["young_kpa"][0], 100);
  EXPECT_EQ(summary["options"]["tissue"]["layer"][0]["name"], "skin");
  EXPECT_FALSE(std::filesystem::exists(in("layers/tissue_map.png"))) << "the skin is uniform";
}

TEST_F(Tissue, PresetsAreListedWithTheirSources) {
  const Outcome listed = call("presets");
  EXPECT_EQ(listed.status, 0);
  for (const char* text :
       {"source_model_2", "young_kpa = 205.6", "aged_skin", "source: ", "cheek", "philtrum",
        "layer fat: 3.375 mm, young_factor = 0.16", "layer deep: the rest", "palsy_zygomatic_L",
        "muscles.gain = {\"zygomatic_L\" = 0}", "assumed: "})
    EXPECT_THAT(listed.out, HasSubstr(text));
}

}  // namespace
}  // namespace hyperex
