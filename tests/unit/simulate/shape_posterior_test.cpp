// SPDX-License-Identifier: GPL-3.0-or-later
// The posterior at other places, compared with the inverse of the joint covariance.
#include "hyperex/simulate/load/shape_posterior.hpp"

#include <gtest/gtest.h>

#include "hyperex/expression/shape_model.hpp"
#include "simulate/small_face.hpp"

namespace hyperex::simulate {
namespace {

class PosteriorOnAFace : public testing::Test {
 protected:
  void see(const std::vector<std::string>& names) {
    points_.clear();
    for (const std::string& name : names) points_.push_back({name, face_.landmarks.at(name)});
  }
  CarriedShapes shapes() const {
    return {nodes(), face_.mesh.upper_margin, face_.landmarks, points_, 0.0015};
  }
  ShapePosterior posterior() const { return {shapes(), moved(nodes()), moved(rest()), options_}; }
  Points rest() const {
    Points out(Eigen::Index(points_.size()), 3);
    for (std::size_t i = 0; i < points_.size(); ++i)
      out.row(Eigen::Index(i)) = points_[i].rest.transpose();
    return out;
  }
  /// The farther from the middle, the more.
  static double motion_m(const Vec3& at) { return std::abs(at.x()) / 10; }
  static MovedPlaces moved(const Points& at) {
    MovedPlaces out{at, Eigen::VectorXd(at.rows())};
    for (Eigen::Index i = 0; i < at.rows(); ++i) out.motion_m[i] = motion_m(at.row(i).transpose());
    return out;
  }
  const Points& nodes() const { return face_.mesh.volume.outer.points; }
  int node_at(const std::string& landmark) const {
    Eigen::Index node = 0;
    (nodes().rowwise() - face_.landmarks.at(landmark).transpose())
        .rowwise()
        .squaredNorm()
        .minCoeff(&node);
    return int(node);
  }
  double distance_mm_at(const std::string& landmark) const {
    return 1e3 * posterior().distance_m()[node_at(landmark)];
  }

  const test::SmallFace face_ = test::small_face();
  std::vector<DrivenPoint> points_;
  PosteriorOptions options_;
};

/// The covariance of some jointly normal numbers, given the others, is the inverse of their block
/// of the inverse of the joint covariance.
TEST_F(PosteriorOnAFace, IsTheInverseOfABlockOfTheJointInverse) {
  see(test::seven_points());
  options_ = {.misfit_m = 0.002, .misfit_share = 0.3, .misfit_length_m = 0.03, .point_m = 0.001};
  const CarriedShapes shapes = this->shapes();
  const ShapePosterior posterior = this->posterior();
  for (const int node : {node_at("ibug68_48"), node_at("ibug68_33"), node_at("ibug68_40")}) {
    std::vector<Vec3> at = {nodes().row(node)};
    for (const DrivenPoint& point : points_) at.push_back(point.rest);
    const auto size = 3 * Eigen::Index(at.size());
    Eigen::MatrixXd all(size, shapes.count());
    all << shapes.at_nodes().middleRows<3>(3 * node), shapes.at_points();
    Eigen::MatrixXd joint = all * expression::shape_model().covariance * all.transpose();
    for (Eigen::Index i = 0; i < size; ++i)
      for (Eigen::Index j = i % 3; j < size; j += 3)
        joint(i, j) += (0.002 + 0.3 * motion_m(at[std::size_t(i / 3)])) *
                       (0.002 + 0.3 * motion_m(at[std::size_t(j / 3)])) *
                       std::exp(-(at[std::size_t(i / 3)] - at[std::size_t(j / 3)]).squaredNorm() /
                                (2 * 0.03 * 0.03));
    joint.diagonal().tail(size - 3).array() += 0.001 * 0.001;
    const Eigen::Matrix3d expected = joint.inverse().topLeftCorner<3, 3>().inverse();
    EXPECT_LT((posterior.covariance(node) - expected).norm(), 1e-6 * expected.norm()) << node;
    EXPECT_NEAR(posterior.distance_m()[node], std::sqrt(expected.trace()), 1e-9);
    const Eigen::Matrix3d before = joint.topLeftCorner<3, 3>();
    EXPECT_NEAR(posterior.determined()[node], 1 - expected.trace() / before.trace(), 1e-6);
  }
}

TEST_F(PosteriorOnAFace, IsSmallAtDrivenPointsAndGreatWhereNothingTells) {
  see(test::seven_points());
  EXPECT_LT(distance_mm_at("ibug68_48"), 2);  // driven
  const double lid = distance_mm_at("ibug68_37"), brow = distance_mm_at("ibug68_19");
  EXPECT_GT(lid, 2.5);  // may blink
  EXPECT_GT(brow, 2);   // may rise
  see({"ibug68_48", "ibug68_54", "ibug68_37", "ibug68_19"});
  EXPECT_LT(distance_mm_at("ibug68_37"), 0.7 * lid);
  EXPECT_LT(distance_mm_at("ibug68_19"), 0.7 * brow);
}

/// The left corner of the mouth determines little of the right side, since the shapes of the two
/// sides are not correlated.
TEST_F(PosteriorOnAFace, OneSideTellsLittleOfTheOther) {
  see({"ibug68_54"});  // the subject's left
  const Eigen::VectorXd determined = posterior().determined();
  EXPECT_GT(determined[node_at("ibug68_54")], 0.8);
  EXPECT_LT(determined[node_at("ibug68_48")], 0.5);
  EXPECT_GE(determined.minCoeff(), 0);
  EXPECT_LE(determined.maxCoeff(), 1);
}

TEST_F(PosteriorOnAFace, MorePointsNeverKnowLess) {
  see(test::seven_points());
  const Eigen::VectorXd few = posterior().distance_m();
  points_.push_back({"ibug68_33", face_.landmarks.at("ibug68_33")});
  const Eigen::VectorXd more = posterior().distance_m();
  EXPECT_LE((more - few).maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace hyperex::simulate
