// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/frames.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "hyperex/metrics/peak_tissue.hpp"
#include "support/box_mesh.hpp"

namespace hyperex::run {
using namespace scene;
using namespace session;
namespace {

constexpr double kYoung_pa = 6000, kPoisson = 0.25, kShear_pa = kYoung_pa / (2 * (1 + kPoisson));

/// A box of tissue whose points x are displaced by `gradient` x.
simulate::Performance strained_box(const Eigen::Matrix3d& gradient) {
  const test::BoxMesh box = test::box_mesh({2, 2, 2}, {0.02, 0.03, 0.04});
  simulate::Performance p;
  p.nodes = box.nodes;
  p.tets = box.tets;
  const auto count = static_cast<std::size_t>(p.tets.rows());
  p.material.young_pa.assign(count, kYoung_pa);
  p.material.poisson.assign(count, kPoisson);
  p.material.viscosity_pa_s.assign(count, 100);
  p.frame_time_s = {0};
  p.node_displacement_m = {(p.nodes * gradient.transpose()).cast<float>()};
  return p;
}

nlohmann::ordered_json stress_summary(const simulate::Performance& p) {
  return metrics::json_of(metrics::peak_tissue(p));
}

const io::VtuArray& named(const std::vector<io::VtuArray>& arrays, const std::string& name) {
  for (const io::VtuArray& array : arrays)
    if (array.name == name) return array;
  throw std::logic_error("no array " + name);
}

std::vector<io::VtuArray> cells_of(const simulate::Performance& p, bool with_strain = true) {
  return FrameCells(p, with_strain).at(p.node_displacement_m[0].cast<double>());
}

/// Adds an element, apart from the others, whose tip is on the wrong side of its base.
void add_inverted(simulate::Performance& p) {
  const int first = static_cast<int>(p.nodes.rows());
  p.nodes.conservativeResize(first + 4, 3);
  p.nodes.bottomRows(4) << 1, 0, 0, 1.01, 0, 0, 1, 0.01, 0, 1, 0, 0.01;
  p.tets.conservativeResize(p.tets.rows() + 1, 4);
  p.tets.bottomRows(1) << first, first + 1, first + 2, first + 3;
  p.node_displacement_m[0].conservativeResize(first + 4, 3);
  p.node_displacement_m[0].bottomRows(4) << 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -0.015F;
  p.material.young_pa.push_back(kYoung_pa);
  p.material.poisson.push_back(kPoisson);
  p.material.viscosity_pa_s.push_back(100);
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
  simulate::Performance p = strained_box(gradient);
  add_inverted(p);

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
  EXPECT_NEAR(summary.at("von_mises_max_over_p99").get<double>(),
              kpa.at("max_not_inverted").get<double>() / kpa.at("p99").get<double>(), 1e-12)
      << "inverted ones do not count";
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
  EXPECT_NEAR(summary["von_mises_max_over_p99"].get<double>(), 1, 1e-4);
  EXPECT_EQ(summary["inverted_tets"], 0);
  EXPECT_TRUE(stress_summary({}).is_null()) << "nothing was simulated";
}

/// The same at finite strain.
simulate::Performance finite_box(const Eigen::Matrix3d& gradient, fem::ElementKind element) {
  simulate::Performance p = strained_box(gradient);
  p.model.strain = simulate::Strain::finite;
  p.model.element = element;
  p.model.law.law = fem::HyperelasticLaw::isochoric_neo_hookean;
  p.model.law.barrier = false;
  p.model.law.branches = {{0.5, 1}};  // which no elastic stress holds
  return p;
}

const Eigen::Matrix3d kTurned =
    Eigen::AngleAxisd(0.6, Eigen::Vector3d(1, -2, 3).normalized()).toRotationMatrix();

TEST(Frames, ATurnIsNoStressAtFiniteStrain) {
  const Eigen::Matrix3d gradient = kTurned - Eigen::Matrix3d::Identity();
  const auto of_linear = stress_summary(strained_box(gradient));
  EXPECT_GT(of_linear["von_mises_stress_kpa"]["median"], 0.1);
  for (const auto element : {fem::ElementKind::tet4, fem::ElementKind::tet4_star}) {
    const auto p = finite_box(gradient, element);
    const auto summary = stress_summary(p);
    EXPECT_LT(summary["von_mises_stress_kpa"]["max"], 1e-5);  // single precision
    EXPECT_LT(summary["greatest_principal_strain"]["max"], 1e-6);
    EXPECT_NEAR(summary["greatest_principal_stretch"]["max"].get<double>(), 1, 1e-6);
    EXPECT_NEAR(summary["volume_ratio"]["min"].get<double>(), 1, 1e-6);
    EXPECT_LT(named(cells_of(p), "Cauchy stress (kPa)").values.cwiseAbs().maxCoeff(), 1e-5);
  }
}

TEST(Frames, FiniteStrainAndStressAreThoseOfTheLaw) {
  const Eigen::Vector3d stretch(1.4, 0.8, 0.9);
  const Eigen::Matrix3d f = kTurned * stretch.asDiagonal();
  const double j = stretch.prod(), bulk_pa = kYoung_pa / (3 * (1 - 2 * kPoisson));
  const Eigen::Matrix3d b = f * f.transpose();
  const Eigen::Matrix3d deviator = b - b.trace() / 3 * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d cauchy_pa = kShear_pa * std::pow(j, -5.0 / 3) * deviator +
                                    bulk_pa * (j - 1) * Eigen::Matrix3d::Identity();
  const double von_mises_kpa =
      1e-3 * kShear_pa * std::pow(j, -5.0 / 3) * std::sqrt(1.5) * deviator.norm();
  constexpr int kRow[6] = {0, 1, 2, 0, 1, 0}, kColumn[6] = {0, 1, 2, 1, 2, 2};
  for (const auto element : {fem::ElementKind::tet4, fem::ElementKind::tet4_star}) {
    const auto p = finite_box(f - Eigen::Matrix3d::Identity(), element);
    const auto cells = cells_of(p);
    const auto& strain = named(cells, "Green-Lagrange strain (1)").values;
    const auto& stress = named(cells, "Cauchy stress (kPa)").values;
    const auto& stretches = named(cells, "principal stretches (1)").values;
    ASSERT_EQ(stress.cols(), 6);
    for (Eigen::Index t = 0; t < p.tets.rows(); ++t) {
      for (int k = 0; k < 6; ++k) {
        const double expected = kRow[k] == kColumn[k] ? (std::pow(stretch[k], 2) - 1) / 2 : 0;
        EXPECT_NEAR(strain(t, k), expected, 2e-6);
        EXPECT_NEAR(stress(t, k), 1e-3 * cauchy_pa(kRow[k], kColumn[k]), 2e-5);
      }
      EXPECT_NEAR(stretches(t, 0), 0.8, 1e-6);
      EXPECT_NEAR(stretches(t, 1), 0.9, 1e-6);
      EXPECT_NEAR(stretches(t, 2), 1.4, 1e-6);
      EXPECT_NEAR(named(cells, "volume ratio J (1)").values(t), j, 2e-6);
      EXPECT_NEAR(named(cells, "von Mises stress (kPa)").values(t), von_mises_kpa, 2e-5);
    }
    EXPECT_EQ(cells_of(p, false).size(), cells.size() - 3);
    const auto summary = stress_summary(p);
    EXPECT_NEAR(summary["von_mises_stress_kpa"]["p95"].get<double>(), von_mises_kpa, 2e-5);
    EXPECT_NEAR(summary["von_mises_max_over_p99"].get<double>(), 1, 1e-5);
    EXPECT_NEAR(summary["greatest_principal_strain"]["median"].get<double>(), 0.48, 2e-6);
    EXPECT_NEAR(summary["volume_ratio"]["median"].get<double>(), j, 2e-6);
  }
}

TEST(Frames, ElementsInsideOutHaveNoStressAtFiniteStrain) {
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  gradient(0, 0) = 0.2;
  auto p = finite_box(gradient, fem::ElementKind::tet4);
  add_inverted(p);
  const auto cells = cells_of(p);
  const auto& stress = named(cells, "von Mises stress (kPa)").values;
  for (Eigen::Index t = 0; t < p.tets.rows(); ++t)
    EXPECT_EQ(std::isnan(stress(t)), t == p.tets.rows() - 1) << t;
  const auto summary = stress_summary(p);
  EXPECT_EQ(summary["inverted_tets"], 1);
  EXPECT_TRUE(summary["von_mises_stress_kpa"]["max"].is_number());
  EXPECT_NEAR(summary["von_mises_max_over_p99"].get<double>(), 1, 1e-4);
  EXPECT_NEAR(summary["volume_ratio"]["min"].get<double>(), 1.2, 1e-5);
}

}  // namespace
}  // namespace hyperex::run
