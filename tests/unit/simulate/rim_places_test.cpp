// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/contact/rim_places.hpp"

#include <gtest/gtest.h>

#include "hyperex/face/ibug.hpp"
#include "hyperex/simulate/drive/skin_places.hpp"
#include "small_face.hpp"

namespace hyperex::simulate {
namespace {

class RimThrough : public testing::Test {
 protected:
  RimThrough() : face_(test::small_face()) {
    face_.mesh.rim = tissue::rim_vertices(face_.mesh.skin, face_.mesh.volume.outer,
                                          face_.mesh.anchors, face_.mesh.on_border);
    std::vector<std::string> names;
    for (const int k : {48, 54, 61, 62, 63, 65, 66, 67}) names.push_back(face::ibug(k));
    Points at(Eigen::Index(names.size()), 3);
    for (std::size_t i = 0; i < names.size(); ++i)
      at.row(Eigen::Index(i)) = face_.landmarks.at(names[i]).transpose();
    places_ = skin_places(face_.mesh, names, at);
  }
  /// A place's row over the outer nodes, as the skin is read off.
  Eigen::RowVectorXd read(const std::vector<tissue::RimVertex>& rim, const Match& place) const {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(face_.mesh.volume.surface_nodes());
    for (int k = 0; k < 3; ++k) {
      const int v = place.point[std::size_t(k)];
      const auto at = std::find_if(rim.begin(), rim.end(),
                                   [&](const tissue::RimVertex& one) { return one.vertex == v; });
      if (at != rim.end()) {
        for (std::size_t n = 0; n < at->node.size(); ++n)
          row[at->node[n]] += place.weight[k] * at->weight[n];
      } else {
        const tissue::Anchor& anchor = face_.mesh.anchors[std::size_t(v)];
        for (int a = 0; a < 3; ++a)
          row[anchor.node[std::size_t(a)]] += place.weight[k] * anchor.weight[a];
      }
    }
    return row;
  }

  test::SmallFace face_;
  std::vector<Match> places_;
};

/// A driven place must move exactly as its anchors do; with the rim's own field alone it does not.
TEST_F(RimThrough, DrivenPlacesMoveAsTheirAnchors) {
  const Eigen::MatrixXd driven = carriers(face_.mesh, places_);
  const auto through = rim_through(face_.mesh, places_);
  double most_off_alone = 0;
  for (std::size_t p = 0; p < places_.size(); ++p) {
    const Eigen::RowVectorXd wanted = driven.row(Eigen::Index(p));
    EXPECT_LT((read(through, places_[p]) - wanted).cwiseAbs().maxCoeff(), 5e-3) << p;
    most_off_alone =
        std::max(most_off_alone, (read(face_.mesh.rim, places_[p]) - wanted).cwiseAbs().maxCoeff());
  }
  EXPECT_GT(most_off_alone, 0.1);
}

TEST_F(RimThrough, WhatIsEqualEverywhereStaysSo) {
  for (const tissue::RimVertex& one : rim_through(face_.mesh, places_)) {
    double sum = 0;
    for (const double weight : one.weight) sum += weight;
    EXPECT_NEAR(sum, 1, 1e-6);
  }
}

TEST_F(RimThrough, RimsFarFromAllPlacesAreAsTheyWere) {
  const auto through = rim_through(face_.mesh, places_);
  ASSERT_EQ(through.size(), face_.mesh.rim.size());
  int eyes = 0;
  for (std::size_t r = 0; r < through.size(); ++r) {
    const Vec3 at = face_.mesh.skin.points.row(through[r].vertex).transpose();
    if ((at - face_.landmarks.at(face::ibug(37))).norm() > 0.02) continue;
    ++eyes;
    EXPECT_EQ(through[r].node, face_.mesh.rim[r].node);
    EXPECT_EQ(through[r].weight, face_.mesh.rim[r].weight);
  }
  EXPECT_GT(eyes, 3);
  EXPECT_EQ(rim_through(face_.mesh, {}).size(), face_.mesh.rim.size());
}

}  // namespace
}  // namespace hyperex::simulate
