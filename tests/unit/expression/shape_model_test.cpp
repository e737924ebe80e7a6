// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/expression/shape_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "hyperex/face/canonical_face.hpp"

namespace hyperex::expression {
namespace {

Eigen::Index place_of(const std::string& name) {
  const auto& names = shape_model().names;
  const auto at = std::find(names.begin(), names.end(), name);
  EXPECT_NE(at, names.end()) << name;
  return at - names.begin();
}

Vec3 moved(const std::string& shape, int vertex) {
  return shape_model().displacement.col(place_of(shape)).segment<3>(3 * vertex);
}

/// Sum of the displacements of all vertices more than 10 mm left (sign 1) or right (-1) of the
/// middle, m.
double motion_of_side(Eigen::Index shape, double sign) {
  const Points& points = face::canonical_face().mesh.points;
  double sum = 0;
  for (Eigen::Index v = 0; v < points.rows(); ++v)
    if (sign * points(v, 0) > 0.010)
      sum += shape_model().displacement.col(shape).segment<3>(3 * v).norm();
  return sum;
}

TEST(ShapeModel, ShapesOfASideMoveThatSide) {
  int sided = 0;
  for (const std::string& name : shape_model().names) {
    if (!name.ends_with("_L") && !name.ends_with("_R")) continue;
    ++sided;
    const double left = motion_of_side(place_of(name), 1),
                 right = motion_of_side(place_of(name), -1);
    EXPECT_LT(name.ends_with("_L") ? right : left, 0.1 * (left + right)) << name;
  }
  EXPECT_EQ(sided, 34);
}

TEST(ShapeModel, TheJawCarriesTheLowerLipAlone) {
  constexpr int upper_lip = 13, lower_lip = 14, chin = 152;
  EXPECT_LT(moved("jawOpen", upper_lip).norm(), 0.004);
  EXPECT_LT(moved("jawOpen", lower_lip).y(), -0.020);
  EXPECT_LT(moved("jawOpen", chin).y(), -0.020);
}

TEST(ShapeModel, ASmileLiftsItsCorner) {
  constexpr int corner_left = 291, corner_right = 61;
  EXPECT_GT(moved("mouthSmile_L", corner_left).y(), 0.004);
  EXPECT_GT(moved("mouthSmile_L", corner_left).x(), 0.001);
  EXPECT_LT(moved("mouthSmile_L", corner_right).norm(), 0.001);
}

TEST(ShapeModel, SidesAreNotCoupled) {
  const ShapeModel& model = shape_model();
  EXPECT_EQ(Eigen::LLT<Eigen::MatrixXd>(model.covariance).info(), Eigen::Success);
  for (std::size_t a = 0; a < model.names.size(); ++a)
    for (std::size_t b = 0; b < model.names.size(); ++b)
      if (model.names[a].ends_with("_L") && model.names[b].ends_with("_R")) {
        EXPECT_EQ(model.covariance(Eigen::Index(a), Eigen::Index(b)), 0)
            << model.names[a] << ", " << model.names[b];
      }
  EXPECT_EQ(model.covariance(place_of("mouthShrugLower"), place_of("jawForward")), 0);
  EXPECT_EQ(model.covariance(place_of("mouthFrown_L"), place_of("eyeBlink_L")), 0);
  EXPECT_GT(model.covariance(place_of("mouthSmile_L"), place_of("cheekSquint_L")), 0);
  EXPECT_EQ(model.covariance(place_of("mouthSmile_L"), place_of("cheekSquint_L")),
            model.covariance(place_of("mouthSmile_R"), place_of("cheekSquint_R")));
}

}  // namespace
}  // namespace hyperex::expression
