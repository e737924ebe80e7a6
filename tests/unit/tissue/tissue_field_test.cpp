// SPDX-License-Identifier: GPL-3.0-or-later
// Tissue parameters on a whole face: points, regions, scars, files, tetrahedra.
#include "hyperex/tissue/field/tissue_field.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/tissue/field/layers.hpp"
#include "hyperex/tissue/field/presets.hpp"
#include "hyperex/tissue/field/regions.hpp"
#include "support/refusal.hpp"
#include "support/test_file.hpp"

namespace hyperex::tissue {
using namespace anatomy;
namespace {
using testing::HasSubstr;

class Field : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const EmbeddedFace embedded = embedded_face();
    landmarks_ = new io::Landmarks(embedded.landmarks);
    TissueMeshOptions options;
    options.element_size_m = 0.006;
    mesh_ = new TissueMesh(build_tissue_mesh(embedded.mesh, *landmarks_, options, "embedded"));
    face_ = new RegisteredFace(register_canonical_face(*landmarks_, embedded.mesh));
    tree_ = new SideTree(mesh_->skin, mesh_->skin_upper_margin, Vec3::Zero(), 0);
    maker_ = new TissueFieldMaker(*mesh_, *landmarks_, face_);
  }
  static void TearDownTestSuite() {
    delete maker_;
    delete tree_;
    delete face_;
    delete mesh_;
    delete landmarks_;
  }
  static double at(const Eigen::VectorXd& skin, const Vec3& place) {
    return tree_->query(place, 0).value(skin);
  }
  static double at(const TissueField& field, const std::string& landmark, int p = young) {
    return at(field.skin[p], landmarks_->at(landmark));
  }
  static TissueFieldOptions with_region(const std::string& name, double factor) {
    TissueFieldOptions options;
    options.regions.push_back({.name = name, .factor = {factor}});
    return options;
  }
  static std::string refusal(const TissueFieldOptions& options) {
    return test::refusal<std::exception>([&] { maker_->make(options); });
  }

  static inline io::Landmarks* landmarks_;
  static inline TissueMesh* mesh_;
  static inline RegisteredFace* face_;
  static inline SideTree* tree_;
  static inline TissueFieldMaker* maker_;
};

TEST_F(Field, MeetsItsPointsAndLiesBetweenThemInBothWays) {
  for (const Interpolation way : {Interpolation::harmonic, Interpolation::linear}) {
    TissueFieldOptions options;
    options.preset = "source_model_2";
    options.interpolation = way;
    const TissueField field = maker_->make(options);
    const double near = way == Interpolation::harmonic ? 1e-9 : 0.01;  // of a triangle, linear
    for (const TissuePoint& point : find_preset(options.preset)->points)
      for (const char* side : {"", "_L", "_R"})
        for (const int p : {young, viscosity}) {
          if (!landmarks_->contains(point.landmark + side)) continue;
          EXPECT_NEAR(at(field, point.landmark + side, p) / *point.value[p], 1, near)
              << point.landmark + side;
        }
    for (const auto& [low, high, p] :
         {std::tuple{116.5e3, 216.9e3, young}, std::tuple{362.9, 453.0, viscosity}}) {
      EXPECT_GE(field.skin[p].minCoeff(), low);
      EXPECT_LE(field.skin[p].maxCoeff(), high);
      EXPECT_GE(*std::min_element(field.element[p].begin(), field.element[p].end()), low);
      EXPECT_LE(*std::max_element(field.element[p].begin(), field.element[p].end()), high);
    }
    EXPECT_TRUE(field.varies(young));
    EXPECT_FALSE(field.varies(poisson));
    EXPECT_EQ(field.element[poisson][0], 0.495);
  }
}

TEST_F(Field, OfModelsTwoAndThreeLiesAsFarAboveAsBelowModelOne) {
  std::array<TissueField, 3> model;
  for (int m = 0; m < 3; ++m) {
    TissueFieldOptions options;
    options.preset = "source_model_" + std::to_string(m + 1);
    model[std::size_t(m)] = maker_->make(options);
  }
  EXPECT_LT((model[1].skin[young] + model[2].skin[young] - 2 * model[0].skin[young])
                .lpNorm<Eigen::Infinity>(),
            1e-3);
  // The upper lips differ most, the corners of the mouth hold their values.
  EXPECT_NEAR(at(model[1], "cheilion_R"), 116.5e3, 1);
}

TEST_F(Field, MirroredIsTheMirrorImage) {
  // The embedded face is its own mirror image to a fraction of a millimetre.
  for (const auto way : {Interpolation::harmonic, Interpolation::linear}) {
    TissueFieldOptions options;
    options.mirror = true;
    options.interpolation = way;
    options.points = {{"cheek_L", "", {2e5}}, {"cheilion", "R", {1e5}}, {"glabella", "", {3e5}}};
    options.regions.push_back({.name = "upper_lip_L", .factor = {2}});
    options.regions.push_back(
        {.scar = {"cheek_R", "cheilion_R"}, .width_m = 0.008, .value = {6e5}});
    const Eigen::VectorXd u = maker_->make(options).skin[young];
    double apart = 0;
    for (Eigen::Index v = 0; v < mesh_->scan_vertices; v += 7) {
      Vec3 mirrored = mesh_->skin.points.row(v);
      mirrored.x() *= -1;
      if (std::abs(mesh_->skin_upper_margin[v]) > 0.006)  // beside the lips' rims
        apart = std::max(apart, std::abs(at(u, mirrored) - u[v]));
    }
    EXPECT_LT(apart, 0.06 * (u.maxCoeff() - u.minCoeff())) << int(way);
  }
}

TEST_F(Field, RegionsAreWhereTheirNamesSay) {
  const RegionMap map(*mesh_, *landmarks_, *face_);
  const auto depth_mm = [&](const std::string& region, const std::string& landmark) {
    return 1e3 * at(map.depth(region), landmarks_->at(landmark));
  };
  for (const FacialRegion& region : facial_regions())
    for (const char* side : {"", "_L", "_R"}) {
      const std::string name = region.name + side;
      const Eigen::VectorXd depth = map.depth(name);
      EXPECT_GT((depth.array() > 0).count(), 5) << name;
      if (!name.starts_with("face")) {
        EXPECT_LT((depth.array() > 0).count(), 0.5 * double(depth.size())) << name;
      }
    }
  EXPECT_GT(depth_mm("cheek_R", "cheek_R"), 3);
  EXPECT_LT(depth_mm("cheek_R", "cheek_L"), -3);
  EXPECT_GT(depth_mm("cheek", "cheek_L"), 3);
  EXPECT_GT(depth_mm("nose", "pronasale"), 3);
  EXPECT_LT(depth_mm("nose", "cheek_L"), -3);
  EXPECT_GT(depth_mm("chin", "pogonion"), 3);
  EXPECT_GT(depth_mm("mouth", "cheilion_L"), 3);
  EXPECT_LT(depth_mm("lips", "subnasale"), -3);
  EXPECT_GT(depth_mm("face_L", "exocanthion_L"), 5);
  EXPECT_LT(depth_mm("face_L", "exocanthion_R"), -5);
  EXPECT_NEAR(depth_mm("face_L", "pronasale"), 0, 0.5);
}

TEST_F(Field, LipsThatTouchAreToldApart) {
  const RegionMap map(*mesh_, *landmarks_, *face_);
  const Eigen::VectorXd upper = map.depth("upper_lip"), lower = map.depth("lower_lip");
  int upper_count = 0, lower_count = 0;
  for (Eigen::Index v = 0; v < upper.size(); ++v) {
    const double margin = mesh_->skin_upper_margin[v];
    if (margin > 0.008) {
      EXPECT_LE(lower[v], 0) << v;
      upper_count += upper[v] > 0;
    } else if (margin < -0.008) {
      EXPECT_LE(upper[v], 0) << v;
      lower_count += lower[v] > 0;
    }
  }
  EXPECT_GT(upper_count, 20);
  EXPECT_GT(lower_count, 20);
}

TEST_F(Field, FactorsHoldInsideFadeOverTheBlendAndEndOutside) {
  const TissueField field = maker_->make(with_region("cheek_R", 5));
  EXPECT_NEAR(at(field, "cheek_R"), 5 * 192.4e3, 1);
  EXPECT_EQ(at(field, "cheek_L"), 192.4e3);
  EXPECT_EQ(field.skin[young].minCoeff(), 192.4e3);
  EXPECT_EQ(field.skin[viscosity].maxCoeff(), 476.8);
  EXPECT_DOUBLE_EQ(region_share(0, 0.004), 0.5);
  EXPECT_EQ(region_share(0.002, 0.004), 1);
  EXPECT_EQ(region_share(-0.002, 0.004), 0);
  EXPECT_EQ(region_share(1e-9, 0), 1);
  // Elements on the right cheek, through the thickness, and nowhere else.
  const auto& volume = mesh_->volume;
  for (Eigen::Index t = 0; t < volume.tets.rows(); ++t) {
    const double e = field.element[young][std::size_t(t)];
    Vec3 outer = Vec3::Zero();
    for (int k = 0; k < 4; ++k)
      outer += volume.outer.points.row(volume.tets(t, k) % volume.surface_nodes()).transpose() / 4;
    if ((outer - landmarks_->at("cheek_R")).norm() < 0.005) {
      EXPECT_NEAR(e, 5 * 192.4e3, 1);
    }
    if (outer.x() > 0.002) {
      EXPECT_EQ(e, 192.4e3);
    }
  }
}

TEST_F(Field, LayersOfFactorOneChangeNothingToTheBit) {
  TissueFieldOptions options = with_region("cheek_R", 5);
  options.points = {{"cheilion", "", {std::nullopt, 300}}};
  const TissueField plain = maker_->make(options);
  options.layers = {{.name = "skin", .thickness_m = 0.002, .factor = {1, 1, 1, 1}},
                    {.name = "fat", .thickness_m = 0.0027, .factor = {1, 1, 1, 1}},
                    {.name = "deep"}};
  const TissueField layered = maker_->make(options);
  ASSERT_EQ(layered.deeper.size(), 2u);
  for (int p = 0; p < parameter_count; ++p) {
    EXPECT_EQ(layered.skin[p], plain.skin[p]);
    EXPECT_EQ(layered.element[p], plain.element[p]);
  }
  EXPECT_TRUE(plain.deeper.empty() && plain.layer_share.size() == 0 && plain.notes.empty());
}

TEST_F(Field, RegionsMultiplyLayersAndPointsReplaceThem) {
  TissueFieldOptions options;
  options.layers = {{.name = "skin", .thickness_m = 0.002, .value = {8e5, 300}}, {.name = "deep"}};
  const TissueField alone = maker_->make(options);
  EXPECT_TRUE(is_graded(options) && alone.varies_within(young) && !alone.varies(young));
  EXPECT_FALSE(alone.varies_within(density));
  const Eigen::MatrixXd share = layer_shares(options, mesh_->volume);
  for (Eigen::Index t = 0; t < share.rows(); ++t)
    EXPECT_NEAR(alone.element[young][std::size_t(t)], 192.4e3 + share(t, 0) * (8e5 - 192.4e3),
                1e-6);
  EXPECT_EQ(std::ranges::min(alone.element[young]), 192.4e3) << "elements under the skin";
  options.regions = with_region("cheek_R", 5).regions;
  options.points = {{"cheilion", "", {std::nullopt, 400}}};
  const TissueField changed = maker_->make(options);
  const TissueField factor = maker_->make(with_region("cheek_R", 5));
  for (std::size_t t = 0; t < changed.element[young].size(); ++t) {
    EXPECT_NEAR(changed.element[young][t] / alone.element[young][t],
                factor.element[young][t] / 192.4e3, 1e-9);
    EXPECT_NEAR(changed.element[viscosity][t], 400, 1e-9) << "through the whole thickness";
  }
}

TEST_F(Field, LayersBeneathTheTissueAreRefused) {
  TissueFieldOptions options;
  options.layers = {{.thickness_m = 0.002, .factor = {2}}, {.thickness_m = 0.03, .factor = {0.5}}};
  EXPECT_THAT(refusal(options),
              testing::AllOf(HasSubstr("tissue.layer[1].thickness_mm: expected a layer within"),
                             HasSubstr("it ends 32.0 mm under the skin")));
  options.layers = {{.name = "skin"}, {.name = "deep"}};
  const auto problems = problems_of(options, *landmarks_);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "layer[0].thickness_mm");
}

TEST_F(Field, ScarsRunOnTheSkinBetweenTheirLandmarks) {
  TissueFieldOptions options;
  options.regions.push_back({.scar = {"exocanthion_R", "cheek_R", "cheilion_R"},
                             .width_m = 0.006,
                             .blend_m = 0.002,
                             .value = {9e5}});
  const TissueField field = maker_->make(options);
  for (const char* name : {"exocanthion_R", "cheek_R", "cheilion_R"})
    EXPECT_NEAR(at(field, name), 9e5, 1) << name;
  const Vec3 half = 0.5 * (landmarks_->at("cheek_R") + landmarks_->at("cheilion_R"));
  EXPECT_NEAR(at(field.skin[young], half), 9e5, 1);
  EXPECT_EQ(at(field.skin[young], half + Vec3(-0.014, 0, 0)), 192.4e3);
  const Vec3 p = landmarks_->at("cheek_R"), q = landmarks_->at("cheilion_R");
  TissueFieldOptions by_places;
  by_places.regions.push_back({.scar_points_m = {{p.x(), p.y(), p.z()}, {q.x(), q.y(), q.z()}},
                               .width_m = 0.016,
                               .factor = {2}});
  EXPECT_NEAR(at(maker_->make(by_places).skin[young], half), 2 * 192.4e3, 1);
}

TEST_F(Field, EmptyRegionsAndParametersOutOfRangeAreRefused) {
  TissueFieldOptions far;
  far.regions.push_back({.scar_points_m = {{0.5, 0, 0}, {0.6, 0, 0}}, .factor = {2}});
  EXPECT_THAT(refusal(far), HasSubstr("region[0].scar_points_mm: expected points within 15 mm"));
  TissueFieldOptions thin;
  const Vec3 near = landmarks_->at("cheek_R") + Vec3(0.0007, 0.0005, 0);
  thin.regions.push_back(
      {.scar_points_m = {{near.x(), near.y(), near.z()}, {near.x() + 1e-5, near.y(), near.z()}},
       .width_m = 1e-5,
       .blend_m = 0,
       .factor = {2}});
  EXPECT_THAT(refusal(thin), HasSubstr("it is empty"));
  TissueFieldOptions squeezed;
  squeezed.regions.push_back({.name = "nose", .factor = {std::nullopt, std::nullopt, 1.02}});
  EXPECT_THAT(refusal(squeezed), HasSubstr("region[0].poisson_factor"));
  EXPECT_THAT(refusal(squeezed), HasSubstr("from -0.99 to 0.4999"));
  // A scan that ends below the brows has no forehead.
  TissueMesh low = *mesh_;
  std::vector<int> kept;
  for (int f = 0; f < low.skin.triangles.rows(); ++f) {
    bool below = true;
    for (int k = 0; k < 3; ++k) below &= low.skin.points(low.skin.triangles(f, k), 1) < 0.02;
    if (below) kept.push_back(f);
  }
  Triangles triangles(Eigen::Index(kept.size()), 3);
  for (std::size_t i = 0; i < kept.size(); ++i)
    triangles.row(Eigen::Index(i)) = low.skin.triangles.row(kept[i]);
  low.skin.triangles = triangles;
  for (Eigen::Index v = 0; v < low.skin.points.rows(); ++v)
    low.skin.points(v, 1) = std::min(low.skin.points(v, 1), 0.02);
  try {
    TissueFieldMaker(low, *landmarks_, face_).make(with_region("forehead", 2));
    FAIL();
  } catch (const FieldError& error) {
    EXPECT_EQ(error.problem.key, "region[0].name");
    EXPECT_THAT(error.problem.expected, HasSubstr("it is empty"));
  }
}

TEST_F(Field, ProblemsAreFoundBeforeAnythingIsBuilt) {
  const auto first = [](const TissueFieldOptions& options) {
    const auto problems = problems_of(options, *landmarks_);
    return problems.empty() ? std::string() : problems[0].key + ": " + problems[0].expected;
  };
  EXPECT_EQ(first(with_region("cheek_R", 2)), "");
  EXPECT_THAT(first(with_region("cheeks", 2)), HasSubstr("region[0].name"));
  TissueFieldOptions both = with_region("cheek_R", 2);
  both.regions[0].scar = {"cheek_R", "cheek_L"};
  EXPECT_THAT(first(both), HasSubstr("region[0]: one of name, scar"));
  TissueFieldOptions nothing = with_region("cheek_R", 2);
  nothing.regions[0].factor = {};
  EXPECT_THAT(first(nothing), HasSubstr("region[0]: a value, a factor or a volume"));
  TissueFieldOptions twice = with_region("cheek_R", 2);
  twice.regions.push_back({.name = "cheek_L", .factor = {3}});
  EXPECT_EQ(first(twice), "");
  twice.mirror = true;
  EXPECT_THAT(first(twice), HasSubstr("region[1].name: one side alone"));
  TissueFieldOptions unknown;
  unknown.preset = "granite";
  EXPECT_THAT(first(unknown), HasSubstr("preset: "));
  TissueFieldOptions scar;
  scar.regions.push_back({.scar = {"cheek_R", "antenna"}, .factor = {2}});
  EXPECT_THAT(first(scar), HasSubstr("antenna is none"));
}

TEST_F(Field, IsReadFromFilesOfVertices) {
  const TestFolder folder;
  const std::filesystem::path csv = folder / "young.csv", ply = folder / "young.ply";
  const Eigen::Index count = mesh_->scan_vertices;
  Eigen::VectorXf young_kpa(count);
  std::ofstream table(csv);
  table << "young_kpa,other\n";
  for (Eigen::Index v = 0; v < count; ++v) {
    young_kpa[v] = 100 + float(v % 50);
    if (v == 3)
      table << ",0\n";
    else
      table << young_kpa[v] << ",0\n";
  }
  table.close();
  io::write_ply(ply, {mesh_->skin.points.topRows(count), embedded_face().mesh.triangles},
                io::LengthUnit::metre, {{"young_kpa", young_kpa}});
  for (const auto& file : {csv, ply}) {
    TissueFieldOptions options;
    options.per_vertex = file;
    const TissueField field = maker_->make(options);
    EXPECT_EQ(field.skin[young][17], 117e3);
    EXPECT_EQ(field.skin[young][3], file == csv ? 192.4e3 : 103e3);  // an empty cell
    EXPECT_EQ(field.skin[viscosity][17], 476.8);
  }
  std::ofstream(csv) << "young_kpa\n1\n2\n";
  TissueFieldOptions options;
  options.per_vertex = csv;
  EXPECT_THAT(refusal(options), HasSubstr("2 rows of young_kpa: expected"));
  std::ofstream(csv) << "stiffness\n1\n";
  EXPECT_THAT(refusal(options), HasSubstr("no values per vertex"));
  young_kpa[5] = -1;
  io::write_ply(ply, {mesh_->skin.points.topRows(count), embedded_face().mesh.triangles},
                io::LengthUnit::metre, {{"young_kpa", young_kpa}});
  options.per_vertex = ply;
  EXPECT_THAT(refusal(options), HasSubstr("young_kpa = -1 at vertex 5"));
}

TEST_F(Field, APaintedRegionChangesAsMuchAsItIsPainted) {
  const TestFolder folder;
  const std::filesystem::path csv = folder / "paint.csv", ply = folder / "paint.ply";
  const Eigen::Index count = mesh_->scan_vertices;
  const TriMesh scan{mesh_->skin.points.topRows(count), embedded_face().mesh.triangles};
  io::VertexColours colours(count, 4);
  std::ofstream table(csv);
  table << "weight\n";
  for (Eigen::Index v = 0; v < count; ++v) {
    // Red, half red, white, grey and black after each other.
    const std::array<std::array<int, 3>, 5> paint{
        {{255, 0, 0}, {255, 127, 127}, {255, 255, 255}, {90, 90, 90}, {0, 0, 0}}};
    const auto& c = paint[std::size_t(v % 5)];
    colours.row(v) << std::uint8_t(c[0]), std::uint8_t(c[1]), std::uint8_t(c[2]), 255;
    table << (v % 5 == 0 ? 1.0 : v % 5 == 1 ? 128 / 255.0 : 0.0) << "\n";
  }
  table.close();
  io::write_ply(ply, scan, io::LengthUnit::metre, {}, colours);
  TissueFieldOptions options;
  options.regions.resize(1);
  options.regions[0].factor[young] = 3;
  for (const auto& file : {csv, ply}) {
    options.regions[0].painted = file;
    const TissueField field = maker_->make(options);
    for (const auto& [vertex, factor] :
         {std::pair{10, 3.0}, {11, 1 + 2 * 128 / 255.0}, {12, 1.0}, {13, 1.0}, {14, 1.0}})
      EXPECT_NEAR(field.skin[young][vertex], factor * 192.4e3, 2) << file << " vertex " << vertex;
    EXPECT_EQ(field.skin[viscosity][10], 476.8);
  }
  colours.setConstant(255);
  io::write_ply(ply, scan, io::LengthUnit::metre, {}, colours);
  // Reported where the files are read, before anything is simulated.
  EXPECT_THAT(refusal(options), HasSubstr("nothing is painted red"));
  EXPECT_THROW(notes_on_files(options, scan), InputError);
  io::write_ply(ply, scan, io::LengthUnit::metre, {});
  EXPECT_THAT(refusal(options), HasSubstr("nothing painted"));
  std::ofstream(csv) << "weight\n0.5\n2\n";
  options.regions[0].painted = csv;
  EXPECT_THAT(refusal(options), HasSubstr("2 painted vertices: expected"));
  options.mirror = true;
  const auto problems = problems_of(options, *landmarks_);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "region[0].painted");
}

TEST_F(Field, AddedVolumeIsWhatWasAskedFor) {
  TissueFieldOptions options;
  EXPECT_TRUE(maker_->make(options).volume_ratio.empty());
  options.regions = {{.name = "cheek_L", .volume_m3 = 2e-6}, {.name = "lips", .volume_m3 = -5e-7}};
  const TissueField field = maker_->make(options);
  ASSERT_EQ(field.volume_ratio.size(), std::size_t(mesh_->volume.tets.rows()));
  double gained = 0;
  for (Eigen::Index t = 0; t < mesh_->volume.tets.rows(); ++t)
    gained += (field.volume_ratio[std::size_t(t)] - 1) *
              quality_of(mesh_->volume.nodes, mesh_->volume.tets.row(t)).total_volume_mm3;
  EXPECT_NEAR(gained, 1500, 1e-6);
  EXPECT_GT(at(field.skin_volume_ratio, landmarks_->at("cheek_L")), 1.02);
  EXPECT_LT(at(field.skin_volume_ratio, landmarks_->at("labiale_inferius")), 0.98);
  EXPECT_EQ(at(field.skin_volume_ratio, landmarks_->at("cheek_R")), 1);
  EXPECT_FALSE(field.varies(young));
}

TEST_F(Field, RefusesVolumeThatTheTissueCannotTake) {
  TissueFieldOptions options;
  options.regions = {{.name = "lips", .volume_m3 = 2e-5}};
  EXPECT_THAT(refusal(options), testing::AllOf(HasSubstr("region[0].volume_ml"),
                                               HasSubstr("more than 2 times its volume")));
  options.regions = {{.name = "lips"}};
  const auto problems = problems_of(options, *landmarks_);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(problems[0].expected, HasSubstr("volume_ml = 2"));
}

TEST_F(Field, VolumesOfAllRegionsCountTogether) {
  TissueFieldOptions options;
  options.regions = {{.name = "cheek_L", .volume_m3 = 1.4e-5},
                     {.name = "cheek_L", .volume_m3 = 1.5e-5}};
  EXPECT_THAT(refusal(options),
              testing::AllOf(HasSubstr("region[1].volume_ml"), HasSubstr("all regions together"),
                             HasSubstr("alone takes up to")));
  options.regions = {{.name = "cheek_L", .volume_m3 = 2.6e-5},
                     {.name = "cheek_L", .volume_m3 = -1e-5}};
  EXPECT_NEAR(maker_->make(options).added_volume_m3, 1.6e-5, 1e-12);
}

TEST_F(Field, EachSideTakesTheVolumeThatIsMirrored) {
  TissueFieldOptions options;
  options.regions = {{.name = "cheek_L", .volume_m3 = 2e-6}};
  const double one = at(maker_->make(options).skin_volume_ratio, landmarks_->at("cheek_L"));
  options.mirror = true;
  const TissueField both = maker_->make(options);
  EXPECT_NEAR(both.added_volume_m3, 4e-6, 1e-15);
  EXPECT_NEAR(at(both.skin_volume_ratio, landmarks_->at("cheek_L")), one, 0.1 * (one - 1));
  EXPECT_NEAR(at(both.skin_volume_ratio, landmarks_->at("cheek_R")), one, 0.1 * (one - 1));
}

TEST_F(Field, RefusesLayersAndPointsThatAPresetTakesOutOfRange) {
  TissueFieldOptions layers;
  layers.preset = "skin_fat_deep";
  layers.uniform[young] = 1;  // the least that is allowed
  EXPECT_TRUE(problems_of(layers, *landmarks_).empty());
  EXPECT_EQ(refusal(layers),
            "tissue.preset: expected Young's modulus (kPa) of fat to stay from 0.001 to 1e+06 "
            "kPa; it would be 0.00016");
  layers.uniform[young] = 7;
  EXPECT_EQ(refusal(layers), "");
  layers.uniform[young] = 8e8;
  EXPECT_THAT(refusal(layers), HasSubstr(" of skin to stay"));
  TissueFieldOptions points;
  points.preset = "aged_skin";
  points.points = {{"cheek_L", "", {6e8}}, {"cheek_R", "", {1e5}}};
  EXPECT_THAT(refusal(points), testing::AllOf(HasSubstr("tissue.preset: expected"),
                                              HasSubstr(" at points to stay from"),
                                              HasSubstr("it would be 1.2e+06")));
  points.points[0].value[young] = 4e8;
  EXPECT_EQ(refusal(points), "");
}

TEST_F(Field, RefusesVolumeWhereNoTissueIs) {
  const auto csv = test_file("one_vertex.csv");
  std::ofstream table(csv);
  table << "weight\n";
  Eigen::Index nose = 0;
  (mesh_->skin.points.topRows(mesh_->scan_vertices).rowwise() -
   landmarks_->at("pronasale").transpose())
      .rowwise()
      .squaredNorm()
      .minCoeff(&nose);
  for (Eigen::Index v = 0; v < mesh_->scan_vertices; ++v) table << (v == nose) << "\n";
  table.close();
  TissueFieldOptions options;
  options.regions = {{.painted = csv, .volume_m3 = 1e-9}};
  const std::string message = refusal(options);
  EXPECT_TRUE(message.empty() || message.find("region[0].volume_ml") != std::string::npos)
      << message;
}

TEST(PaintedLips, PaintOfOneLipDoesNotRunOverToTheOther) {
  io::Landmarks landmarks;
  const TriMesh& closed = canonical_face().mesh;
  for (const auto& name : face::all_ibug())
    landmarks[name] = canonical_face().landmark(name, closed.points);
  TissueMeshOptions coarse;
  coarse.element_size_m = 0.006;
  const TissueMesh mesh = build_tissue_mesh(closed, landmarks, coarse, "closed");
  const std::vector<double>& margin = mesh.skin_upper_margin;
  const auto file = std::filesystem::temp_directory_path() / "hyperex_lower_lip.csv";
  std::ofstream table(file);
  table << "weight\n";
  for (Eigen::Index v = 0; v < mesh.scan_vertices; ++v) table << (margin[v] < 0) << "\n";
  table.close();
  TissueFieldOptions options;
  options.regions.push_back({.painted = file, .factor = {2.0}});
  const Eigen::VectorXd shares =
      TissueFieldMaker(mesh, landmarks, nullptr).region_shares(options, 0);
  int upper = 0, lower = 0;
  for (std::size_t i = 0; i < mesh.appended.size(); ++i) {
    const EdgePoint& e = mesh.appended[i];
    if (!(margin[e.a] * margin[e.b] < 0)) continue;
    const Eigen::Index own = mesh.scan_vertices + Eigen::Index(i);
    EXPECT_EQ(shares[own], margin[own] < 0 ? 1 : 0);
    ++(margin[own] < 0 ? lower : upper);
  }
  EXPECT_GT(std::min(lower, upper), 3);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace hyperex::tissue
