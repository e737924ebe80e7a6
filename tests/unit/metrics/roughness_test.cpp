// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/roughness.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace hyperex::metrics {
namespace {

/// A sheet of 60 x 60 vertices, 1 mm apart, bent with a radius of 80 mm.
TriMesh sheet() {
  constexpr int n = 60;
  TriMesh mesh;
  mesh.points.resize(n * n, 3);
  mesh.triangles.resize(2 * (n - 1) * (n - 1), 3);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double turn = (i - n / 2) * 1e-3 / 0.08;
      mesh.points.row(n * i + j) << 0.08 * std::sin(turn), j * 1e-3, 0.08 * std::cos(turn);
    }
  int t = 0;
  for (int i = 0; i + 1 < n; ++i)
    for (int j = 0; j + 1 < n; ++j) {
      const int a = n * i + j;
      mesh.triangles.row(t++) << a, a + n, a + 1;
      mesh.triangles.row(t++) << a + 1, a + n, a + n + 1;
    }
  return mesh;
}

template <class F>
Roughness of(const TriMesh& mesh, F normal_mm) {
  PointsF d = PointsF::Zero(mesh.points.rows(), 3);
  for (Eigen::Index v = 0; v < mesh.points.rows(); ++v) {
    const Vec3 p = mesh.points.row(v).transpose();
    d.row(v) = (1e-3 * normal_mm(1e3 * p.x(), 1e3 * p.y()) * Vec3(p.x(), 0, p.z()).normalized())
                   .template cast<float>()
                   .transpose();
  }
  return roughness(mesh, d);
}

TEST(Roughness, OfAShiftATurnAndASlopeIsNone) {
  const TriMesh mesh = sheet();
  PointsF shift = PointsF::Zero(mesh.points.rows(), 3);
  shift.rowwise() = Eigen::RowVector3f(0.01F, -0.02F, 0.005F);
  EXPECT_LT(roughness(mesh, shift).rms_mm, 5e-3);
  const Eigen::AngleAxisd turn(0.1, Vec3(1, 2, 3).normalized());
  const Points turned = mesh.points * turn.toRotationMatrix().transpose() - mesh.points;
  EXPECT_LT(roughness(mesh, turned.cast<float>()).rms_mm, 5e-3);
  EXPECT_LT(of(mesh, [](double, double y) { return 0.2 * y; }).rms_mm, 5e-3);
  EXPECT_GT(roughness(mesh, shift).judged, 40 * 40);
}

/// Brows at y = 10 mm, the corners of the mouth at y = 45 mm.
TEST(Roughness, OfADentIsThatOfItsPart) {
  const TriMesh mesh = sheet();
  io::Landmarks landmarks;
  for (int k = 17; k < 27; ++k) landmarks[fmt::format("ibug68_{}", k)] = Vec3(0, 0.010, 0.08);
  for (const int k : {48, 54}) landmarks[fmt::format("ibug68_{}", k)] = Vec3(0, 0.045, 0.08);
  const auto parts_of = [&](double at_mm) {
    PointsF d = PointsF::Zero(mesh.points.rows(), 3);
    for (Eigen::Index v = 0; v < mesh.points.rows(); ++v) {
      const Vec3 p = 1e3 * mesh.points.row(v).transpose();
      d(v, 2) = float(1e-3 * std::exp(-(p.x() * p.x() + std::pow(p.y() - at_mm, 2)) / 9));
    }
    return roughness_by_part(roughness(mesh, d), mesh.points, landmarks);
  };
  const auto brows = parts_of(15), corners = parts_of(45);
  ASSERT_EQ(brows.size(), 2u) << "no forehead and no chin";
  EXPECT_EQ(brows[0].part, "brows");
  EXPECT_EQ(brows[1].part, "corners");
  EXPECT_GT(brows[0].rms_mm, 0.05);
  EXPECT_LT(brows[1].rms_mm, 1e-6);
  EXPECT_LT(corners[0].rms_mm, 1e-6);
  EXPECT_GT(corners[1].rms_mm, 0.05);
}

TEST(Roughness, OfADentIsItsDepthAndWhereItIs) {
  const TriMesh mesh = sheet();
  const auto dent = [](double width_mm) {
    return [=](double x, double y) {
      return std::exp(-(x * x + (y - 30) * (y - 30)) / (width_mm * width_mm));
    };
  };
  const Roughness narrow = of(mesh, dent(2)), wide = of(mesh, dent(25));
  const Vec3 place = 1e3 * mesh.points.row(narrow.roughest).transpose();
  EXPECT_NEAR(place.x(), 0, 1.1);
  EXPECT_NEAR(place.y(), 30, 1.1);
  EXPECT_GT(narrow.greatest_mm, 0.6);
  EXPECT_LT(wide.greatest_mm, 0.06) << "a bulge as wide as a cheek is no roughness";
}

TEST(Roughness, OfAWaveFallsWithItsLength) {
  const TriMesh mesh = sheet();
  const auto wave = [&](double length_mm) {
    return of(mesh, [=](double, double y) { return 0.1 * std::sin(2 * M_PI * y / length_mm); })
        .rms_mm;
  };
  const double amplitude_rms = 0.1 / std::sqrt(2.0);
  EXPECT_GT(wave(5), 0.7 * amplitude_rms);
  EXPECT_LT(wave(5), 1.4 * amplitude_rms);
  EXPECT_LT(wave(40), 0.2 * wave(5));
}

TEST(Roughness, OfTooSmallASheetIsNotJudged) {
  TriMesh mesh;
  mesh.points.resize(3, 3);
  mesh.points << 0, 0, 0, 1e-3, 0, 0, 0, 1e-3, 0;
  mesh.triangles.resize(1, 3);
  mesh.triangles << 0, 1, 2;
  const Roughness none = roughness(mesh, PointsF::Zero(3, 3));
  EXPECT_EQ(none.judged, 0);
  EXPECT_EQ(none.roughest, -1);
}

}  // namespace
}  // namespace hyperex::metrics
