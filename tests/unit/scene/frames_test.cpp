// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/output/frames.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/box_mesh.hpp"

namespace hyperex::scene {
namespace {

constexpr double kYoung_pa = 6000, kPoisson = 0.25, kShear_pa = kYoung_pa / (2 * (1 + kPoisson));

/// A box of tissue whose points x are displaced by `gradient` x.
reenact::Performance strained_box(const Eigen::Matrix3d& gradient) {
  const test::BoxMesh box = test::box_mesh({2, 2, 2}, {0.02, 0.03, 0.04});
  reenact::Performance p;
  p.nodes = box.nodes;
  p.tets = box.tets;
  const auto count = static_cast<std::size_t>(p.tets.rows());
  p.tet_young_pa.assign(count, kYoung_pa);
  p.tet_poisson.assign(count, kPoisson);
  p.tet_viscosity_pa_s.assign(count, 100);
  p.frame_time_s = {0};
  p.node_displacement_m = {(p.nodes * gradient.transpose()).cast<float>()};
  return p;
}

const io::VtuArray& named(const std::vector<io::VtuArray>& arrays, const std::string& name) {
  for (const io::VtuArray& array : arrays)
    if (array.name == name) return array;
  throw std::logic_error("no array " + name);
}

std::vector<io::VtuArray> cells_of(const reenact::Performance& p, bool with_strain = true) {
  return FrameCells(p, with_strain).at(p.node_displacement_m[0].cast<double>());
}

TEST(Frames, StrainComponentsStandInParaViewsOrder) {
  Eigen::Matrix3d gradient;         // six different strains, and a small rotation that is none
  gradient << 0.001, 0.004, 0.002,  //
      0.010, 0.002, -0.003,         //
      0.008, 0.015, 0.003;
  const auto cells = cells_of(strained_box(gradient));
  const io::VtuArray& strain = named(cells, "strain (1)");
  ASSERT_EQ(strain.values.cols(), 6);
  const double expected[6] = {0.001, 0.002, 0.003, 0.007, 0.006, 0.005};  // XX YY ZZ XY YZ XZ
  for (Eigen::Index t = 0; t < strain.values.rows(); ++t)
    for (int k = 0; k < 6; ++k)
      EXPECT_NEAR(strain.values(t, k), expected[k], 1e-6) << t << ' ' << k;
  EXPECT_EQ(cells_of(strained_box(gradient), false).size(), cells.size() - 1);
}

TEST(Frames, VonMisesStressIsThatOfSimpleShearAndOfUniaxialStress) {
  Eigen::Matrix3d shear = Eigen::Matrix3d::Zero();
  shear(1, 2) = 0.02;  // engineering shear: sqrt(3) G gamma
  const double in_shear_kpa = 1e-3 * std::sqrt(3.0) * kShear_pa * 0.02;
  Eigen::Matrix3d pulled = -kPoisson * 0.01 * Eigen::Matrix3d::Identity();
  pulled(0, 0) = 0.01;  // E strain
  const double pulled_kpa = 1e-3 * kYoung_pa * 0.01;
  for (const auto& [gradient, expected] :
       {std::pair{shear, in_shear_kpa}, std::pair{pulled, pulled_kpa}}) {
    const auto cells = cells_of(strained_box(gradient));
    const auto& stress = named(cells, "von Mises stress (kPa)").values;
    EXPECT_NEAR(stress.minCoeff(), expected, 1e-4 * expected);
    EXPECT_NEAR(stress.maxCoeff(), expected, 1e-4 * expected);
  }
}

TEST(Frames, MarksElementsThatAreTurnedInsideOut) {
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  gradient(0, 1) = 0.01;
  reenact::Performance p = strained_box(gradient);
  // One more element, apart from the others, whose tip goes through its base.
  const int first = static_cast<int>(p.nodes.rows());
  p.nodes.conservativeResize(first + 4, 3);
  p.nodes.bottomRows(4) << 1, 0, 0, 1.01, 0, 0, 1, 0.01, 0, 1, 0, 0.01;
  p.tets.conservativeResize(p.tets.rows() + 1, 4);
  p.tets.bottomRows(1) << first, first + 1, first + 2, first + 3;
  p.node_displacement_m[0].conservativeResize(first + 4, 3);
  p.node_displacement_m[0].bottomRows(4) << 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -0.015F;
  p.tet_young_pa.push_back(kYoung_pa);
  p.tet_poisson.push_back(kPoisson);

  const auto cells = cells_of(p);
  const io::VtuArray& inverted = named(cells, "inverted");
  EXPECT_TRUE(inverted.flags);
  EXPECT_EQ(inverted.values.sum(), 1);
  EXPECT_EQ(inverted.values(p.tets.rows() - 1), 1);
  const auto summary = stress_summary(p);
  EXPECT_EQ(summary.at("inverted_tets"), 1);
  const auto& stress = named(cells, "von Mises stress (kPa)").values;
  const auto& kpa = summary.at("von_mises_stress_kpa");
  EXPECT_NEAR(kpa.at("max").get<double>(), stress.maxCoeff(), 1e-3);
  EXPECT_NEAR(kpa.at("max_not_inverted").get<double>(), 1e-3 * std::sqrt(3.0) * kShear_pa * 0.01,
              1e-4);
  EXPECT_GT(kpa.at("max"), 100 * kpa.at("max_not_inverted").get<double>());
  EXPECT_LE(kpa.at("median"), kpa.at("p95"));
  EXPECT_LE(kpa.at("p95"), kpa.at("p99"));
}

TEST(Frames, GreatestPrincipalStrainIsTheGreatestEigenvalueOfTheTensor) {
  Eigen::Matrix3d tensor;  // no two components alike
  tensor << 0.010, 0.007, 0.002, 0.007, -0.020, 0.015, 0.002, 0.015, 0.030;
  const auto summary = stress_summary(strained_box(tensor));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solved(tensor, Eigen::EigenvaluesOnly);
  EXPECT_NEAR(summary["greatest_principal_strain"]["max"].get<double>(),
              solved.eigenvalues().maxCoeff(), 1e-6);
}

TEST(Frames, PercentilesOfAnEvenStrainAreAllTheSame) {
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  gradient(0, 2) = 0.06;  // principal strains 0.03, 0, -0.03
  const auto summary = stress_summary(strained_box(gradient));
  for (const char* share : {"median", "p95", "p99", "max", "max_not_inverted"}) {
    EXPECT_NEAR(summary["greatest_principal_strain"][share].get<double>(), 0.03, 1e-6) << share;
    EXPECT_NEAR(summary["von_mises_stress_kpa"][share].get<double>(),
                1e-3 * std::sqrt(3.0) * kShear_pa * 0.06, 1e-4);
  }
  EXPECT_EQ(summary["inverted_tets"], 0);
  EXPECT_TRUE(stress_summary({}).is_null()) << "nothing was simulated";
}

}  // namespace
}  // namespace hyperex::scene
