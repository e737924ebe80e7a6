// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/principal_directions.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>

namespace hyperex::simulate {
namespace {

Eigen::MatrixXd orthonormal(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::srand(seed);
  const Eigen::MatrixXd any = Eigen::MatrixXd::Random(rows, columns);
  return any.householderQr().householderQ() * Eigen::MatrixXd::Identity(rows, columns);
}

TEST(PrincipalDirections, OfAMatrixOfKnownSingularValues) {
  const Eigen::VectorXd sizes = Eigen::Vector4d(5, 2, 0.1, 0.003);
  const Eigen::MatrixXd narrow = orthonormal(4, 4, 1), broad = orthonormal(30, 4, 2);
  for (const bool wide : {true, false}) {
    const Eigen::MatrixXd& left = wide ? narrow : broad;
    const Eigen::MatrixXd& right = wide ? broad : narrow;
    const PrincipalDirections found =
        principal_directions(left * sizes.asDiagonal() * right.transpose());
    EXPECT_LT((found.sizes - sizes).cwiseAbs().maxCoeff(), 1e-10);
    EXPECT_TRUE((found.directions.transpose() * left).cwiseAbs().isIdentity(1e-7));
    EXPECT_TRUE((found.directions.transpose() * found.directions).isIdentity(1e-12));
  }
}

TEST(PrincipalDirections, OfNothing) {
  EXPECT_EQ(principal_directions(Eigen::MatrixXd(6, 0)).directions.cols(), 0);
  EXPECT_EQ(principal_directions(Eigen::MatrixXd(0, 6)).sizes.size(), 0);
}

}  // namespace
}  // namespace hyperex::simulate
