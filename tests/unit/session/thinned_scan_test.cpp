// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/thinned_scan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "hyperex/geometry/clean_mesh.hpp"
#include "hyperex/geometry/thin_mesh.hpp"
#include "support/sheet_mesh.hpp"

namespace hyperex::session {
namespace {

constexpr int kSheetCells = 12;
constexpr double kSheetSide_m = 0.012, kUvPerMetre = 20;

/// A flat sheet whose triangles have vertices of their own, as some files store a scan. Beyond
/// `seam_m` the texture goes on in another part of the image, 0.5 further right.
io::Scan unwelded_sheet(double seam_m) {
  const TriMesh sheet =
      test::sheet_mesh({kSheetCells, kSheetCells}, {kSheetSide_m, kSheetSide_m}).mesh;
  io::Scan scan;
  scan.texture.emplace();
  const Eigen::Index corners = 3 * sheet.triangles.rows();
  scan.mesh = {Points(corners, 3), Triangles(sheet.triangles.rows(), 3)};
  scan.corner_uv.resize(corners, 2);
  for (Eigen::Index f = 0; f < sheet.triangles.rows(); ++f) {
    double middle_m = 0;
    for (int k = 0; k < 3; ++k) middle_m += sheet.points(sheet.triangles(f, k), 0) / 3;
    for (int k = 0; k < 3; ++k) {
      const auto at = sheet.points.row(sheet.triangles(f, k));
      scan.mesh.points.row(3 * f + k) = at;
      scan.mesh.triangles(f, k) = int(3 * f + k);
      scan.corner_uv.row(3 * f + k) << float(kUvPerMetre * at[0] + (middle_m > seam_m ? 0.5 : 0)),
          float(kUvPerMetre * at[1]);
    }
  }
  return scan;
}

TEST(ThinnedScan, SeamsAreFoundAtRepeatedVertices) {
  const io::Scan scan = unwelded_sheet(kSheetSide_m / 2);
  const std::vector<char> seam = on_seams(scan);
  ASSERT_EQ(Eigen::Index(seam.size()), scan.mesh.points.rows());
  for (std::size_t v = 0; v < seam.size(); ++v)
    EXPECT_EQ(bool(seam[v]),
              std::abs(scan.mesh.points(Eigen::Index(v), 0) - kSheetSide_m / 2) < 1e-9)
        << v;
}

TEST(ThinnedScan, WithoutASeamRepeatedVerticesAreNone) {
  EXPECT_EQ(std::ranges::count(on_seams(unwelded_sheet(1)), 1), 0);
  io::Scan plain = unwelded_sheet(kSheetSide_m / 2);
  plain.texture.reset();
  EXPECT_TRUE(on_seams(plain).empty());
}

/// The thinned skin of a scan, and the skin before.
std::pair<TriMesh, tissue::FullSkin> thinned_skin(const io::Scan& scan) {
  const CleanMesh clean = clean_mesh(scan.mesh);
  const std::vector<char> seam = on_seams(scan);
  std::vector<char> held;
  for (const int v : clean.source_vertex) held.push_back(seam[std::size_t(v)]);
  const ThinMesh thin = thin_mesh(clean.mesh, {.edge_m = 3e-3}, held);
  return {thin.mesh, skin_before_thinning(scan, clean, thin)};
}

TEST(ThinnedScan, OfRepeatedVerticesKeepsEachTriangleInItsPartOfTheTexture) {
  const io::Scan scan = unwelded_sheet(kSheetSide_m / 2);
  const auto [skin, full] = thinned_skin(scan);
  constexpr int all = (kSheetCells + 1) * (kSheetCells + 1);
  EXPECT_LT(skin.points.rows(), all - 20) << "it was thinned";
  const io::Scan thinned = thinned_scan(scan, full, skin);
  ASSERT_EQ(thinned.corner_uv.rows(), 3 * skin.triangles.rows());
  for (Eigen::Index f = 0; f < skin.triangles.rows(); ++f) {
    double middle_m = 0;
    for (int k = 0; k < 3; ++k) middle_m += skin.points(skin.triangles(f, k), 0) / 3;
    for (int k = 0; k < 3; ++k) {
      const auto at = skin.points.row(skin.triangles(f, k));
      const double part = middle_m > kSheetSide_m / 2 ? 0.5 : 0;
      EXPECT_NEAR(thinned.corner_uv(3 * f + k, 0), kUvPerMetre * at[0] + part, 1e-5) << f;
      EXPECT_NEAR(thinned.corner_uv(3 * f + k, 1), kUvPerMetre * at[1], 1e-5) << f;
    }
  }
}

}  // namespace
}  // namespace hyperex::session
