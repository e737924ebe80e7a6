// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/eye_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::report {
namespace {

const anatomy::Eyeball kEye{{0.01, 0.02, 0.03}, Vec3(0.1, 0.2, 1).normalized(), 0.012};

TEST(EyeModel, LiesOnItsSphereAndCoversIt) {
  const TriMesh eye = placed_eye(kEye);
  for (Eigen::Index v = 0; v < eye.points.rows(); ++v)
    EXPECT_NEAR((eye.points.row(v).transpose() - kEye.centre).norm(), kEye.radius_m, 1e-12);
  const double sphere = 4 * M_PI * kEye.radius_m * kEye.radius_m;
  EXPECT_NEAR(triangle_areas(eye).sum(), sphere, 0.02 * sphere);
  const Points normals = vertex_normals(eye);
  for (Eigen::Index v = 0; v < eye.points.rows(); ++v)
    if (normals.row(v).norm() > 0.5) {
      EXPECT_GT(normals.row(v).dot(eye.points.row(v) - kEye.centre.transpose()), 0);
    }
}

TEST(EyeModel, HasADarkPupilAnIrisAndAWhiteWhereTheyAre) {
  const TriMesh eye = placed_eye(kEye);
  const render::VertexColours& colours = eye_model().colours;
  ASSERT_EQ(colours.rows(), eye.points.rows());
  for (Eigen::Index v = 0; v < eye.points.rows(); ++v) {
    const Vec3 out = (eye.points.row(v).transpose() - kEye.centre) / kEye.radius_m;
    // 4 and 11.7 mm across on a ball of 24 mm.
    const double off_mm = 12 * std::sin(std::acos(std::clamp(out.dot(kEye.gaze), -1.0, 1.0)));
    if (out.dot(kEye.gaze) < 0) continue;
    if (off_mm < 1.8) {
      EXPECT_LT(colours(v, 0), 20);
    } else if (off_mm > 2.2 && off_mm < 5.5) {
      EXPECT_LT(colours(v, 2), 100);
      EXPECT_GT(colours(v, 0), colours(v, 2)) << "brown";
    } else if (off_mm > 6.2) {
      EXPECT_GT(colours(v, 2), 160);
    }
  }
}

TEST(EyeModel, TurnsBothEyesToTheirGaze) {
  const Vec3 ahead = Vec3::UnitZ();
  const std::vector<anatomy::Eyeball> eyes = {{{-0.03, 0, 0}, ahead, 0.012},
                                              {{0.03, 0, 0}, ahead, 0.012}};
  const auto now = turned(eyes, {.right = {.up_rad = 0.2}, .left = {.left_rad = 0.3}});
  ASSERT_EQ(now.size(), 2u);
  EXPECT_EQ(now[1].centre, eyes[1].centre);
  EXPECT_NEAR((now[0].gaze - Vec3(0, std::sin(0.2), std::cos(0.2))).norm(), 0, 1e-12);
  EXPECT_NEAR((now[1].gaze - Vec3(std::sin(0.3), 0, std::cos(0.3))).norm(), 0, 1e-12);
  EXPECT_TRUE(turned({}, {}).empty());
}

TEST(EyeModel, LidsTakeItsLight) {
  // A lid over its upper half, close before it.
  TriMesh lid;
  lid.points.resize(4, 3);
  const double z = kEye.centre.z() + 0.0125;
  lid.points << -0.03, 0.022, z, 0.05, 0.022, z, 0.05, 0.06, z, -0.03, 0.06, z;
  lid.triangles.resize(2, 3);
  lid.triangles << 0, 1, 2, 0, 2, 3;
  const anatomy::Eyeball ahead{kEye.centre, Vec3::UnitZ(), kEye.radius_m};
  const Eigen::VectorXf light = light_on_eyes({ahead}, lid).front();
  const TriMesh eye = placed_eye(ahead);
  double above = 0, below = 0;
  int of_above = 0, of_below = 0;
  for (Eigen::Index v = 0; v < eye.points.rows(); ++v) {
    const Vec3 off = eye.points.row(v).transpose() - ahead.centre;
    if (off.z() < 0.9 * ahead.radius_m) continue;
    (off.y() > 0.003 ? above : below) += light[v];
    ++(off.y() > 0.003 ? of_above : of_below);
  }
  EXPECT_LT(above / of_above, 0.52);
  EXPECT_GT(below / of_below, 0.55);
  EXPECT_GE(light.minCoeff(), kLeastEyeLight) << "what lids cover at rest may show later";
}

}  // namespace
}  // namespace hyperex::report
