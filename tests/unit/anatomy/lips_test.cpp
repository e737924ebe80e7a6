// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/lips.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/geodesic.hpp"

namespace hyperex::anatomy {
namespace {

io::Landmarks canonical_landmarks() {
  io::Landmarks landmarks;
  for (const auto& name : face::all_ibug())
    landmarks[name] = canonical_face().landmark(name, canonical_face().mesh.points);
  return landmarks;
}

TEST(LipOf, ToldByTheIbugNumber) {
  int upper = 0, lower = 0;
  for (const auto& name : face::all_ibug()) {
    upper += lip_of(name) > 0;
    lower += lip_of(name) < 0;
  }
  EXPECT_EQ(upper, 8);
  EXPECT_EQ(lower, 8);
  EXPECT_EQ(lip_of("ibug68_51"), 1);
  EXPECT_EQ(lip_of("ibug68_66"), -1);
  for (const char* name : {"ibug68_48", "ibug68_54", "ibug68_60", "ibug68_64", "ibug68_8", "nose"})
    EXPECT_EQ(lip_of(name), 0) << name;
}

TEST(UpperLipMargin, TellsTheLipsApartByTheWalk) {
  const EmbeddedFace face = embedded_face();
  const auto margin = upper_lip_margin(face.mesh, face.landmarks);
  ASSERT_EQ(static_cast<Eigen::Index>(margin.size()), face.mesh.points.rows());
  for (const auto& name : face::all_ibug()) {
    const double m = margin[nearest_vertex(face.mesh.points, face.landmarks.at(name))];
    if (lip_of(name) != 0) {
      EXPECT_GT(m * lip_of(name), 0.004) << name;
    }
  }
  EXPECT_GT(margin[nearest_vertex(face.mesh.points, face.landmarks.at(face::ibug(30)))], 0.01)
      << "nose";
  EXPECT_LT(margin[nearest_vertex(face.mesh.points, face.landmarks.at(face::ibug(8)))], -0.01)
      << "chin";
}

TEST(UpperLipMargin, UnreachedVerticesCountAsFarFromBoth) {
  EmbeddedFace face = embedded_face();
  face.mesh.points.conservativeResize(face.mesh.points.rows() + 1, 3);
  face.mesh.points.bottomRows(1) << 1, 1, 1;
  EXPECT_EQ(upper_lip_margin(face.mesh, face.landmarks).back(), 0);
}

TEST(MouthIsOpen, OnlyWhereABorderRunsBetweenTheLips) {
  EXPECT_FALSE(mouth_is_open(canonical_face().mesh, canonical_landmarks()));
  const EmbeddedFace face = embedded_face();
  EXPECT_TRUE(mouth_is_open(face.mesh, face.landmarks));
}

TEST(LipLineOfLandmarks, RunsFromCornerToCornerBetweenTheLips) {
  const io::Landmarks landmarks = embedded_face().landmarks;
  const Points line = lip_line_of_landmarks(landmarks);
  ASSERT_GT(line.rows(), 50);
  EXPECT_LT((line.row(0).transpose() - landmarks.at(face::ibug(48))).norm(), 1e-12);
  EXPECT_LT((line.row(line.rows() - 1).transpose() - landmarks.at(face::ibug(54))).norm(), 1e-12);
  for (Eigen::Index i = 0; i + 1 < line.rows(); ++i) {
    EXPECT_GT(line(i + 1, 0), line(i, 0)) << "always towards the subject's left";
    EXPECT_LT((line.row(i + 1) - line.row(i)).norm(), 0.0008);
  }
  for (const auto& [upper, lower] : {std::pair{61, 67}, {62, 66}, {63, 65}}) {
    const Vec3 middle = (landmarks.at(face::ibug(upper)) + landmarks.at(face::ibug(lower))) / 2;
    EXPECT_LT((line.rowwise() - middle.transpose()).rowwise().norm().minCoeff(), 0.0015);
  }
}

}  // namespace
}  // namespace hyperex::anatomy
