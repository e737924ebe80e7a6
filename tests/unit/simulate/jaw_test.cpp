// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/jaw.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "simulate/small_face.hpp"

namespace hyperex::simulate {
namespace {

using face::ibug;

class JawTest : public testing::Test {
 protected:
  io::Landmarks landmarks_ = test::small_face().landmarks;
  face::FaceFrame frame_ = face::face_frame(landmarks_);

  Points points(std::initializer_list<int> numbers) const {
    Points p(numbers.size(), 3);
    Eigen::Index i = 0;
    for (int k : numbers) p.row(i++) = landmarks_.at(ibug(k)).transpose();
    return p;
  }
  /// Opens the jaw about the transverse axis through the condyles.
  Eigen::Isometry3d opened(double degrees, double forward = 0) const {
    const Vec3 pivot = (landmarks_.at(ibug(1)) + landmarks_.at(ibug(15))) / 2 + forward * frame_.z;
    Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
    turn.translate(pivot)
        .rotate(Eigen::AngleAxisd(degrees * M_PI / 180, frame_.x))
        .translate(-pivot);
    return turn;
  }
  static Points carried(const Eigen::Isometry3d& by, const Points& p) {
    return ((p * by.linear().transpose()).rowwise() + by.translation().transpose()) - p;
  }
};

TEST_F(JawTest, RecoversAnOpening) {
  for (const auto& chin : {points({8}), points({6, 7, 8, 9, 10})})
    for (const double degrees : {1.0, 12.0, 30.0}) {
      Jaw jaw(landmarks_, nullptr);
      const Eigen::Isometry3d truth = opened(degrees);
      const Points d = carried(truth, chin);
      EXPECT_LT(d(0, 1), 0) << "a turn about the subject's left lowers the chin";
      const Eigen::Isometry3d found = jaw.follow(chin, d);
      EXPECT_NEAR(jaw.opening_deg(), degrees, 1e-6);
      EXPECT_LT((found.matrix() - truth.matrix()).norm(), 1e-7);
    }
}

TEST_F(JawTest, TurnsAboutTheCondylesOfGivenBones) {
  const Points chin = points({7, 8, 9});
  const Vec3 middle = 0.5 * (landmarks_.at(ibug(1)) + landmarks_.at(ibug(15))) + 0.012 * frame_.z;
  const TriMesh any{Points::Identity(3, 3), Triangles{{0, 1, 2}}};
  const anatomy::Bones bones(any, {},
                             anatomy::Condyles{middle + 0.05 * frame_.x, middle - 0.05 * frame_.x});
  Jaw jaw(landmarks_, &bones);
  const Eigen::Isometry3d truth = opened(15, 0.012);
  EXPECT_LT((jaw.follow(chin, carried(truth, chin)).matrix() - truth.matrix()).norm(), 1e-7);
  Jaw other(landmarks_, nullptr);
  EXPECT_GT((other.follow(chin, carried(truth, chin)).matrix() - truth.matrix()).norm(), 1e-4);
}

TEST_F(JawTest, FollowsAMotionBackToRest) {
  const Points chin = points({6, 7, 8, 9, 10});
  Jaw jaw(landmarks_, nullptr);
  for (const double degrees : {0.0, 4.0, 11.0, 14.0, 6.0, 0.0}) {
    const Eigen::Isometry3d truth = opened(degrees);
    EXPECT_LT((jaw.follow(chin, carried(truth, chin)).matrix() - truth.matrix()).norm(), 1e-7);
  }
}

TEST_F(JawTest, StaysExactlyWithoutMotion) {
  const Points chin = points({7, 8, 9});
  Jaw jaw(landmarks_, nullptr);
  const Eigen::Isometry3d found = jaw.follow(chin, Points::Zero(3, 3));
  EXPECT_EQ(carried(found, chin).cwiseAbs().maxCoeff() < 1e-12, true);
  EXPECT_EQ(jaw.opening_deg(), 0);
}

TEST_F(JawTest, IsRigidWhateverThePointsDo) {
  const Points chin = points({5, 6, 7, 8, 9, 10, 11});
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> unit(-0.02, 0.02);
  Jaw jaw(landmarks_, nullptr);
  for (int round = 0; round < 20; ++round) {
    Points d(chin.rows(), 3);
    for (double& x : d.reshaped()) x = unit(generator);
    const Eigen::Matrix3d turn = jaw.follow(chin, d).linear();
    EXPECT_LT((turn.transpose() * turn - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_NEAR(turn.determinant(), 1, 1e-12);
  }
}

TEST_F(JawTest, SlidesToTheSideButReluctantly) {
  const Points chin = points({6, 7, 8, 9, 10});
  Points d(chin.rows(), 3);
  d.rowwise() = (0.006 * frame_.x).transpose();
  Jaw jaw(landmarks_, nullptr);
  const Eigen::Isometry3d found = jaw.follow(chin, d);
  const Points by = carried(found, chin);
  const double along = (by * frame_.x).mean();
  EXPECT_GT(along, 0.004);
  EXPECT_LT(along, 0.006);
  EXPECT_NEAR(jaw.opening_deg(), 0, 0.2);
}

TEST_F(JawTest, NeedsItsLandmarks) {
  landmarks_.erase(ibug(15));
  EXPECT_THROW((Jaw{landmarks_, nullptr}), std::out_of_range);
}

}  // namespace
}  // namespace hyperex::simulate
