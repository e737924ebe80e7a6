// SPDX-License-Identifier: GPL-3.0-or-later
// The program must treat left and right alike: the mirrored tissue on the mirrored mesh under the
// mirrored motion must move as the mirror image.
#include <gtest/gtest.h>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/simulate/run/simulator.hpp"
#include "hyperex/tissue/field/tissue_field.hpp"
#include "simulate/small_face.hpp"

namespace hyperex {
namespace {

constexpr int kSamples = 10;

tissue::TissueMesh mirrored(tissue::TissueMesh mesh) {
  for (Points* points : {&mesh.skin.points, &mesh.volume.nodes, &mesh.volume.outer.points})
    points->col(0) *= -1;
  for (Triangles* triangles : {&mesh.skin.triangles, &mesh.volume.outer.triangles})
    triangles->col(1).swap(triangles->col(2));
  mesh.volume.tets.col(2).swap(mesh.volume.tets.col(3));
  return mesh;
}

io::Landmarks mirrored(const io::Landmarks& landmarks) {
  io::Landmarks out;
  for (const auto& [name, p] : landmarks)
    out[anatomy::mirrored_landmark(name)] = Vec3(-p.x(), p.y(), p.z());
  return out;
}

std::vector<std::string> mirrored(std::vector<std::string> names) {
  for (std::string& name : names) name = anatomy::mirrored_landmark(name);
  return names;
}

tissue::TissueFieldOptions mirrored(tissue::TissueFieldOptions options) {
  for (auto& point : options.points) point.landmark = anatomy::mirrored_landmark(point.landmark);
  for (auto& region : options.regions) region.scar = mirrored(region.scar);
  return options;
}

/// A crooked smile: the left corner moves farther, and the chin moves to the right.
Vec3 moves(const std::string& name, const Vec3& rest, int sample) {
  const double t = std::sin(0.3 * sample);
  if (rest.y() > -0.02) return Vec3::Zero();
  if (name == "ibug68_54") return t * Vec3(0.006, 0.004, -0.001);
  if (name == "ibug68_48") return t * Vec3(-0.002, 0.001, 0);
  return t * Vec3(-0.001, -0.003, 0);
}

class MirroredFace : public testing::TestWithParam<tissue::Interpolation> {};

TEST_P(MirroredFace, MovesAsTheMirrorImage) {
  Progress::silence(true);
  const auto face = simulate::test::small_face();
  const tissue::TissueMesh twin = mirrored(face.mesh);
  const io::Landmarks twin_landmarks = mirrored(face.landmarks);

  tissue::TissueFieldOptions tissue_options;
  tissue_options.interpolation = GetParam();
  tissue_options.points = {{"ibug68_48", "", {4e5, 900.}},
                           {"ibug68_54", "", {1e5, 300.}},
                           {"ibug68_8", "", {2e5, 500.}},
                           {"ibug68_27", "", {3e5, 400.}}};
  tissue_options.regions.push_back(
      {.scar = {"ibug68_36", "ibug68_48"}, .width_m = 0.01, .factor = {3}});
  const auto field =
      tissue::TissueFieldMaker(face.mesh, face.landmarks, nullptr).make(tissue_options);
  const auto twin_field =
      tissue::TissueFieldMaker(twin, twin_landmarks, nullptr).make(mirrored(tissue_options));
  ASSERT_TRUE(field.varies(tissue::young) && field.varies(tissue::viscosity));

  simulate::SimulationOptions options;
  options.solver.method = simulate::SolverMethod::direct;
  options.model.element = fem::ElementKind::tet4_star;
  options.time.step_s = 0.01;
  options.drive.points = simulate::test::seven_points();
  options.tissue.element = field.element;
  simulate::SimulationOptions twin_options = options;
  twin_options.tissue.element = twin_field.element;
  twin_options.drive.points = mirrored(options.drive.points);

  const auto motion = simulate::test::motion_of(face.landmarks, kSamples, 30, moves);
  const auto twin_motion = simulate::test::motion_of(
      twin_landmarks, kSamples, 30, [](const std::string& name, const Vec3& rest, int sample) {
        const Vec3 d =
            moves(anatomy::mirrored_landmark(name), Vec3(-rest.x(), rest.y(), rest.z()), sample);
        return Vec3(-d.x(), d.y(), d.z());
      });
  const auto result = simulate::simulate(face.mesh, face.landmarks, motion, options);
  const auto twin_result = simulate::simulate(twin, twin_landmarks, twin_motion, twin_options);
  Progress::silence(false);

  const auto& frames = result.performance.node_displacement_m;
  const auto& twin_frames = twin_result.performance.node_displacement_m;
  ASSERT_EQ(frames.size(), twin_frames.size());
  float most = 0, apart = 0, lopsided = 0;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    PointsF image = twin_frames[f];
    image.col(0) *= -1;
    most = std::max(most, frames[f].rowwise().norm().maxCoeff());
    apart = std::max(apart, (image - frames[f]).rowwise().norm().maxCoeff());
    lopsided = std::max(lopsided, (twin_frames[f] - frames[f]).rowwise().norm().maxCoeff());
  }
  RecordProperty("apart_over_most", std::to_string(apart / most));
  EXPECT_GT(most, 0.005F);
  EXPECT_GT(lopsided, 0.1F * most);  // the motion is not its own mirror image
  EXPECT_LT(apart, 2e-6F * most);    // single precision
}

INSTANTIATE_TEST_SUITE_P(Fields, MirroredFace,
                         testing::Values(tissue::Interpolation::harmonic,
                                         tissue::Interpolation::linear));

}  // namespace
}  // namespace hyperex
