// SPDX-License-Identifier: GPL-3.0-or-later
// Layers of the tissue: their shares of the elements, the mixture, and what is refused.
#include "hyperex/tissue/field/layers.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "hyperex/tissue/field/presets.hpp"
#include "hyperex/tissue/field/tissue_field.hpp"
#include "support/sheet_mesh.hpp"

namespace hyperex::tissue {
namespace {
using testing::HasSubstr;

/// A flat slab whose skin lies at z = 0, with `rows` rows of elements.
VolumeMesh slab_of_rows(double thickness_m, int rows) {
  const TriMesh sheet = test::sheet_mesh({4, 3}, {0.02, 0.015}).mesh;
  VolumeMeshOptions options;
  options.layers = rows;
  return build_volume_mesh(sheet, Eigen::VectorXd::Constant(sheet.points.rows(), thickness_m),
                           options);
}

TissueFieldOptions of_layers(std::vector<TissueLayer> layers) {
  TissueFieldOptions options;
  options.layers = std::move(layers);
  return options;
}

/// How deep the middle of an element lies.
double depth_of(const VolumeMesh& slab, Eigen::Index tet) {
  double depth_m = 0;
  for (int k = 0; k < 4; ++k) depth_m -= slab.nodes(slab.tets(tet, k), 2) / 4;
  return depth_m;
}

TEST(LayerShares, OfASlabAreThoseOfItsThickness) {
  const VolumeMesh slab = slab_of_rows(0.006, 3);
  const Eigen::MatrixXd share = layer_shares(of_layers({{.name = "skin", .thickness_m = 0.0015},
                                                        {.name = "fat", .thickness_m = 0.0035},
                                                        {.name = "deep"}}),
                                             slab);
  ASSERT_EQ(share.rows(), slab.tets.rows());
  const Eigen::Matrix3d of_row{{0.75, 0.25, 0}, {0, 1, 0}, {0, 0.5, 0.5}};
  std::array<int, 3> seen{};
  for (Eigen::Index t = 0; t < slab.tets.rows(); ++t) {
    const int row = int(depth_of(slab, t) / 0.002);
    ASSERT_TRUE(row >= 0 && row < 3);
    ++seen[std::size_t(row)];
    EXPECT_LT((share.row(t) - of_row.row(row)).cwiseAbs().maxCoeff(), 1e-9) << "row " << row;
  }
  EXPECT_THAT(seen, testing::Each(slab.tets.rows() / 3));
}

TEST(LayerShares, UnderTheLastThicknessTheTissueIsUniform) {
  const TissueFieldOptions options = of_layers({{.thickness_m = 0.002, .value = {5e5}}});
  const std::vector<TissueParameters> parameters = layer_parameters(options);
  ASSERT_EQ(parameters.size(), 2u);
  EXPECT_EQ(parameters[0][young], 5e5);
  EXPECT_EQ(parameters[0][density], default_parameters[density]);
  EXPECT_EQ(parameters[1], default_parameters);
  const Eigen::MatrixXd share = layer_shares(options, slab_of_rows(0.008, 1));
  EXPECT_LT((share.col(0).array() - 0.25).abs().maxCoeff(), 1e-9);
  EXPECT_LT((share.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-12);
  EXPECT_EQ(layer_shares(of_layers({{.name = "all"}}), slab_of_rows(0.008, 1)).cols(), 1);
}

TEST(LayerMeans, OfAThinLayerOverOneRowIsVoigts) {
  const TissueFieldOptions options = of_layers(
      {{.thickness_m = 0.0005, .value = {1.2e6}}, {.thickness_m = std::nullopt, .value = {1e5}}});
  const Eigen::MatrixXd share = layer_shares(options, slab_of_rows(0.006, 1));
  const std::vector<double> skin(std::size_t(share.rows()), 1.2e6),
      deep(std::size_t(share.rows()), 1e5);
  for (const double mean : layer_means(share, {skin, deep}))
    EXPECT_NEAR(mean, 1.2e6 / 12 + 1e5 * 11 / 12, 1e-3);
}

TEST(LayerMeans, OfEqualValuesAndOfFullElementsAreExact) {
  const Eigen::MatrixXd share{{0.3, 0.7, 0}, {0, 0, 1}, {1.0 / 3, 1.0 / 3, 1.0 / 3}};
  const std::vector<std::vector<double>> values = {{0.1, 7, 0.3}, {0.1, 8, 0.3}, {0.1, 0.1, 0.3}};
  EXPECT_THAT(layer_means(share, values), testing::ElementsAre(0.1, 0.1, 0.3));
}

TEST(LayerParameters, AreValuesOrFactorsOfTheUniformOnes) {
  TissueFieldOptions options =
      of_layers({{.thickness_m = 0.002, .factor = {3, 0.5, 0.9, 1.5}}, {.value = {2e4}}});
  options.uniform[young] = 1e4;
  std::vector<TissueParameters> of = layer_parameters(options);
  ASSERT_EQ(of.size(), 2u);
  for (int p = 0; p < parameter_count; ++p)
    EXPECT_EQ(of[0][p], uniform_parameters(options)[p] * *options.layers[0].factor[p]);
  EXPECT_EQ(of[1][young], 2e4);
  EXPECT_EQ(of[1][viscosity], default_parameters[viscosity]);
  options.preset = "aged_skin";  // twice as stiff, whatever the scene gives
  of = layer_parameters(options);
  EXPECT_EQ(of[0][young], 6e4);
  EXPECT_EQ(of[1][young], 4e4);
}

TEST(LayerParameters, OfThePresetArePublishedOnesAndScaleWithTheScenes) {
  TissueFieldOptions options;
  options.preset = "skin_fat_deep";
  EXPECT_TRUE(is_graded(options));
  const std::vector<TissueLayer>& layers = layers_of(options);
  ASSERT_EQ(layers.size(), 3u);
  EXPECT_EQ(layers[0].name, "skin");
  EXPECT_NEAR(*layers[0].thickness_m, (1.51e-3 + 1.97e-3) / 2, 1e-9);
  EXPECT_NEAR(*layers[1].thickness_m, (1.61e-3 + 5.14e-3) / 2, 1e-9);
  EXPECT_FALSE(layers[2].thickness_m);
  std::vector<TissueParameters> of = layer_parameters(options);
  EXPECT_NEAR(of[0][young], 6 * 3.18e3, 1);  // 6 C10
  EXPECT_NEAR(of[1][young], 6 * 0.4e3, 1);
  EXPECT_EQ(of[2][young], *find_preset("zygomaticus_major")->uniform[young]);
  options.uniform[young] = 192.4e3;
  of = layer_parameters(options);
  EXPECT_NEAR(of[0][young] / of[1][young], 3.18 / 0.4, 1e-9);
  EXPECT_EQ(of[2][young], 192.4e3);
  options.layers = {{.name = "own", .value = {1e4}}};
  EXPECT_EQ(layers_of(options).size(), 1u) << "the scene's own take the place of the preset's";
}

TEST(TissueLayers, WrongRowsAreNamed) {
  const auto first = [](const TissueFieldOptions& options) {
    std::vector<FieldProblem> problems;
    check_layers(options, problems);
    return problems.empty() ? "" : problems[0].key + ": " + problems[0].expected;
  };
  EXPECT_EQ(first(of_layers({{.thickness_m = 0.002, .factor = {2}}, {.name = "deep"}})), "");
  EXPECT_THAT(first(of_layers({{.name = "skin"}, {.name = "deep"}})),
              HasSubstr("layer[0].thickness_mm: a thickness, as only the last"));
  EXPECT_EQ(first(of_layers({{.thickness_m = -0.002, .factor = {2}}})),
            "layer[0].thickness_mm: a number above 0 to 40");
  EXPECT_EQ(first(of_layers({{.thickness_m = 0.002, .value = {1e4}, .factor = {2}}})),
            "layer[0]: either young_kpa or its factor");
  EXPECT_THAT(
      first(of_layers({{.thickness_m = 0.002}, {.factor = {std::nullopt, std::nullopt, 1.02}}})),
      testing::AllOf(HasSubstr("layer[1].poisson_factor: "),
                     HasSubstr("from -0.99 to 0.4999; it would be 0.5049")));
}

TEST(TissueLayers, ThatLieBeneathTheTissueAreNamed) {
  const VolumeMesh slab = slab_of_rows(0.006, 2);
  const auto problem = [&](const TissueFieldOptions& options) {
    const auto found = layer_beneath(options, slab);
    return found ? found->key + ": " + found->expected : "";
  };
  EXPECT_EQ(problem({}), "");
  EXPECT_EQ(problem(of_layers({{.thickness_m = 0.002}, {.thickness_m = 0.004}})), "");
  EXPECT_EQ(problem(of_layers({{.thickness_m = 0.002}, {.thickness_m = 0.0045}})),
            "layer[1].thickness_mm: a layer within the tissue: it ends 6.5 mm under the skin, and "
            "the tissue is at most 6.0 mm thick");
  EXPECT_THAT(problem(of_layers({{.thickness_m = 0.006}, {.name = "deep"}})),
              HasSubstr("layer[1]: a layer within the tissue: it begins 6.0 mm"));
  TissueFieldOptions preset;
  preset.preset = "skin_fat_deep";
  EXPECT_EQ(problem(preset), "");
  EXPECT_THAT(layer_beneath(preset, slab_of_rows(0.003, 2))->expected, HasSubstr(": fat ends 5.1"));
  EXPECT_EQ(layer_beneath(preset, slab_of_rows(0.003, 2))->key, "preset");
}

TEST(TissueLayers, ThatTheTissueIsTooThinForAreNoted) {
  VolumeMesh slab = slab_of_rows(0.006, 2);
  const TissueFieldOptions options = of_layers({{.thickness_m = 0.004}, {.name = "deep"}});
  EXPECT_TRUE(notes_on_layers(options, slab).empty());
  for (Eigen::Index v = 0; v < slab.thickness_m.size(); ++v)
    if (slab.outer.points(v, 1) < 0.0025) slab.thickness_m[v] = 0.003;
  const std::vector<Note> notes = notes_on_layers(options, slab);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0].id, "tissue.layers_end");
  EXPECT_THAT(notes[0].text,
              testing::AllOf(HasSubstr("begins 4.0 mm"), HasSubstr("under 17 % of the skin")));
}

TEST(TissueLayers, ThatAllHaveAThicknessMayFillTheTissueExactly) {
  VolumeMesh slab = slab_of_rows(0.006, 2);
  const TissueFieldOptions options = of_layers({{.thickness_m = 0.002}, {.thickness_m = 0.004}});
  EXPECT_TRUE(notes_on_layers(options, slab).empty());
  for (Eigen::Index v = 0; v < slab.thickness_m.size(); ++v)
    if (slab.outer.points(v, 1) < 0.0025) slab.thickness_m[v] = 0.003;
  const std::vector<Note> notes = notes_on_layers(options, slab);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0].text,
            "the layers end 6.0 mm under the skin; under 17 % of it the tissue is thinner");
}

}  // namespace
}  // namespace hyperex::tissue
