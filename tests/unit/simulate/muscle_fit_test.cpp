// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/load/muscle_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "hyperex/face/face_frame.hpp"
#include "simulate/small_face.hpp"

namespace hyperex::simulate {
namespace {

/// The rotation by `angle` about a unit axis, by Rodrigues' formula.
Eigen::Matrix3d turn_about(const Vec3& axis, double angle) {
  Eigen::Matrix3d cross;
  cross << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  return Eigen::Matrix3d::Identity() + std::sin(angle) * cross +
         (1 - std::cos(angle)) * cross * cross;
}

/// A few points that muscles and the jaw move.
class FitOfPoints : public testing::Test {
 protected:
  double normal() { return normal_(random_); }
  Eigen::MatrixXd matrix(Eigen::Index rows, Eigen::Index cols, double size) {
    return Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return size * normal(); });
  }
  /// Points about the chin, which move with the jaw by a share each.
  PointResponse response(int points, int muscles, bool wide = false) {
    PointResponse r{matrix(3 * points, muscles, 0.006), Eigen::MatrixXd::Zero(3 * points, 12), {}};
    if (wide) r.of_wide = r.of_muscles + matrix(3 * points, muscles, 0.002);
    for (int p = 0; p < points; ++p) {
      const Vec3 x = landmarks_.at("ibug68_8") + Vec3(matrix(3, 1, 0.03));
      const double share = 0.2 + 0.8 * p / points;
      for (int axis = 0; axis < 3; ++axis) {
        for (int column = 0; column < 3; ++column)
          r.of_jaw(3 * p + axis, 3 * column + axis) = share * x[column];
        r.of_jaw(3 * p + axis, 9 + axis) = share;
      }
    }
    return r;
  }
  static Eigen::VectorXd moved(const PointResponse& r, const JawKinematics& jaw,
                               const Eigen::VectorXd& activation, const JawPose& pose) {
    Eigen::VectorXd out = r.of_jaw * jaw.motion(pose);
    for (Eigen::Index m = 0; m < activation.size(); ++m) {
      const double a = activation[m];
      const double wide = r.of_wide.cols() > 0 && a > 0 ? a / (a + r.half) : 0;
      out += a * (1 - wide) * r.of_muscles.col(m);
      if (wide > 0) out += a * wide * r.of_wide.col(m);
    }
    return out;
  }
  static std::vector<char> none(int muscles) { return std::vector<char>(std::size_t(muscles), 0); }
  static std::vector<char> all(int muscles) { return std::vector<char>(std::size_t(muscles), 1); }

  const io::Landmarks landmarks_ = test::small_face().landmarks;
  const JawKinematics jaw_{landmarks_, nullptr};
  const FitPriors wide_{1e3, 1e3, 1e3, 1e3, 1e3, 1e3, Vec3::Constant(1e3)};
  std::mt19937 random_{3};
  std::normal_distribution<double> normal_;
};

TEST_F(FitOfPoints, TheJawTurnsAboutTheCondyles) {
  const face::FaceFrame frame = face::face_frame(landmarks_);
  const Vec3 centre = 0.5 * (landmarks_.at("ibug68_1") + landmarks_.at("ibug68_15"));
  JawPose pose;
  pose << 0.3, -0.04, 0.05, 0.002, -0.001, 0.003;
  const Eigen::Matrix3d turn =
      turn_about(frame.x, pose[0]) * turn_about(frame.y, pose[1]) * turn_about(frame.z, pose[2]);
  const Eigen::Matrix<double, 12, 1> motion = jaw_.motion(pose);
  for (const char* name : {"ibug68_8", "ibug68_57", "ibug68_1"}) {
    const Vec3 x = landmarks_.at(name);
    const Vec3 wanted = centre + turn * (x - centre) +
                        (frame.x * pose[3] + frame.y * pose[4] + frame.z * pose[5]) - x;
    const Vec3 got = motion.head<9>().reshaped(3, 3) * x + motion.tail<3>();
    EXPECT_LT((got - wanted).norm(), 1e-12) << name;
  }
  JawPose opening = JawPose::Zero();
  opening[0] = 0.2;
  const Vec3 chin = landmarks_.at("ibug68_8");
  const Eigen::Matrix<double, 12, 1> open = jaw_.motion(opening);
  EXPECT_LT(frame.y.dot(open.head<9>().reshaped(3, 3) * chin + open.tail<3>()), -0.005)
      << "opening takes the chin down";
  EXPECT_EQ(jaw_.motion(JawPose::Zero()), (Eigen::Matrix<double, 12, 1>::Zero()));
}

TEST_F(FitOfPoints, TheDerivativeIsThatOfTheMotion) {
  JawPose pose;
  pose << 0.25, 0.03, -0.02, 0.002, 0.001, -0.003;
  const auto derivative = jaw_.derivative(pose);
  constexpr double h = 1e-3;  // another step, of fourth order
  for (int k = 0; k < 6; ++k) {
    const auto at = [&](double way) {
      JawPose p = pose;
      p[k] += way;
      return jaw_.motion(p);
    };
    const Eigen::Matrix<double, 12, 1> wanted =
        (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
    EXPECT_LT((derivative.col(k) - wanted).cwiseAbs().maxCoeff(), 1e-8) << k;
    EXPECT_GT(wanted.norm(), 0.1);
  }
}

TEST_F(FitOfPoints, FindsWhatMovedThem) {
  const PointResponse r = response(20, 8);
  MuscleFit fit(r, jaw_, wide_, 1e-7, none(8), none(8));
  for (int k = 0; k < 5; ++k) {
    const Eigen::VectorXd a = matrix(8, 1, 0.4).cwiseMax(0);
    JawPose pose;
    pose << 0.1 + 0.1 * normal(), 0.02 * normal(), 0.02 * normal(), 0.001 * normal(),
        0.001 * normal(), 0.001 * normal();
    const FitResult found = fit.fit(moved(r, jaw_, a, pose));
    EXPECT_LT((found.activation - a).cwiseAbs().maxCoeff(), 1e-5) << k;
    EXPECT_LT((found.jaw - pose).cwiseAbs().maxCoeff(), 1e-5) << k;
    EXPECT_LT(found.left_over.cwiseAbs().maxCoeff(), 1e-8) << k;
  }
}

TEST_F(FitOfPoints, FindsItWithWideBandsToo) {
  const PointResponse r = response(20, 6, true);
  MuscleFit fit(r, jaw_, wide_, 1e-7, none(6), none(6));
  EXPECT_DOUBLE_EQ(fit.wide_share(0.5), 0.5);
  EXPECT_DOUBLE_EQ(fit.wide_share(1.5), 0.75);
  EXPECT_EQ(fit.wide_share(-1), 0);
  Eigen::VectorXd a(6);
  a << 0.7, 0, 0.2, 1.1, 0, 0.4;
  JawPose pose = JawPose::Zero();
  pose[0] = 0.15;
  const Eigen::VectorXd d = moved(r, jaw_, a, pose);
  FitResult found = fit.fit(d);
  for (int again = 0; again < 5; ++again) found = fit.fit(d);  // goes on from its last answer
  EXPECT_LT((found.activation - a).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_LT((found.jaw - pose).cwiseAbs().maxCoeff(), 1e-4);
}

/// One muscle, no jaw: the mean of the point's displacement and of the prior's, weighted by their
/// sigmas.
TEST_F(FitOfPoints, APriorWeighsByItsSigma) {
  const Eigen::Vector3d way(0.004, -0.003, 0.012);
  FitPriors priors;
  priors.activation = 0.3, priors.ring = 0.15, priors.tone = 0.05;
  const double sigma_m = 0.002;
  const auto found = [&](double a, bool tone, bool ring) {
    MuscleFit fit({way, Eigen::MatrixXd::Zero(3, 12), {}}, jaw_, priors, sigma_m, {tone}, {ring});
    return fit.fit(a * way);
  };
  const auto wanted = [&](double a, double sigma) {
    const double of_points = way.squaredNorm() / (sigma_m * sigma_m);
    return a * of_points / (of_points + 1 / (sigma * sigma));
  };
  EXPECT_NEAR(found(0.5, false, false).activation[0], wanted(0.5, 0.3), 1e-12);
  EXPECT_NEAR(found(0.5, false, true).activation[0], wanted(0.5, 0.15), 1e-12);
  EXPECT_NEAR(found(0.5, true, true).activation[0], wanted(0.5, 0.15), 1e-12);
  EXPECT_NEAR(found(-0.2, true, true).activation[0], wanted(-0.2, 0.05), 1e-12);
  EXPECT_EQ(found(-0.2, false, true).activation[0], 0) << "cannot push";
  const FitResult result = found(0.5, false, false);
  EXPECT_LT((result.left_over - (0.5 - result.activation[0]) * way).norm(), 1e-15);
  EXPECT_NEAR(std::sqrt(result.covariance(0, 0)),
              1 / std::sqrt(way.squaredNorm() / (sigma_m * sigma_m) + 1 / (0.3 * 0.3)), 1e-12);
}

/// Two muscles with the same effect on the points share it in the ratio of their priors' variances.
TEST_F(FitOfPoints, AReadierMuscleActsMore) {
  const Eigen::Vector3d way(0.004, -0.003, 0.012);
  Eigen::MatrixXd both(3, 2);
  both << way, way;
  FitPriors priors;
  priors.readiness = Eigen::Vector2d(1, 2);
  MuscleFit fit({both, Eigen::MatrixXd::Zero(3, 12), {}}, jaw_, priors, 0.001, {0, 0}, {0, 0});
  const Eigen::VectorXd a = fit.fit(0.4 * way).activation;
  EXPECT_GT(a[0], 0.05);
  EXPECT_NEAR(a[1], 4 * a[0], 1e-12);
}

/// Where the points determine one side alone, the expected activation of the other side follows
/// from the correlation, as for a Gaussian prior. Where they determine both sides, both follow the
/// points.
TEST_F(FitOfPoints, BothSidesAreExpectedToActAlikeUnlessPointsTellThemApart) {
  const Eigen::Vector3d way(0.004, -0.003, 0.012), other(0.002, 0.011, 0.001);
  FitPriors priors;
  priors.activation = 0.3, priors.ring = 0.15;
  priors.correlation = Eigen::Matrix2d{{1, 0.6}, {0.6, 1}};
  const Eigen::MatrixXd no_jaw = Eigen::MatrixXd::Zero(3, 12);
  Eigen::MatrixXd left_alone(3, 2), both(3, 2);
  left_alone << way, Vec3::Zero();
  both << way, other;
  const auto found = [&](const Eigen::MatrixXd& ways, double sigma_m, char right_is_ring) {
    MuscleFit fit({ways, no_jaw, {}}, jaw_, priors, sigma_m, {0, 0}, {0, right_is_ring});
    return fit.fit(0.5 * way);
  };
  const FitResult alone = found(left_alone, 0.002, 0);
  EXPECT_NEAR(alone.activation[1], 0.6 * alone.activation[0], 1e-12);
  EXPECT_NEAR(std::sqrt(alone.covariance(1, 1) - 0.36 * alone.covariance(0, 0)), 0.3 * 0.8, 1e-12)
      << "and the rest of it stays open";
  const double of_points = way.squaredNorm() / (0.002 * 0.002);
  EXPECT_NEAR(alone.activation[0], 0.5 * of_points / (of_points + 1 / 0.09), 1e-12)
      << "the left side is fitted as it would be without the right";
  const FitResult ring = found(left_alone, 0.002, 1);
  EXPECT_NEAR(ring.activation[1], 0.6 * 0.5 * ring.activation[0], 1e-12) << "by their sigmas";
  const FitResult apart = found(both, 1e-6, 0);
  EXPECT_NEAR(apart.activation[0], 0.5, 1e-6);
  EXPECT_NEAR(apart.activation[1], 0, 1e-6) << "a one-sided motion stays one";
}

/// Correlated muscles: mean and covariance are those of a Gaussian with that prior, conditioned on
/// the points. They are computed in the form that inverts the points' covariance instead of the
/// prior's.
TEST_F(FitOfPoints, CorrelatedMusclesAreAsAGaussianGivenThePoints) {
  constexpr int kMuscles = 4, kPoints = 2;
  const PointResponse r{
      matrix(3 * kPoints, kMuscles, 0.006), Eigen::MatrixXd::Zero(3 * kPoints, 12), {}};
  FitPriors priors;
  priors.activation = priors.tone = 0.3;
  priors.readiness = Eigen::Vector4d(1, 0.5, 2, 1);
  priors.correlation =
      Eigen::Matrix4d{{1, 0.5, -0.3, 0}, {0.5, 1, 0.2, 0.1}, {-0.3, 0.2, 1, 0.4}, {0, 0.1, 0.4, 1}};
  const double sigma_m = 0.002;
  MuscleFit fit(r, jaw_, priors, sigma_m, all(kMuscles), none(kMuscles));
  const Eigen::VectorXd observed = matrix(3 * kPoints, 1, 0.004);
  const FitResult found = fit.fit(observed);

  const Eigen::VectorXd sigma = 0.3 * priors.readiness;
  const Eigen::MatrixXd before = sigma.asDiagonal() * priors.correlation * sigma.asDiagonal();
  const Eigen::MatrixXd of_points =
      r.of_muscles * before * r.of_muscles.transpose() +
      sigma_m * sigma_m * Eigen::MatrixXd::Identity(3 * kPoints, 3 * kPoints);
  const Eigen::MatrixXd gain = before * r.of_muscles.transpose() * of_points.inverse();
  EXPECT_LT((found.activation - gain * observed).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LT((found.covariance - (before - gain * r.of_muscles * before)).cwiseAbs().maxCoeff(),
            1e-10);
  priors.correlation = Eigen::Matrix4d::Identity();
  MuscleFit alone(r, jaw_, priors, sigma_m, all(kMuscles), none(kMuscles));
  EXPECT_GT((alone.fit(observed).activation - found.activation).norm(), 0.02);
  EXPECT_LT((found.prior_covariance - before).cwiseAbs().maxCoeff(), 1e-15);
}

/// One point moves with the muscle alone and one with the jaw alone: the wider the jaw is open, the
/// smaller the expected activation.
TEST_F(FitOfPoints, AMuscleYieldsToTheOpeningJaw) {
  const Eigen::Vector3d way(0.004, -0.003, 0.012);
  PointResponse r{Eigen::MatrixXd::Zero(6, 1), Eigen::MatrixXd::Zero(6, 12), {}};
  r.of_muscles.topRows<3>() = way;
  r.of_jaw.bottomRows<3>() = response(1, 1).of_jaw;
  FitPriors priors;
  priors.activation = 0.3;
  priors.yields = Eigen::VectorXd::Constant(1, 8);
  const double sigma_m = 0.002;
  for (const double opening : {-0.1, 0.0, 0.15, 0.3}) {
    JawPose pose = JawPose::Zero();
    pose[0] = opening;
    MuscleFit fit(r, jaw_, priors, sigma_m, {0}, {0});
    const FitResult found = fit.fit(moved(r, jaw_, Eigen::VectorXd::Constant(1, 0.5), pose));
    const double of_points = way.squaredNorm() / (sigma_m * sigma_m);
    const double sigma = 0.3 / (1 + 8 * std::max(0.0, found.jaw[0]));
    EXPECT_NEAR(found.activation[0], 0.5 * of_points / (of_points + 1 / (sigma * sigma)), 1e-5)
        << opening;
    EXPECT_NEAR(std::sqrt(found.prior_covariance(0, 0)), sigma, 1e-5) << opening;
  }
}

/// For activations drawn from the prior and points with noise, sigma agrees with the error of the
/// fit.
TEST_F(FitOfPoints, SigmaIsWhatTheFitIsWrongBy) {
  constexpr int kMuscles = 5, kDraws = 3000;
  const PointResponse r = response(3, kMuscles);
  FitPriors priors;
  priors.activation = priors.ring = priors.tone = 0.2;
  priors.opening_rad = 0.02, priors.turn_rad = 0.01, priors.tilt_rad = 0.01;
  const double sigma_m = 0.001;
  MuscleFit fit(r, jaw_, priors, sigma_m, all(kMuscles), none(kMuscles));
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(kMuscles), sigma;
  for (int k = 0; k < kDraws; ++k) {
    const Eigen::VectorXd a = matrix(kMuscles, 1, 0.2);
    JawPose pose;
    pose << 0.02 * normal(), 0.01 * normal(), 0.01 * normal(), 0.002 * normal(), 0.002 * normal(),
        0.002 * normal();
    const FitResult found = fit.fit(moved(r, jaw_, a, pose) + matrix(3 * 3, 1, sigma_m));
    squares += (found.activation - a).cwiseAbs2();
    sigma = found.covariance.diagonal().cwiseSqrt();
  }
  const Eigen::VectorXd wrong = (squares / kDraws).cwiseSqrt();
  for (int m = 0; m < kMuscles; ++m) {
    EXPECT_NEAR(sigma[m] / wrong[m], 1, 0.1) << m;
    EXPECT_LT(sigma[m], 0.95 * 0.2) << "the points carry information";
    EXPECT_GT(sigma[m], 0.02) << "and not all";
  }
}

TEST_F(FitOfPoints, WithoutDataNothingActs) {
  const PointResponse r = response(7, 4, true);
  FitPriors priors;
  MuscleFit still(r, jaw_, priors, 0.001, {0, 0, 1, 1}, {0, 1, 0, 1});
  const FitResult at_rest = still.fit(Eigen::VectorXd::Zero(21));
  EXPECT_EQ(at_rest.activation, Eigen::VectorXd::Zero(4));
  EXPECT_EQ(at_rest.jaw, JawPose::Zero());
  EXPECT_EQ(at_rest.left_over, Eigen::VectorXd::Zero(21));
  priors.activation = 0.4, priors.ring = 0.3;
  MuscleFit blind({Eigen::MatrixXd(0, 4), Eigen::MatrixXd(0, 12), {}}, jaw_, priors, 0.001,
                  {0, 0, 1, 1}, {0, 1, 0, 1});
  const FitResult nothing = blind.fit(Eigen::VectorXd(0));
  EXPECT_EQ(nothing.activation, Eigen::VectorXd::Zero(4));
  EXPECT_EQ(nothing.jaw, JawPose::Zero());
  EXPECT_LT(
      (nothing.covariance.diagonal().cwiseSqrt() - Eigen::Vector4d(0.4, 0.3, 0.4, 0.3)).norm(),
      1e-12)
      << "the prior's own";
  EXPECT_LT((nothing.prior_covariance - nothing.covariance).norm(), 1e-12);
}

}  // namespace
}  // namespace hyperex::simulate
