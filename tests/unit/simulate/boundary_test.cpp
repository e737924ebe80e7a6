// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/boundary.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "hyperex/core/error.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/node_areas.hpp"
#include "hyperex/simulate/drive/support.hpp"
#include "simulate/small_face.hpp"
#include "support/refusal.hpp"

namespace hyperex::simulate {
namespace {

class BoundaryTest : public testing::Test {
 protected:
  BoundaryTest() { options_.drive.points = test::seven_points(); }

  Boundary boundary() const {
    return Boundary(face_.mesh, face_.landmarks, motion_,
                    measured_region(face_.mesh, face_.landmarks, motion_, options_.region),
                    options_.drive, options_.support);
  }
  Points displacement(int sample) const { return motion_.motion.positions[sample] - motion_.rest; }
  Eigen::Index unknowns() const { return 3 * face_.mesh.volume.nodes.rows(); }
  /// The springs' stiffness alone, in a matrix of the pattern that they need.
  fem::SparseMatrix springs(const Boundary& boundary) const {
    fem::Material material;
    const auto tets = static_cast<std::size_t>(face_.mesh.volume.tets.rows());
    material.young_pa.assign(tets, 1);
    material.poisson.assign(tets, 0);
    material.viscosity_pa_s.assign(tets, 0);
    material.density_kg_m3.assign(tets, 1);
    fem::SparseMatrix k = fem::assemble(face_.mesh.volume.nodes, face_.mesh.volume.tets, material,
                                        fem::ElementKind::tet4)
                              .stiffness;
    const fem::SparseMatrix bare = k;
    const auto before = k.nonZeros();
    boundary.add_springs(k);
    EXPECT_EQ(k.nonZeros(), before) << "within the pattern";
    return k - bare;
  }

  const test::SmallFace face_ = test::small_face();
  const AlignedMotion motion_ = test::mouth_opening(face_.landmarks, 12, 9, 30);
  SimulationOptions options_;
};

TEST_F(BoundaryTest, PrescribesWholeNodesInOrder) {
  const Boundary b = boundary();
  const auto& p = b.prescribed();
  ASSERT_EQ(p.size() % 3, 0u);
  EXPECT_TRUE(std::is_sorted(p.begin(), p.end()));
  EXPECT_EQ(std::set<int>(p.begin(), p.end()).size(), p.size());
  for (std::size_t i = 0; i < p.size(); i += 3) {
    EXPECT_EQ(p[i] % 3, 0);
    EXPECT_EQ(p[i + 2], p[i] + 2);
  }
  EXPECT_LT(p.back(), unknowns());
  EXPECT_EQ(b.driven_rows().size(), 7u);
}

TEST_F(BoundaryTest, DrivenNodesTakeTheirPointsAndHeldOnesStay) {
  Boundary b = boundary();
  Eigen::VectorXd values(b.prescribed().size()), force(unknowns());
  const Points d = displacement(4);
  b.prescribe(d, b.follow(d), values, force);
  const std::set<int> driven(b.driven_nodes().begin(), b.driven_nodes().end());
  int held = 0;
  for (std::size_t i = 0; i < b.prescribed().size(); i += 3) {
    const int node = b.prescribed()[i] / 3;
    if (driven.count(node)) continue;
    ++held;
    EXPECT_EQ(values.segment<3>(static_cast<Eigen::Index>(i)), Vec3::Zero());
  }
  EXPECT_GT(held, 15) << "the border";
  // A driven point that is a vertex of the mesh: that node moves as the point does.
  const Points& skin = face_.mesh.skin.points;
  int met = 0;
  for (std::size_t i = 0; i < b.prescribed().size(); i += 3)
    for (const int row : b.driven_rows()) {
      const int node = b.prescribed()[i] / 3;
      if (node >= skin.rows() || (skin.row(node) - motion_.rest.row(row)).norm() > 1e-9) continue;
      ++met;
      EXPECT_LT((values.segment<3>(static_cast<Eigen::Index>(i)) - d.row(row).transpose()).norm(),
                1e-7);
    }
  EXPECT_GE(met, 3);
}

TEST_F(BoundaryTest, HoldsTheBorderSaveAtTheHairlineAndTheJaw) {
  const Boundary b = boundary();
  const std::set<int> prescribed(b.prescribed().begin(), b.prescribed().end());
  const std::vector<char> slides = over_frontalis(face_.mesh, face_.landmarks);
  const std::vector<char> jaw = near_jaw(face_.mesh, face_.landmarks);
  const std::set<int> driven(b.driven_nodes().begin(), b.driven_nodes().end());
  int free = 0, held = 0;
  for (int v = 0; v < face_.mesh.volume.surface_nodes(); ++v) {
    if (!face_.mesh.on_border[std::size_t(v)] || driven.contains(v)) continue;
    const bool moves = slides[std::size_t(v)] || jaw[std::size_t(v)];
    ++(moves ? free : held);
    for (const int node : {v, int(face_.mesh.volume.inner_node(v))})
      EXPECT_NE(prescribed.contains(3 * node), moves) << v;
  }
  EXPECT_GT(free, 5);
  EXPECT_GT(held, 5);
}

TEST_F(BoundaryTest, IsLinearInTheDrivenPoints) {
  options_.support.mandible = Mandible::free;
  Boundary b = boundary();
  Eigen::VectorXd one(b.prescribed().size()), other = one, both = one;
  Eigen::VectorXd force_one(unknowns()), force_other = force_one, force_both = force_one;
  b.prescribe(displacement(2), b.follow(displacement(2)), one, force_one);
  b.prescribe(displacement(5), b.follow(displacement(5)), other, force_other);
  b.prescribe(2 * displacement(2) - 3 * displacement(5),
              b.follow(2 * displacement(2) - 3 * displacement(5)), both, force_both);
  EXPECT_LT((both - 2 * one + 3 * other).norm(), 1e-12);
  EXPECT_LT((force_both - 2 * force_one + 3 * force_other).norm(), 1e-9);
}

TEST_F(BoundaryTest, SpringsAreSymmetricAndNeverPush) {
  const fem::SparseMatrix k = springs(boundary());
  EXPECT_GT(k.norm(), 0);
  EXPECT_LT((k - fem::SparseMatrix(k.transpose())).norm(), 1e-9 * k.norm());
  for (Eigen::Index n = 0; n < unknowns(); n += 3) {
    Eigen::Matrix3d block;
    for (int a = 0; a < 3; ++a)
      for (int c = 0; c < 3; ++c) block(a, c) = k.coeff(n + a, n + c);
    EXPECT_GE(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(block).eigenvalues()[0],
              -1e-9 * block.norm());
  }
}

TEST_F(BoundaryTest, SpringsOfTheJawPullToWhereItTurns) {
  options_.support.skull = Hold::free;
  options_.support.field_pa_per_m = 0;
  Boundary b = boundary();
  Eigen::VectorXd values(b.prescribed().size()), force(unknowns());
  const Points d = displacement(4);
  b.prescribe(d, b.follow(d), values, force);
  EXPECT_GT(b.jaw_opening_deg(), 5);
  Jaw jaw(face_.landmarks, nullptr);
  const int chin = motion_.motion.index_of("ibug68_8");
  const Eigen::Isometry3d turn = jaw.follow(Points(motion_.rest.row(chin)), Points(d.row(chin)));
  const Points& x = face_.mesh.volume.nodes;
  const Points to =
      ((x * turn.linear().transpose()).rowwise() + turn.translation().transpose()) - x;
  const Eigen::VectorXd carried = Eigen::Map<const Eigen::VectorXd>(to.data(), to.size());
  EXPECT_GT(force.norm(), 0);
  EXPECT_LT((springs(b) * carried - force).norm(), 1e-6 * force.norm())
      << "no force where the tissue moved with the jaw";
}

/// Tissue below the jaw's edge follows a share of the displacement of the edge's nearest point.
TEST_F(BoundaryTest, TheFloorOfTheMouthHangsFromTheEdgeOfTheJaw) {
  SupportOptions with = options_.support, without = options_.support;
  with.throat_pa_per_m = 1e6;
  with.throat_reach_m = 0.05;
  io::Landmarks landmarks = face_.landmarks;  // the small face ends at the jaw
  for (int k = 5; k <= 11; ++k) landmarks.at(face::ibug(k)).y() += 0.03;
  const Boundary a(face_.mesh, landmarks, with), b(face_.mesh, landmarks, without);
  const Eigen::VectorXd stiffness = Eigen::MatrixXd(springs(a) - springs(b)).diagonal();
  Boundary::JawMotion jaw;
  jaw.turn << 0, 0.1, 0.2, -0.1, 0, 0.3, -0.2, -0.3, 0.05;
  jaw.slide = Vec3(0.001, -0.002, 0.004);
  const Eigen::VectorXd force = a.forces_of_jaw(jaw) - b.forces_of_jaw(jaw);
  const std::vector<Bone> bones = bones_under(face_.mesh, landmarks);
  const std::vector<EdgeOfJaw> edge = edge_of_jaw(face_.mesh, landmarks);
  const Eigen::VectorXd areas = node_areas(face_.mesh.volume.outer);
  int hanging = 0;
  for (int v = 0; v < face_.mesh.volume.surface_nodes(); ++v) {
    const Eigen::Index at = 3 * face_.mesh.volume.inner_node(v);
    const bool hangs = bones[std::size_t(v)] == Bone::none && edge[std::size_t(v)].below;
    const double wanted = hangs ? 1e6 * areas[v] : 0;
    EXPECT_LT((stiffness.segment<3>(at) - Vec3::Constant(wanted)).norm(), 1e-6 * 1e6 * areas[v]);
    const double d = edge[std::size_t(v)].distance_m;
    const Vec3 to =
        std::exp(-d * d / (0.05 * 0.05)) * (jaw.turn * edge[std::size_t(v)].nearest + jaw.slide);
    EXPECT_LT((force.segment<3>(at) - wanted * to).norm(), 1e-9) << v;
    hanging += hangs;
  }
  EXPECT_GT(hanging, 5);
}

TEST_F(BoundaryTest, SupportOptionsReachTheirNodes) {
  const Boundary sliding = boundary();
  EXPECT_GT(sliding.skull_count(), 100);
  EXPECT_GT(sliding.mandible_count(), 5);
  options_.support.skull = Hold::held;
  options_.support.mandible = Mandible::held;
  const Boundary held = boundary();
  EXPECT_EQ(held.skull_count(), sliding.skull_count());
  EXPECT_GT(held.prescribed().size(), sliding.prescribed().size()) << "held nodes are prescribed";
  options_.support.skull = Hold::free;
  options_.support.mandible = Mandible::free;
  options_.support.border_held = false;
  options_.support.field_pa_per_m = 0;
  const Boundary loose = boundary();
  EXPECT_EQ(loose.skull_count(), 0);
  EXPECT_EQ(loose.mandible_count(), 0);
  EXPECT_TRUE(loose.held_nodes().empty());
  EXPECT_EQ(loose.prescribed().size(), 3 * loose.driven_nodes().size());
  EXPECT_EQ(springs(loose).norm(), 0);
}

TEST_F(BoundaryTest, StifferLayersPullHarder) {
  options_.support.field_pa_per_m = 0;
  const double once = springs(boundary()).norm();
  for (BoneLayer* layer : {&options_.support.skull_layer, &options_.support.mandible_layer}) {
    layer->across_pa_per_m *= 2;
    layer->along_pa_per_m *= 2;
  }
  EXPECT_NEAR(springs(boundary()).norm(), 2 * once, 1e-6 * once);
}

TEST_F(BoundaryTest, UnknownNamesAreRefused) {
  const auto refusal = [&] { return hyperex::test::refusal([&] { boundary(); }); };
  options_.drive.points = {"nobody"};
  EXPECT_THAT(refusal(), testing::HasSubstr("which is to be driven"));
  options_.drive.points = test::seven_points();
  options_.drive.still_points = {"nobody"};
  EXPECT_THAT(refusal(), testing::HasSubstr("which is to be held still"));
  options_.drive.still_points.clear();
  options_.support.jaw_points = {"nobody"};
  EXPECT_THAT(refusal(), testing::HasSubstr("which is to carry the jaw"));
}

}  // namespace
}  // namespace hyperex::simulate
