// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "hyperex/fem/material/linear_viscoelastic.hpp"

namespace hyperex::fem {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

Eigen::Matrix3d tensor_of_strain(const Vector6& e) {
  Eigen::Matrix3d m;
  m << e[0], e[3] / 2, e[5] / 2, e[3] / 2, e[1], e[4] / 2, e[5] / 2, e[4] / 2, e[2];
  return m;
}
Vector6 strain_of_tensor(const Eigen::Matrix3d& m) {
  return (Vector6() << m(0, 0), m(1, 1), m(2, 2), 2 * m(0, 1), 2 * m(1, 2), 2 * m(2, 0)).finished();
}
Eigen::Matrix3d tensor_of_stress(const Vector6& s) {
  Eigen::Matrix3d m;
  m << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return m;
}

/// Anisotropy of the law: by how much rotating the strain differs from rotating the stress,
/// relative to the stress.
double anisotropy(const Voigt& law) {
  const Eigen::Matrix3d r =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Vector6 e = (Vector6() << 0.3, -0.2, 0.5, 0.4, -0.6, 0.1).finished();
  const Eigen::Matrix3d turned_stress = r * tensor_of_stress(law * e) * r.transpose();
  const Vector6 turned_strain = strain_of_tensor(r * tensor_of_strain(e) * r.transpose());
  return (tensor_of_stress(law * turned_strain) - turned_stress).norm() / turned_stress.norm();
}

TEST(ElasticTensor, IsTheInverseOfHookesCompliance) {
  const double young = 192.4e3, nu = 0.495;
  Voigt compliance = Voigt::Zero();
  compliance.topLeftCorner<3, 3>().setConstant(-nu / young);
  compliance.diagonal().head<3>().setConstant(1 / young);
  compliance.diagonal().tail<3>().setConstant(2 * (1 + nu) / young);
  EXPECT_LT((elastic_tensor(young, nu) * compliance - Voigt::Identity()).norm(), 1e-12);
  EXPECT_LT(anisotropy(elastic_tensor(young, nu)), 1e-12);
}

TEST(ViscousTensor, IsotropicFormIsStokesLaw) {
  const double eta = 476.8;
  const Voigt c = viscous_tensor(eta, ViscousForm::isotropic);
  const Vector6 rate = (Vector6() << 0.3, -0.2, 0.5, 0.4, -0.6, 0.1).finished();
  Eigen::Matrix3d deviator = tensor_of_strain(rate);
  deviator.diagonal().array() -= deviator.trace() / 3;
  EXPECT_LT((tensor_of_stress(c * rate) - 2 * eta * deviator).norm(), 1e-12 * eta);
  EXPECT_LT(anisotropy(c), 1e-12);
}

TEST(ViscousTensor, PrintedFormIsAsPrintedAndNotIsotropic) {
  Voigt expected = Voigt::Zero();
  expected.topLeftCorner<3, 3>() << 2, -1, -1, -1, 2, -1, -1, -1, 2;
  expected.bottomRightCorner<3, 3>() = 3 * Eigen::Matrix3d::Identity();
  const Voigt c = viscous_tensor(476.8, ViscousForm::printed);
  EXPECT_LT((c - 476.8 / 3 * expected).norm(), 1e-10);
  EXPECT_GT(anisotropy(c), 0.05);
}

TEST(ViscousTensor, PureVolumeRateGivesNoStress) {
  const Vector6 swelling = (Vector6() << 1, 1, 1, 0, 0, 0).finished();
  for (const ViscousForm form : {ViscousForm::isotropic, ViscousForm::printed})
    EXPECT_LT((viscous_tensor(476.8, form) * swelling).norm(), 1e-10);
}

}  // namespace
}  // namespace hyperex::fem
