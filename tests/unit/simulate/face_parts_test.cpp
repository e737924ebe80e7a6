// SPDX-License-Identifier: GPL-3.0-or-later
// Which muscles are taken to make motion that no fitted muscle explains.
#include "hyperex/simulate/load/face_parts.hpp"

#include <gmock/gmock.h>

namespace hyperex::simulate {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Lines of the template, right and left of each name.
std::vector<muscles::MuscleLine> lines_of(const std::vector<std::string>& names) {
  const muscles::MuscleTable& table = muscles::muscle_template();
  std::vector<muscles::MuscleLine> lines;
  for (const std::string& name : names)
    for (const bool left : {false, true}) {
      const auto at = std::ranges::find(table, name, &muscles::TemplateMuscle::name);
      lines.push_back({name + (left ? "_L" : "_R"), int(at - table.begin()), left, {}, {}, 1});
    }
  return lines;
}

/// Right and left of a muscle of the mouth, of the eye and of the brow, at three places.
class PartsOfAFace : public testing::Test {
 protected:
  PartsOfAFace() {
    response_.setZero();
    response_(0, 0) = 3e-3;  // zyg_major_R moves place 0
    response_(1, 2) = 4e-3;  // orb_palpebral_R, too
    response_(4, 1) = 5e-3;  // zyg_major_L moves place 1
  }
  Eigen::MatrixXd response_ = Eigen::MatrixXd(9, 6);
  Eigen::VectorXd sigma_ = Eigen::VectorXd::Constant(6, 0.5);
  FaceParts parts() const {
    return {lines_of({"zyg_major", "orb_palpebral", "frontal_med"}), muscles::muscle_template(),
            sigma_};
  }
};

TEST_F(PartsOfAFace, ShareMotionByTheVarianceOfTheirMuscles) {
  const Eigen::MatrixXd shares = parts().shares(response_);
  ASSERT_EQ(shares.rows(), 3);
  ASSERT_EQ(shares.cols(), FaceParts::kCount + 1);
  const double mouth = 0.25 * 9, eye = 0.25 * 16, none = 0.04, all = mouth + eye + none;  // mm^2
  EXPECT_NEAR(shares(0, 0), mouth / all, 1e-12);
  EXPECT_NEAR(shares(0, 2), eye / all, 1e-12);
  EXPECT_NEAR(shares(0, 6), none / all, 1e-12);
  EXPECT_NEAR(shares(1, 1), 6.25 / 6.29, 1e-12) << "the left side has parts of its own";
  EXPECT_EQ(shares(2, 6), 1) << "no muscle moves this place";
  EXPECT_LT((shares.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-12);
}

TEST_F(PartsOfAFace, AreMadeByTheMusclesThatMatterThere) {
  EXPECT_THAT(parts().makers(response_), ElementsAre(ElementsAre(0), ElementsAre(1), ElementsAre(2),
                                                     IsEmpty(), IsEmpty(), IsEmpty(), IsEmpty()));
  const auto lines = lines_of({"zyg_major", "risorius"});
  Eigen::MatrixXd two = Eigen::MatrixXd::Zero(3, 4);
  two(0, 0) = two(0, 2) = 3e-3;
  const auto makers = [&](double readiness) {
    return FaceParts(lines, muscles::muscle_template(), Eigen::Vector4d(0.5, 0.5, readiness, 0.5))
        .makers(two)[0];
  };
  EXPECT_THAT(makers(0.5), ElementsAre(0, 2));
  EXPECT_THAT(makers(0.12), ElementsAre(0, 2)) << "5.4 % of the variance";
  EXPECT_THAT(makers(0.11), ElementsAre(0)) << "4.6 %";
}

}  // namespace
}  // namespace hyperex::simulate
