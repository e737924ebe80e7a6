// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes of real faces carried to a face by a registration of the canonical face.
#include "hyperex/simulate/load/carried_shapes.hpp"

#include <gtest/gtest.h>

#include "hyperex/expression/shape_model.hpp"
#include "hyperex/face/canonical_face.hpp"
#include "hyperex/geometry/transform.hpp"
#include "simulate/small_face.hpp"

namespace hyperex::simulate {
namespace {

const Points& canonical_vertices() {
  return face::canonical_face().mesh.points;
}

/// The shapes on a face whose vertices are the canonical ones at these places.
CarriedShapes shapes_registered_on(const Points& vertices) {
  io::Landmarks landmarks;
  std::vector<DrivenPoint> points;
  for (const std::string& name : test::seven_points()) {
    landmarks[name] = face::canonical_face().landmark(name, vertices);
    points.push_back({name, landmarks[name]});
  }
  const std::vector<double> no_margin(std::size_t(vertices.rows()), 0.0);
  return {vertices, no_margin, landmarks, points, 0.0015, vertices};
}

/// The model's displacements, each turned by `turn`.
Eigen::MatrixXd turned_model(const Eigen::Matrix3d& turn) {
  Eigen::MatrixXd out = expression::shape_model().displacement;
  for (Eigen::Index v = 0; v < out.rows() / 3; ++v)
    out.middleRows<3>(3 * v) = (turn * out.middleRows<3>(3 * v)).eval();
  return out;
}

TEST(RegisteredShapes, OnTheCanonicalFaceTheyAreTheModels) {
  const CarriedShapes shapes = shapes_registered_on(canonical_vertices());
  const Eigen::MatrixXd& model = expression::shape_model().displacement;
  ASSERT_EQ(shapes.at_nodes().rows(), model.rows());
  EXPECT_LT((shapes.at_nodes() - model).cwiseAbs().maxCoeff(), 5e-5);
  EXPECT_EQ(shapes.cover().minCoeff(), 1);
}

TEST(RegisteredShapes, TurnAndGrowWithTheFace) {
  Similarity moved;
  moved.scale = 1.15;
  moved.rotation = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  moved.translation = Vec3(0.2, -0.1, 0.05);
  const CarriedShapes shapes = shapes_registered_on(moved.apply(canonical_vertices()));
  const Eigen::Matrix3d turn = moved.scale * moved.rotation;
  EXPECT_LT((shapes.at_nodes() - turned_model(turn)).cwiseAbs().maxCoeff(), 5e-5);
  const Eigen::MatrixXd still = shapes_registered_on(canonical_vertices()).at_points();
  for (Eigen::Index i = 0; i < still.rows() / 3; ++i)
    EXPECT_LT((shapes.at_points().middleRows<3>(3 * i) - turn * still.middleRows<3>(3 * i))
                  .cwiseAbs()
                  .maxCoeff(),
              5e-5)
        << i;
}

/// A face whose left cheek lies at an angle of its own.
TEST(RegisteredShapes, EachTurnsAsTheSurfaceAroundIt) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.5, Vec3::UnitY()).toRotationMatrix();
  const Vec3 hinge(0.03, 0, 0.04);
  Points bent = canonical_vertices();
  for (Eigen::Index v = 0; v < bent.rows(); ++v)
    if (bent(v, 0) > hinge.x())
      bent.row(v) = (turn * (bent.row(v).transpose() - hinge) + hinge).transpose();
  const CarriedShapes shapes = shapes_registered_on(bent);
  const Eigen::MatrixXd& model = expression::shape_model().displacement;
  const Eigen::MatrixXd turned = turned_model(turn);
  for (Eigen::Index v = 0; v < bent.rows(); ++v) {
    const double x = canonical_vertices()(v, 0);
    if (x > 0 && x < 0.045) continue;  // near the hinge
    const Eigen::MatrixXd& expected = x > 0 ? turned : model;
    EXPECT_LE((shapes.at_nodes() - expected).middleRows<3>(3 * v).norm(),
              0.1 * expected.middleRows<3>(3 * v).norm() + 1e-9)
        << v;
  }
}

/// The mouth of the canonical face is open. The registration draws its lips together, so that the
/// shapes are compared far from it.
TEST(RegisteredShapes, TheRegistrationFindsTheCanonicalFaceItself) {
  const test::SmallFace face = test::small_face();
  MuscleOptions options;
  EXPECT_EQ(registered_shapes(options, face.landmarks, face.mesh.skin).rows(), 0);
  options.shapes_registered = true;
  const Points found = registered_shapes(options, face.landmarks, face.mesh.skin);
  ASSERT_EQ(found.rows(), canonical_vertices().rows());
  const Points& nodes = canonical_vertices();
  const CarriedShapes shapes(nodes, std::vector<double>(std::size_t(nodes.rows()), 0.0),
                             face.landmarks, {}, 0.0015, found);
  const Eigen::MatrixXd off = shapes.at_nodes() - expression::shape_model().displacement;
  EXPECT_LT(off.norm(), 0.03 * expression::shape_model().displacement.norm());
  const Vec3 mouth = 0.5 * (face.landmarks.at("ibug68_48") + face.landmarks.at("ibug68_54"));
  for (Eigen::Index v = 0; v < nodes.rows(); ++v)
    if ((nodes.row(v).transpose() - mouth).norm() > 0.06) {
      EXPECT_LT(off.middleRows<3>(3 * v).cwiseAbs().maxCoeff(), 5e-5) << v;
    }
}

}  // namespace
}  // namespace hyperex::simulate
