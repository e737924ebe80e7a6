// SPDX-License-Identifier: GPL-3.0-or-later
// Driven points reach their prescribed positions, a symmetric motion is not reported as asymmetric,
// and a one-sided one is: whole runs without pictures.
#include "hyperex/session/mirrored_twin.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/anatomy/register_face.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/run/run_scene.hpp"
#include "hyperex/tissue/field/tissue_field.hpp"
#include "unit/scene/scene_files.hpp"

namespace hyperex::session {
using namespace scene;
namespace {
namespace fs = std::filesystem;

const fs::path kSource = HYPEREX_SOURCE_DIR;

nlohmann::ordered_json run_of(const fs::path& file, std::vector<std::string> overrides) {
  Progress::silence(true);
  for (const char* off : {"output.vtu=false", "output.glb=false", "output.report=false"})
    overrides.push_back(off);
  const SceneFolder folder;
  return run::run_scene(read_scene(file, overrides), folder / "out");
}

/// The scene, the points to drive (or those of the scene) and the element size in mm.
struct Case {
  const char *file, *points, *element_mm;
};

class SymmetricMotion : public testing::TestWithParam<Case> {};

TEST_P(SymmetricMotion, EndsWhereItIsDrivenAndIsUndecided) {
  const auto& [file, points, element_mm] = GetParam();
  if (std::string(file).starts_with("bench") && !fs::exists(kSource / "../shared/data"))
    GTEST_SKIP() << "no ../shared/data";
  std::vector<std::string> overrides{std::string("mesh.element_size_mm=") + element_mm};
  if (*points) overrides.push_back(std::string("drive.points=") + points);
  const auto summary = run_of(kSource / file, overrides);
  // Where all points drive, some of the outline lie closer together than elements: only their mean
  // is met.
  EXPECT_LT(summary.at("driven_points_off_mm").get<double>(), *points ? 0.5 : 0.1);
  const auto& symmetry = summary.at("symmetry");
  EXPECT_TRUE(symmetry.at("mesh_floor").at("known").get<bool>());
  EXPECT_EQ(symmetry.at("undecided_samples"), symmetry.at("samples")) << symmetry.at("verdict");
  const auto& corners = symmetry.at("commissure");
  EXPECT_TRUE(corners.at("undecided").get<bool>());
  EXPECT_NEAR(corners.at("excursion_ratio_R_L").get<double>(), 1, 0.005);
  EXPECT_GT(corners.at("excursion_mm").at("L").get<double>(), 3);
  if (std::string(file) ==
      "examples/mouth_open.toml") {  // a symmetric face: 0.0104 is the resolution
    EXPECT_LT(symmetry.at("mesh_floor").at("xi_there").get<double>(), 2 * 0.0104)
        << "the mesh adds no more than the resolution";
  }
  for (const auto& pair : symmetry.at("excursions"))
    EXPECT_TRUE(pair.at("undecided").get<bool>()) << pair;
}

INSTANTIATE_TEST_SUITE_P(
    Meshes, SymmetricMotion,
    testing::Values(Case{"examples/mouth_open.toml", "", "3.3"},
                    Case{"examples/mouth_open.toml", "", "4"},
                    Case{"examples/mouth_open.toml", "all", "4"},
                    Case{"bench/scenes/subject_a_mouth_open.toml", "", "3.3"},
                    Case{"bench/scenes/subject_a_mouth_open_all.toml", "", "3.3"},
                    Case{"bench/scenes/subject_a_mouth_open_all.toml", "", "2.5"}),
    [](const auto& c) { return "case_" + std::to_string(c.index); });

TEST(OneSidedMotion, IsDecided) {
  const auto summary = run_of(kSource / "examples/one_sided_smile.toml", {});
  const auto& symmetry = summary.at("symmetry");
  EXPECT_FALSE(symmetry.at("commissure").at("undecided").get<bool>());
  EXPECT_EQ(symmetry.at("verdict").get<std::string>().find("undecided"), std::string::npos);
  EXPECT_LT(symmetry.at("commissure").at("mesh_floor_mm").get<double>(), 0.2)
      << "a driven point's floor is the resolution";
}

simulate::AlignedMotion two_points(const std::vector<std::string>& names) {
  simulate::AlignedMotion motion;
  motion.motion.names = names;
  motion.motion.time_s = {0, 1};
  motion.rest.resize(2, 3);
  motion.rest << 0.03, 0, 0, -0.031, 0.001, 0;
  Points moved = motion.rest;
  moved.row(0) += Eigen::RowVector3d(0.01, 0.02, 0.03);
  motion.motion.positions = {motion.rest, moved};
  return motion;
}

TEST(MirroredMotion, MovesEachPointAsItsCounterpartsMirrorImage) {
  const metrics::MidsagittalPlane plane;  // x = 0
  for (const auto& names : {std::vector<std::string>{"ibug68_54", "ibug68_48"}, {"12", "7"}}) {
    std::string why;
    const auto motion = two_points(names);
    const auto mirrored = mirrored_motion(motion, plane, names, why);
    ASSERT_TRUE(mirrored) << why;
    const Points d = mirrored->motion.positions[1] - motion.rest;
    EXPECT_LT(d.row(0).norm(), 1e-12);
    EXPECT_LT((d.row(1) - Eigen::RowVector3d(-0.01, 0.02, 0.03)).norm(), 1e-12) << names[1];
  }
}

TEST(MirroredMotion, NeedsCounterparts) {
  const metrics::MidsagittalPlane plane;
  std::string why;
  EXPECT_FALSE(mirrored_motion(two_points({"ibug68_54", "ibug68_51"}), plane, {"ibug68_54"}, why));
  EXPECT_NE(why.find("ibug68_54"), std::string::npos);
}

TEST(MirroredValues, TakeTheOtherSidesStiffnessAndVolume) {
  const anatomy::EmbeddedFace embedded = anatomy::embedded_face();
  tissue::TissueMeshOptions coarse;
  coarse.element_size_m = 0.007;
  const tissue::TissueMesh mesh =
      tissue::build_tissue_mesh(embedded.mesh, embedded.landmarks, coarse, "embedded");
  const anatomy::RegisteredFace face =
      anatomy::register_canonical_face(embedded.landmarks, embedded.mesh);
  const tissue::TissueFieldMaker maker(mesh, embedded.landmarks, &face);
  const auto field_of = [&](const char* name) {
    tissue::TissueFieldOptions options;
    options.regions = {{.name = name, .factor = {3.0}, .volume_m3 = 2e-6}};
    return maker.make(options);
  };
  const metrics::MidsagittalPlane plane = metrics::landmark_plane(embedded.landmarks);
  const tissue::TissueField left = field_of("cheek_L"), right = field_of("cheek_R");
  simulate::TissueValues mirrored;
  take_mirrored(left, mesh, plane, mirrored);
  const auto distance = [](const std::vector<double>& a, const std::vector<double>& b) {
    const Eigen::Map<const Eigen::VectorXd> x(a.data(), Eigen::Index(a.size())),
        y(b.data(), Eigen::Index(b.size()));
    return (x - y).norm();
  };
  ASSERT_EQ(mirrored.volume_ratio.size(), right.volume_ratio.size());
  EXPECT_LT(distance(mirrored.volume_ratio, right.volume_ratio),
            0.2 * distance(left.volume_ratio, right.volume_ratio));
  EXPECT_LT(distance(mirrored.element[tissue::young], right.element[tissue::young]),
            0.2 * distance(left.element[tissue::young], right.element[tissue::young]));
  take_mirrored(maker.make({}), mesh, plane, mirrored);
  EXPECT_TRUE(mirrored.volume_ratio.empty());

  // A skin that is stiffer on the left, over tissue that is alike on both sides.
  const auto layered = [&](const char* name) {
    tissue::TissueFieldOptions options;
    options.layers = {{.name = "skin", .thickness_m = 0.002, .factor = {8.0}}, {.name = "deep"}};
    if (*name) options.regions = {{.name = name, .factor = {3.0}}};
    return maker.make(options);
  };
  const tissue::TissueField stiff_left = layered("cheek_L"), stiff_right = layered("cheek_R");
  const std::vector<double>& of_right = stiff_right.element[tissue::young];
  take_mirrored(stiff_left, mesh, plane, mirrored);
  EXPECT_LT(distance(mirrored.element[tissue::young], of_right),
            0.2 * distance(stiff_left.element[tissue::young], of_right));
  const tissue::TissueField alike = layered("");
  const std::vector<double>& young = alike.element[tissue::young];
  EXPECT_GT(std::ranges::max(young), 1.5 * std::ranges::min(young));
  take_mirrored(alike, mesh, plane, mirrored);
  for (std::size_t t = 0; t < young.size(); ++t)
    EXPECT_NEAR(mirrored.element[tissue::young][t] / young[t], 1, 1e-12);
}

}  // namespace
}  // namespace hyperex::session
