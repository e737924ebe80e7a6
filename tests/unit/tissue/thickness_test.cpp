// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/mesh/thickness.hpp"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "hyperex/anatomy/embedded_face.hpp"

namespace hyperex::tissue {
using namespace anatomy;
namespace {

TEST(PublishedDepths, ArePlausibleAndNamedOnceAtKnownLandmarks) {
  std::set<std::string> names;
  for (const DepthAt& d : published_depths()) {
    EXPECT_TRUE(names.insert(d.landmark).second) << d.landmark;
    EXPECT_GE(d.depth_m, 0.002);
    EXPECT_LE(d.depth_m, 0.012);
    EXPECT_TRUE(canonical_face().landmarks.count(d.landmark)) << d.landmark;
  }
  for (const std::string& name : names)  // the two sides of a face are alike
    for (const DepthAt& a : published_depths())
      for (const DepthAt& b : published_depths())
        if (a.landmark == name && b.landmark == mirrored_landmark(name)) {
          EXPECT_EQ(a.depth_m, b.depth_m) << name;
        }
}

TEST(DepthField, LiesBetweenTheGivenDepthsAndNearThemAtTheirLandmarks) {
  const EmbeddedFace face = embedded_face();
  const Eigen::VectorXd field = depth_field(face.mesh.points, published_depths(), face.landmarks);
  EXPECT_GE(field.minCoeff(), 0.003);
  EXPECT_LE(field.maxCoeff(), 0.012);
  for (const DepthAt& d : published_depths()) {
    Points at(1, 3);
    at.row(0) = face.landmarks.at(d.landmark).transpose();
    EXPECT_NEAR(depth_field(at, published_depths(), face.landmarks)[0], d.depth_m, 0.0015)
        << d.landmark;
  }
}

TEST(DepthField, OfTwoLandmarks) {
  const io::Landmarks landmarks{{"a", {0, 0, 0}}, {"b", {0.06, 0, 0}}};
  const std::vector<DepthAt> depths{{"a", 0.004}, {"unknown", 5}, {"b", 0.010}};
  Points at(4, 3);
  at << 0, 0, 0, 0.06, 0, 0, 0.03, 0.02, 0, 0.01, 0, 0;
  const Eigen::VectorXd field = depth_field(at, depths, landmarks);
  EXPECT_NEAR(field[0], 0.004, 1e-5);
  EXPECT_NEAR(field[1], 0.010, 1e-5);
  EXPECT_NEAR(field[2], 0.007, 1e-15) << "half way";
  // Weights 1 / 1 cm^2 and 1 / 25 cm^2, each softened by (2 mm)^2.
  EXPECT_NEAR(field[3], (0.004 / 1.04 + 0.010 / 25.04) / (1 / 1.04 + 1 / 25.04), 1e-12);
}

TEST(DepthField, NeedsOneKnownLandmark) {
  const Points at = Points::Zero(1, 3);
  EXPECT_THROW(depth_field(at, {{"unknown", 0.005}}, {{"a", {0, 0, 0}}}), std::invalid_argument);
  EXPECT_DOUBLE_EQ(depth_field(at, {{"a", 0.005}}, {{"a", {1, 0, 0}}})[0], 0.005);
}

}  // namespace
}  // namespace hyperex::tissue
