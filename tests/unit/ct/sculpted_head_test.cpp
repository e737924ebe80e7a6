// SPDX-License-Identifier: GPL-3.0-or-later
// A CT made from sculpted bones under a layer of known thickness: skin is where the distance from
// bone is 12 mm.
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <numeric>
#include <random>

#include "hyperex/ct/ct_face.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/io/scan.hpp"
#include "support/made_ct.hpp"

namespace hyperex::ct {
namespace {
namespace fs = std::filesystem;

const fs::path kBones = fs::path(HYPEREX_SHARED_DIR) / "data/bodyparts3d";
/// The sculpted surfaces are made shells of this half thickness, so that they need not be closed.
constexpr double kShell_mm = 0.8, kLayer_mm = 12;

TriMesh sculpted(std::initializer_list<const char*> names) {
  TriMesh all;
  for (const char* name : names) {
    TriMesh one = io::read_mesh(kBones / name, io::LengthUnit::millimetre);
    one.points = (one.points * face_from_patient().transpose()).eval();
    const Eigen::Index points = all.points.rows(), triangles = all.triangles.rows();
    all.points.conservativeResize(points + one.points.rows(), 3);
    all.triangles.conservativeResize(triangles + one.triangles.rows(), 3);
    all.points.bottomRows(one.points.rows()) = one.points;
    all.triangles.bottomRows(one.triangles.rows()) = one.triangles.array() + int(points);
  }
  return all;
}

/// From the chin to the brows, and from the tip of the nose to the ears.
Volume ct_of(const TriMesh& bone, const TriMesh& jaw, double spacing_mm) {
  const Vec3 low = 1e3 * jaw.points.colwise().minCoeff().transpose(),
             high = 1e3 * jaw.points.colwise().maxCoeff().transpose();
  Volume out;
  out.step_m = 1e-3 * spacing_mm * face_from_patient();
  const Vec3 from(low.x() - 25, low.y() - 20, low.z() - 5),
      to(high.x() + 25, high.y() + 50, high.z() + 30);
  out.size = {int((to.x() - from.x()) / spacing_mm), int((to.z() - from.z()) / spacing_mm),
              int((to.y() - from.y()) / spacing_mm)};
  out.origin_m = 1e-3 * Vec3(from.x(), from.y(), to.z());
  out.hu.resize(out.count());
  const SurfaceTree tree(bone);
  const test::MadeHead head{[](const Vec3& d) { return d.x() - kShell_mm - kLayer_mm; },
                            [](const Vec3& d) { return d.x() - kShell_mm; }, 0};
  tbb::parallel_for(0, out.size[2], [&](int k) {
    std::mt19937 random(unsigned(k) + 1);
    std::normal_distribution<double> noise(0, 30);
    for (int j = 0; j < out.size[1]; ++j)
      for (int i = 0; i < out.size[0]; ++i) {
        const ClosestPoint near = tree.query(out.place(i, j, k), 0.03);
        const double distance_mm = near.triangle < 0 ? 30 : 1e3 * std::sqrt(near.squared_distance);
        out.hu[out.at(i, j, k)] =
            float(std::max(-1024.0, head.hu(Vec3(distance_mm, 0, 0)) + noise(random)));
      }
  });
  return out;
}

TEST(SculptedHead, HasItsThickness) {
  if (!fs::exists(kBones)) GTEST_SKIP() << "needs " << kBones;
  const TriMesh jaw = sculpted({"mandible.stl"});
  SeriesVolume series;
  series.volume =
      ct_of(sculpted({"skull.stl", "maxilla.stl", "mandible.stl", "teeth.stl"}), jaw, 1.0);
  const Volume volume = series.volume;
  const CtFace face = face_of_series(std::move(series));
  std::vector<double> errors;
  for (Eigen::Index v = 0; v < face.skin.points.rows(); ++v) {
    const Vec3 p = face.skin.points.row(v), index = volume.index_of(p);
    bool inner = true;
    for (int a = 0; a < 3; ++a)
      inner = inner && index[a] > 14 && index[a] < volume.size[std::size_t(a)] - 15;
    if (inner && !std::isnan(face.thickness.shortest_m[v]))
      errors.push_back(std::abs(1e3 * face.thickness.shortest_m[v] - kLayer_mm));
  }
  ASSERT_GT(errors.size(), 5000u);
  std::sort(errors.begin(), errors.end());
  const double mean = std::accumulate(errors.begin(), errors.end(), 0.0) / double(errors.size()),
               at_95 = errors[errors.size() * 95 / 100];
  std::cout << "  shortest: mean " << mean << ", 95 % " << at_95 << ", greatest " << errors.back()
            << " mm of " << errors.size() << "; mandible "
            << (face.separated ? "parted at " : "not parted ") << face.level_hu << " HU\n";
  EXPECT_LT(mean, 0.5);
  EXPECT_LT(at_95, 1.5);
}

}  // namespace
}  // namespace hyperex::ct
