// SPDX-License-Identifier: GPL-3.0-or-later
// The thickness of the tissue from files with one row per vertex of the scan.
#include "hyperex/tissue/mesh/skin_depth.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>
#include <functional>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/anatomy/lips.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/tissue/mesh/on_skin.hpp"
#include "hyperex/tissue/per_vertex/per_vertex.hpp"
#include "support/refusal.hpp"
#include "support/test_file.hpp"

namespace hyperex::tissue {
using namespace anatomy;
namespace {
using testing::HasSubstr;
namespace fs = std::filesystem;

class SkinDepth : public testing::Test {
 protected:
  void SetUp() override { options_.element_size_m = 0.006; }

  /// A CSV of a column, a value a vertex of the embedded face; NaN: an empty cell.
  fs::path write(const std::string& name, const std::string& column,
                 const std::function<double(const Vec3&)>& value) const {
    std::ofstream out(folder_ / name);
    out.precision(17);
    out << column << ",other\n";
    for (const auto& row : face_.mesh.points.rowwise()) {
      const double one = value(row.transpose());
      if (!std::isnan(one)) out << one;
      out << ",0\n";
    }
    return folder_ / name;
  }
  TissueMesh built() const {
    return build_tissue_mesh(face_.mesh, face_.landmarks, options_, "embedded");
  }
  std::string refusal() const {
    return test::refusal([&] { notes_on_depth_files(options_, face_.mesh); });
  }

  const EmbeddedFace face_ = embedded_face();
  const TestFolder folder_;
  TissueMeshOptions options_;
};

TEST_F(SkinDepth, TheLayerIsAsThickAsTheFileSaysWhereItIsNotFolded) {
  // Linear in place, so that it is known between the scan's vertices too.
  const auto wanted = [](const Vec3& at) { return 7e-3 + 0.04 * at.x() + 0.01 * at.y(); };
  options_.depth_per_vertex =
      write("depth.csv", "thickness_mm", [&](const Vec3& at) { return 1e3 * wanted(at); });
  const TissueMesh mesh = built();
  const VolumeMesh& layer = mesh.volume;
  const SideTree tree = skin_tree(mesh, face_.landmarks);
  Eigen::Index as_wanted = 0;
  for (Eigen::Index v = 0; v < layer.surface_nodes(); ++v) {
    const Vec3 node = layer.outer.points.row(v).transpose();
    const double depth = wanted(node);
    // The node lies as far from the scan as the elements are coarse.
    const double off = tree.query(node, mesh.upper_margin[std::size_t(v)]).distance_m;
    as_wanted += std::abs(layer.thickness_m[v] - depth) < 1e-6 + 0.05 * off;
    EXPECT_LT(layer.thickness_m[v], depth + 1e-5 + 0.05 * off) << "node " << v;
  }
  EXPECT_GT(double(as_wanted), 0.9 * double(layer.surface_nodes()));
  // Straight through the layer: its inner nodes lie so far below.
  const Vec3 first = layer.nodes.row(layer.inner_node(0)) - layer.nodes.row(0);
  EXPECT_NEAR(first.norm(), layer.thickness_m[0], 1e-12);
}

TEST_F(SkinDepth, APaintedRegionBlendsIntoWhatHoldsElsewhere) {
  const auto share = [](const Vec3& at) { return std::clamp((at.x() - 0.01) / 0.02, 0.0, 1.0); };
  const Eigen::VectorXd before = skin_depth(built(), face_.landmarks, options_);
  options_.depth_regions = {{write("left.csv", "weight", share), 0.014}};
  const TissueMesh mesh = built();
  const Eigen::VectorXd after = skin_depth(mesh, face_.landmarks, options_);
  for (Eigen::Index v = 0; v < mesh.scan_vertices; ++v) {
    const double w = share(mesh.skin.points.row(v).transpose());
    ASSERT_NEAR(after[v], (1 - w) * before[v] + w * 0.014, 1e-9) << "vertex " << v;
  }
  // Applied in turn, the last one over all.
  options_.depth_regions.push_back(
      {write("all.csv", "weight", [](const Vec3&) { return 1; }), 0.005});
  EXPECT_NEAR((skin_depth(mesh, face_.landmarks, options_).array() - 0.005).abs().maxCoeff(), 0,
              1e-12);
  int thick = 0, all = 0;
  for (Eigen::Index v = 0; v < mesh.volume.surface_nodes(); ++v) {
    const Vec3 at = mesh.volume.outer.points.row(v).transpose();
    if (at.x() < 0.035) continue;
    ++all;
    thick += std::abs(mesh.volume.thickness_m[v] - 0.014) < 1e-9;
  }
  EXPECT_GT(all, 20);
  EXPECT_GT(thick, 0.8 * all);
}

TEST_F(SkinDepth, AnEmptyCellKeepsWhatTheOtherOptionsGive) {
  options_.thickness_m = 0.009;
  options_.depth_per_vertex = write("half.csv", "thickness_mm",
                                    [](const Vec3& at) { return at.x() > 0 ? 5 : std::nan(""); });
  const TissueMesh mesh = built();
  const Eigen::VectorXd depth = skin_depth(mesh, face_.landmarks, options_);
  for (Eigen::Index v = 0; v < mesh.scan_vertices; ++v)
    ASSERT_DOUBLE_EQ(depth[v], mesh.skin.points(v, 0) > 0 ? 0.005 : 0.009);
}

TEST_F(SkinDepth, WithoutFilesItIsThatOfTheLandmarksToTheLastBit) {
  const TissueMesh mesh = built();
  EXPECT_FALSE(is_painted(options_));
  EXPECT_EQ(skin_depth(mesh, face_.landmarks, options_),
            depth_field(mesh.skin.points, published_depths(), face_.landmarks));
}

TEST_F(SkinDepth, OfOneLipDoesNotRunOverToTheOther) {
  const TissueMesh plain = built();
  const std::vector<double>& margin = plain.skin_upper_margin;
  std::ofstream table(folder_ / "lower.csv");
  table << "weight\n";
  for (Eigen::Index v = 0; v < plain.scan_vertices; ++v)
    table << (margin[std::size_t(v)] < 0 ? 1 : 0) << "\n";
  table.close();
  options_.thickness_m = 0.006;
  options_.depth_regions = {{folder_ / "lower.csv", 0.012}};
  const TissueMesh mesh = built();
  const Vec3 lips[2] = {face_.landmarks.at(face::ibug(66)), face_.landmarks.at(face::ibug(62))};
  int seen[2] = {0, 0};
  for (Eigen::Index v = 0; v < mesh.volume.surface_nodes(); ++v) {
    const bool upper = mesh.upper_margin[std::size_t(v)] > 0;
    const Vec3 at = mesh.volume.outer.points.row(v).transpose();
    if ((at - lips[upper]).norm() > 0.008) continue;
    ++seen[upper];
    if (upper) {
      EXPECT_LT(mesh.volume.thickness_m[v], 0.006 + 1e-9);
    }
  }
  EXPECT_GT(std::min(seen[0], seen[1]), 3);
}

TEST_F(SkinDepth, OfAThinnedScanFilesNameAllItsVertices) {
  // A skin of two triangles; two of its three scan vertices were kept, and the one of the cut.
  auto full = std::make_shared<FullSkin>();
  full->skin.points = face_.mesh.points.topRows(4);
  full->skin.triangles.resize(1, 3);
  full->skin.triangles << 0, 1, 2;
  full->scan_vertices = 3;
  full->appended = {{1, 2, 0.25}};
  full->kept = {0, 2, 3};
  full->places.assign(4, {{0, 1, 2}, Vec3(1, 0, 0)});
  TissueMesh mesh;
  mesh.skin.points = full->skin.points({0, 2, 3}, Eigen::all);
  mesh.skin_upper_margin = {1, 1, 1};
  mesh.scan_vertices = 3;
  mesh.full = full;
  options_.depth_per_vertex = folder_ / "three.csv";
  std::ofstream(options_.depth_per_vertex) << "thickness_mm\n4\n8\n16\n";
  const Eigen::VectorXd depth = skin_depth(mesh, face_.landmarks, options_);
  ASSERT_EQ(depth.size(), 3);
  EXPECT_NEAR(depth[0], 0.004, 1e-12);
  EXPECT_NEAR(depth[1], 0.016, 1e-12);
  EXPECT_NEAR(depth[2], 0.75 * 0.008 + 0.25 * 0.016, 1e-12);
}

TEST_F(SkinDepth, AFileThatCannotServeIsRefusedInOneLine) {
  const auto all = [](double value) { return [value](const Vec3&) { return value; }; };
  const auto refused = [&](const fs::path& file) {
    options_.depth_per_vertex = file;
    const std::string text = refusal();
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    EXPECT_THAT(text, HasSubstr(file.filename().string()));
    return text;
  };
  EXPECT_EQ((options_.depth_per_vertex = write("a.csv", "thickness_mm", all(40)), refusal()), "");
  for (const double wrong : {-3.0, 0.0, 0.9, 41.0, 1e300})
    EXPECT_THAT(refused(write("a.csv", "thickness_mm", all(wrong))),
                HasSubstr("at vertex 0 (counted from 0): expected a number from 1 to 40"));
  EXPECT_THAT(refused(write("a.csv", "depth", all(8))), HasSubstr("thickness_mm"));
  std::ofstream(folder_ / "short.csv") << "thickness_mm\n8\n9\n";
  EXPECT_THAT(refused(folder_ / "short.csv"), HasSubstr("2 rows of thickness_mm: expected"));
  std::ofstream(folder_ / "torn.csv") << "thickness_mm\n8\nthick\n";
  EXPECT_NE(refused(folder_ / "torn.csv"), "");
  EXPECT_NE(refused(folder_ / "none.csv"), "");
  options_.depth_per_vertex.clear();
  options_.depth_regions = {{write("w.csv", "weight", all(1.5)), 0.01}};
  EXPECT_THAT(refusal(), HasSubstr("weight = 1.5 at vertex 0"));
  options_.depth_regions = {{write("w.csv", "weight", all(0)), 0.01}};
  EXPECT_THAT(refusal(), HasSubstr("every weight is 0"));
  EXPECT_THROW(built(), InputError);
}

}  // namespace
}  // namespace hyperex::tissue
