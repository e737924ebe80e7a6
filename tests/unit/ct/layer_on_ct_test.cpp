// SPDX-License-Identifier: GPL-3.0-or-later
// A layer of tissue that ends on the bone of a CT, beside one of the same thickness without it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hyperex/anatomy/bones.hpp"
#include "hyperex/ct/ct_face.hpp"
#include "hyperex/fem/form/assembler.hpp"
#include "hyperex/fem/solve/static_solve.hpp"
#include "hyperex/tissue/mesh/volume_mesh.hpp"
#include "support/made_ct.hpp"

namespace hyperex::ct {
namespace {

constexpr double kSkin_m = 0.046, kBone_m = 0.036;

/// The cap of a ball within 40 degrees of the z axis, in rings of triangles.
TriMesh cap(double radius_m, int rings, int around) {
  TriMesh out{Points(1 + rings * around, 3), Triangles(around * (2 * rings - 1), 3)};
  out.points.row(0) << 0, 0, radius_m;
  const auto at = [&](int ring, int k) { return 1 + (ring - 1) * around + k % around; };
  for (int ring = 1; ring <= rings; ++ring)
    for (int k = 0; k < around; ++k) {
      const double polar = 40 * std::numbers::pi / 180 * ring / rings,
                   turn = 2 * std::numbers::pi * k / around;
      out.points.row(at(ring, k)) << radius_m * std::sin(polar) * std::cos(turn),
          radius_m * std::sin(polar) * std::sin(turn), radius_m * std::cos(polar);
    }
  int f = 0;
  for (int k = 0; k < around; ++k) out.triangles.row(f++) << 0, at(1, k), at(1, k + 1);
  for (int ring = 1; ring < rings; ++ring)
    for (int k = 0; k < around; ++k) {
      out.triangles.row(f++) << at(ring, k), at(ring + 1, k), at(ring + 1, k + 1);
      out.triangles.row(f++) << at(ring, k), at(ring + 1, k + 1), at(ring, k + 1);
    }
  return out;
}

/// Displacements of the skin (m) where the inner surface is held and a patch is pulled sideways.
Points pulled(const tissue::VolumeMesh& mesh) {
  fem::Material tissue;
  const auto tets = std::size_t(mesh.tets.rows());
  tissue.young_pa.assign(tets, 2e4);
  tissue.poisson.assign(tets, 0.45);
  tissue.viscosity_pa_s.assign(tets, 100);
  tissue.density_kg_m3.assign(tets, 1000);
  const fem::Assembler assembler(mesh.nodes, mesh.tets, fem::ElementKind::tet4_star);
  fem::System system;
  assembler.assemble(tissue, system);
  std::vector<int> held;
  for (int v = 0; v < mesh.surface_nodes(); ++v)
    for (int axis = 0; axis < 3; ++axis) held.push_back(3 * mesh.inner_node(v) + axis);
  Eigen::VectorXd force = Eigen::VectorXd::Zero(3 * mesh.nodes.rows());
  for (int v = 0; v < mesh.surface_nodes(); ++v)
    if (mesh.outer.points(v, 2) > 0.99 * kSkin_m) force.segment<3>(3 * v) << 0.01, 0, 0.005;
  const Eigen::VectorXd d = fem::StaticSolver(system.stiffness, held)
                                .solve(Eigen::VectorXd::Zero(Eigen::Index(held.size())), force);
  return Eigen::Map<const Points>(d.data(), mesh.surface_nodes(), 3);
}

TEST(LayerOnCt, IsThatOfTheSameThickness) {
  SeriesVolume series;
  series.volume = test::volume_of(
      {test::ball({0, 0, 0}, 1e3 * kSkin_m), test::ball({0, 0, 0}, 1e3 * kBone_m), 30}, {0, 0, 0},
      Vec3::Constant(108), {1, 1, 1});
  const CtFace face = face_of_series(std::move(series));
  const anatomy::Bones bones(face.bones.skull, {});
  const TriMesh skin = cap(kSkin_m, 12, 36);
  const Eigen::VectorXd table = Eigen::VectorXd::Constant(skin.points.rows(), 0.006);
  const tissue::VolumeMesh on_bone = tissue::build_volume_mesh(skin, table, {.bones = &bones});
  const tissue::VolumeMesh plain = tissue::build_volume_mesh(
      skin, Eigen::VectorXd::Constant(skin.points.rows(), kSkin_m - kBone_m));
  EXPECT_LT((on_bone.thickness_m.array() - (kSkin_m - kBone_m)).abs().maxCoeff(), 3e-4);
  const Points a = pulled(on_bone), b = pulled(plain);
  const double most = b.rowwise().norm().maxCoeff();
  std::cout << "  greatest displacement " << 1e3 * most << " mm, difference "
            << 1e3 * (a - b).rowwise().norm().maxCoeff() << " mm\n";
  EXPECT_GT(most, 1e-4);
  EXPECT_LT((a - b).rowwise().norm().maxCoeff(), 0.02 * most);
}

}  // namespace
}  // namespace hyperex::ct
