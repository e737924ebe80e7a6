// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/teeth/tongue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hyperex/anatomy/teeth/dental_arch.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::anatomy {
namespace {

using Eigen::Index;

/// The frame of the arches themselves.
const face::FaceFrame kFrame = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};

double nearest_m(const Points& places, const Points& to) {
  double nearest = 1;
  for (Index v = 0; v < places.rows(); ++v)
    nearest = std::min(nearest, (to.rowwise() - places.row(v)).rowwise().norm().minCoeff());
  return nearest;
}

/// The highest vertex near a place of the plane.
double top_at(const TriMesh& mesh, double x, double z) {
  double top = -1;
  for (const auto& p : mesh.points.rowwise())
    if (std::abs(p.x() - x) < 1.2e-3 && std::abs(p.z() - z) < 1.5e-3) top = std::max(top, p.y());
  return top;
}

TEST(Tongue, LiesInsideTheLowerRowAndTouchesNothing) {
  for (const double breadth : {1.0, 0.8}) {
    const Teeth teeth = dental_arches({.scale = 1.1, .breadth = breadth});
    const TriMesh tongue = tongue_in(teeth, kFrame);
    ASSERT_GT(tongue.triangles.rows(), 0) << breadth;
    EXPECT_TRUE(boundary_loops(tongue.triangles).empty());
    for (const TriMesh* part :
         {&teeth.upper.crowns, &teeth.upper.gum, &teeth.lower.crowns, &teeth.lower.gum})
      EXPECT_GT(nearest_m(part->points, tongue.points), 1e-3) << breadth;
    // Each section lies between the lower molars and premolars beside it.
    const Points& crowns = teeth.lower.crowns.points;
    for (const auto& p : tongue.points.rowwise())
      for (Index v = 0; v < crowns.rows(); ++v) {
        if (std::abs(crowns(v, 2) - p.z()) > 1e-3 || std::abs(crowns(v, 0)) < 0.008) continue;
        ASSERT_LT(std::abs(p.x()), std::abs(crowns(v, 0))) << p;
      }
    EXPECT_NEAR(tongue.points.col(0).maxCoeff(), -tongue.points.col(0).minCoeff(), 2e-4);
    EXPECT_GT(tongue.points.col(0).maxCoeff(), 0.009) << "it fills the arch";
  }
}

TEST(Tongue, HasABluntTipBehindTheIncisorsAGrooveAndFallsToTheThroat) {
  const Teeth teeth = dental_arches();
  const TriMesh tongue = tongue_in(teeth, kFrame);
  double edge = -1, inner = 1;  // of the lower central incisors
  for (std::size_t f = 0; f < teeth.lower.tooth.size(); ++f)
    if (teeth.lower.tooth[f] % 10 == 1)
      for (int k = 0; k < 3; ++k) {
        const auto p = teeth.lower.crowns.points.row(teeth.lower.crowns.triangles(Index(f), k));
        edge = std::max(edge, p.y());
        inner = std::min(inner, p.z());
      }
  Index tip = 0;
  tongue.points.col(2).maxCoeff(&tip);
  EXPECT_LT(tongue.points(tip, 2), inner);
  EXPECT_GT(tongue.points(tip, 2), inner - 0.0065);
  EXPECT_LT(tongue.points(tip, 1), edge - 0.001);
  EXPECT_GT(tongue.points(tip, 1), edge - 0.007);
  const double front = tongue.points(tip, 2), back = tongue.points.col(2).minCoeff();
  double half = 0;  // 3 mm behind the tip
  for (const auto& p : tongue.points.rowwise())
    if (std::abs(p.z() - (front - 0.003)) < 6e-4) half = std::max(half, p.x());
  EXPECT_GT(half, 0.005) << "blunt";
  const double middle = front - 0.022;
  EXPECT_LT(top_at(tongue, 0, middle), top_at(tongue, 0.004, middle) - 2e-4) << "groove";
  // Over the crowns' tops, which stand lower at the molars than in front.
  EXPECT_LT(top_at(tongue, 0, front - 0.002), edge - 0.0015);
  EXPECT_GT(top_at(tongue, 0, middle), -2e-4) << "domed";
  EXPECT_LT(top_at(tongue, 0, back + 0.002), top_at(tongue, 0, middle) - 0.005) << "throat";
}

TEST(Tongue, NeedsARowWithRoomInside) {
  EXPECT_EQ(tongue_in({}, kFrame).triangles.rows(), 0);
  Teeth teeth = dental_arches();
  JawTeeth& lower = teeth.lower;
  teeth.upper = {};
  EXPECT_GT(tongue_in(teeth, kFrame).triangles.rows(), 0) << "without an upper row";
  // A cast: a bar across the row.
  const Index n = lower.crowns.points.rows();
  lower.crowns.points.conservativeResize(n + 60, 3);
  for (Index k = 0; k < 60; ++k)
    lower.crowns.points.row(n + k) =
        Vec3(0.0005 * double(k % 20), -0.004, -0.027 - 0.003 * double(k / 20)).transpose();
  EXPECT_EQ(tongue_in(teeth, kFrame).triangles.rows(), 0);
}

}  // namespace
}  // namespace hyperex::anatomy
