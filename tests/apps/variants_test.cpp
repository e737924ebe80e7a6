// SPDX-License-Identifier: GPL-3.0-or-later
// Variants of a scene, end to end.
#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/program.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/io/csv.hpp"
#include "hyperex/io/scan.hpp"

namespace hyperex {
namespace {

class Variants : public ProgramTest {
 protected:
  void run(const std::string& out, const std::string& more) {
    const Outcome outcome =
        call("run '" HYPEREX_SOURCE_DIR "/examples/variants.toml' --out " + out +
             " --set motion.time_scale=0.25 --set mesh.element_size_mm=7 --set output.vtu=false"
             " --set output.glb=false --set output.report=false"
             " --set 'output.picture_times_s=[0]' " +
             more);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
};

TEST_F(Variants, AreAsIfRunAlone) {
  run("all", "");
  run("alone", "--set tissue.young_kpa=1000");
  const auto peak_mm = [&](const std::string& folder) {
    return io::read_ply_scalars(in(folder + "/skin_peak.ply")).at(0).values;
  };
  const Eigen::VectorXf alone = peak_mm("alone");
  // Runs do not affect each other; sums of parallel work differ in their last bits.
  EXPECT_LT((peak_mm("all/variants/stiffer") - alone).cwiseAbs().maxCoeff(), 1e-3F);
  EXPECT_GT((peak_mm("all") - alone).cwiseAbs().maxCoeff(), 0.1F);
  EXPECT_TRUE(std::filesystem::exists(in("all/variants.png")));
  EXPECT_TRUE(std::filesystem::exists(in("all/variants_symmetry.png")));

  const auto summary = nlohmann::json::parse(read_file(in("all/summary.json")));
  const auto& table = summary["variants"]["table"];
  ASSERT_EQ(table.size(), 6u);
  EXPECT_EQ(table[0]["greatest_distance_mm"], 0);
  EXPECT_TRUE(table[0]["share_within_25_mm_of_mouth"].is_null());
  for (int i = 1; i < 6; ++i) EXPECT_GT(table[i]["greatest_distance_mm"], 0.01) << table[i];
  EXPECT_EQ(table[1]["changes"]["tissue.young_kpa"], 1000);
  // More viscous tissue lags, by milliseconds; the base case hardly lags.
  EXPECT_GT(table[2]["lag_ms"].get<double>(), table[0]["lag_ms"].get<double>() + 3);
  EXPECT_GT(table[2]["hysteresis"].get<double>(), table[0]["hysteresis"].get<double>());
}

/// A stiff cheek changes its own side of the face, in the columns of that side.
TEST_F(Variants, ColumnsOfASideHoldThatSide) {
  std::ofstream(in("cheeks.toml"))
      << "scan = { file = \"embedded\" }\nmotion = { arkit = \"" HYPEREX_SOURCE_DIR
         "/examples/smile_arkit.csv\", time_scale = 0.25 }\n"
         "mesh = { element_size_mm = 7 }\n"
         "output = { vtu = false, glb = false, report = false, picture_times_s = [0] }\n"
         "[[variant]]\nname = \"right\"\n"
         "tissue = { region = [{ name = \"cheek_R\", young_factor = 10 }] }\n"
         "[[variant]]\nname = \"left\"\n"
         "tissue = { region = [{ name = \"cheek_L\", young_factor = 10 }] }\n"
         "[[variant]]\nname = \"weak\"\nmuscles = { gain = { side_R = 0.5 } }\n"
         "[[variant]]\npreset = \"palsy_complete_R\"\n";
  const Outcome outcome = call("run cheeks.toml --out out");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  // A picture of the muscles is drawn where they pull differently.
  EXPECT_TRUE(std::filesystem::exists(in("out/muscles.png")));
  EXPECT_FALSE(std::filesystem::exists(in("out/variants/right/muscles.png")));
  EXPECT_TRUE(std::filesystem::exists(in("out/variants/weak/muscles.png")));
  const auto summary = nlohmann::json::parse(read_file(in("out/summary.json")));
  const auto& table = summary["variants"]["table"];
  ASSERT_EQ(table.size(), 5u);
  // A variant in which no muscle of a side pulls lists that side and says what still moves it.
  EXPECT_EQ(table[3]["unpulled_sides"], nlohmann::json::array());
  EXPECT_EQ(table[4]["unpulled_sides"], nlohmann::json::array({"R"}));
  EXPECT_TRUE(table[4]["commissure_R_with_jaw_mm"].is_number());
  EXPECT_GT(table[4]["commissure_R_with_turned_jaw_mm"].get<double>(), 0);
  EXPECT_THAT(outcome.out, testing::HasSubstr("    no muscle pulls on the right: its corner "));
  EXPECT_THAT(outcome.out, testing::HasSubstr("activations of the 52 muscles at "));
  const auto change_mm = [&](int row, const std::string& column) {
    return std::abs(table[row][column].get<double>() - table[0][column].get<double>());
  };
  EXPECT_GT(change_mm(1, "commissure_R_mm"), 3 * change_mm(1, "commissure_L_mm"));
  EXPECT_GT(change_mm(2, "commissure_L_mm"), 3 * change_mm(2, "commissure_R_mm"));
  EXPECT_GT(change_mm(1, "commissure_R_mm"), 0.5);
  EXPECT_GT(change_mm(3, "mean_displacement_R_mm"), 3 * change_mm(3, "mean_displacement_L_mm"));
  EXPECT_GT(change_mm(3, "mean_displacement_R_mm"), 0.1);
  // Rows of variants.csv hold the same figures.
  const io::CsvTable csv = io::read_csv(in("out/variants.csv"),
                                        [](const std::string&, std::string_view) { return 0.0; });
  for (const char* side : {"L", "R"}) {
    const std::string column = std::string("mean_displacement_") + side + "_mm";
    for (int row = 0; row < 3; ++row)
      EXPECT_NEAR(csv.values(row, csv.column(column)), table[row][column].get<double>(), 1e-5);
  }
}

struct VariantFault {
  const char *name, *block, *line;
};

class FaultyVariant : public ProgramTest, public testing::WithParamInterface<VariantFault> {};

TEST_P(FaultyVariant, IsRefusedInOneLineBeforeAnythingIsSimulated) {
  std::ofstream(in("scene.toml"))
      << "scan = { file = \"embedded\" }\nmotion = { file = \"embedded\" }\n[[variant]]\n"
         "name = \"x\"\n"
      << GetParam().block;
  const Outcome outcome = call("run scene.toml --out out");
  EXPECT_EQ(outcome.status, 2);
  std::string error = outcome.err;
  std::erase_if(error, [](char c) { return c == '\r'; });
  EXPECT_THAT(error,
              testing::HasSubstr("scene.toml:5: variant[0]." + std::string(GetParam().line)));
  EXPECT_EQ(error.find("variant[0]"), error.rfind("variant[0]")) << "one line";
  EXPECT_FALSE(std::filesystem::exists(in("out")));
}

INSTANTIATE_TEST_SUITE_P(
    Variant, FaultyVariant,
    testing::Values(
        VariantFault{
            "Point", "drive = { points = [\"nobody\"] }\n",
            "drive.points = [\"nobody\"]: expected names of points in the recording embedded "
            "motion (nobody is none)"},
        VariantFault{"MisspeltPoint", "drive = { points = [\"cheilon_R\"] }\n",
                     "drive.points = [\"cheilon_R\"]: expected names of points in the recording "
                     "embedded motion (cheilon_R is none); did you mean cheilion_R?"},
        VariantFault{"MisspeltLandmarkOfAScar",
                     "tissue = { region = [{ scar = [\"cheilion_R\", \"allare_R\"], width_mm = 8, "
                     "young_factor = 5 }] }\n",
                     "tissue.region[0].scar = [\"cheilion_R\", \"allare_R\"]: expected names of "
                     "landmarks of the scan (allare_R is none); did you mean alare_R?"},
        VariantFault{
            "Region", "tissue = { region = [{ name = \"cheek_Q\", young_factor = 2 }] }\n",
            "tissue.region[0].name = \"cheek_Q\": expected the name of a region (hyperex presets "
            "lists "
            "them); did you mean cheek?"},
        VariantFault{
            "SideOfARegion",
            "tissue = { region = [{ name = \"right_cheek\", young_factor = 2 }] }\n",
            "tissue.region[0].name = \"right_cheek\": expected the name of a region (hyperex "
            "presets "
            "lists them); did you mean cheek_R?"},
        VariantFault{
            "Side",
            "tissue = { point = [{ landmark = \"cheek_R\", side = \"L\", young_kpa = 5 }] }\n",
            "tissue.point[0].side = \"L\": expected \"R\" or none"},
        VariantFault{
            "Empty",
            "tissue = { region = [{ scar_points_mm = [[500, 0, 0], [510, 0, 0]], young_factor = 2 "
            "}] }\n",
            "tissue.region[0].scar_points_mm"},
        VariantFault{
            "Indefinite", "tissue = { region = [{ name = \"cheek_R\", poisson_factor = 2 }] }\n",
            "tissue.region[0].poisson_factor = 2.0: expected Poisson's ratio to stay from"},
        VariantFault{"Negative", "tissue = { young_kpa = -3 }\n",
                     "tissue.young_kpa = -3: expected a number from 0.001"},
        VariantFault{"NotToVary", "mesh = { layers = 3 }\n",
                     "mesh.layers = 3: expected a key of what may vary"}),
    [](const auto& fault) { return std::string(fault.param.name); });

}  // namespace
}  // namespace hyperex
