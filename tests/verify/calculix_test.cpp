// SPDX-License-Identifier: GPL-3.0-or-later
// Comparison with CalculiX on a face: linear tetrahedra, damping, driven points, 0.2 s of motion.
//
// ccx factorises in every step, so that a coarse mesh and few steps keep this short. With
// HYPEREX_CALCULIX_FINE=1 the mesh has the default size (6 mm for viscosity) and there are 100
// steps.
//
// ccx 2.20 omits the effect of the driven unknowns' velocity and acceleration on free ones (- C_oc
// d'_c and - M_oc d''_c) and integrates the mass at one point. The library has these terms. Only
// here they are omitted too, so that all other terms can be compared to the last printed digit.
// Their effect is measured separately and compared with theory.
#include "support/calculix.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"
#include "support/fem_support.hpp"

namespace hyperex::fem {
namespace {

using test::CalculixModel;
using test::DrivenTerms;
using test::History;

constexpr double kAgreement = 1e-6;  // of the greatest displacement
constexpr double kYoung = 192.4e3, kPoisson = 0.495, kEta = 476.8, kDensity = 1100;
constexpr double kShear = kYoung / 2 / (1 + kPoisson);
constexpr double kDuration_s = 0.2;

struct Resolution {
  double element_size_m;
  int steps;
};

/// The coarse resolution, or the fine one on request.
Resolution resolution(double fine_element_size_m) {
  if (std::getenv("HYPEREX_CALCULIX_FINE")) return {fine_element_size_m, 100};
  return {0.008, 25};
}

/// The embedded face, held at its outer border. Seven points around the mouth are moved there and
/// back, each axis of each point by its own distance and in its own time.
CalculixModel face_model(const Resolution& resolution) {
  const anatomy::EmbeddedFace face = anatomy::embedded_face();
  tissue::TissueMeshOptions options;
  options.element_size_m = resolution.element_size_m;
  const tissue::TissueMesh mesh =
      tissue::build_tissue_mesh(face.mesh, face.landmarks, options, "the embedded face");
  CalculixModel model;
  model.nodes = mesh.volume.nodes;
  model.tets = mesh.volume.tets;
  model.density_kg_m3 = kDensity;
  model.dt_s = kDuration_s / resolution.steps;

  const auto surface = static_cast<int>(mesh.volume.surface_nodes());
  for (int level = 0; level <= mesh.volume.layers; ++level)
    for (int v = 0; v < surface; ++v)
      if (mesh.on_border[v]) model.held_nodes.push_back(level * surface + v);
  for (const int k : {48, 54, 51, 57, 8, 58, 56}) {
    const Vec3 point = face.landmarks.at("ibug68_" + std::to_string(k));
    Eigen::Index nearest = 0;
    (mesh.volume.outer.points.rowwise() - point.transpose())
        .rowwise()
        .squaredNorm()
        .minCoeff(&nearest);
    for (int axis = 0; axis < 3; ++axis)
      model.driven.push_back(static_cast<int>(3 * nearest) + axis);
  }
  const auto count = static_cast<Eigen::Index>(model.driven.size());
  const Eigen::VectorXd way = 5e-3 * test::random_vector(count, 3);
  model.motion_m.resize(resolution.steps, count);
  for (int i = 0; i < resolution.steps; ++i)
    for (Eigen::Index j = 0; j < count; ++j) {
      const double period_s = 0.12 + 0.01 * static_cast<double>(j);
      model.motion_m(i, j) = way[j] * std::pow(std::sin(M_PI * (i + 1) * model.dt_s / period_s), 2);
    }
  return model;
}

System assembled(const CalculixModel& model, double viscosity_pa_s) {
  return assemble(model.nodes, model.tets,
                  test::uniform_material(model.tets.rows(), model.young_pa, model.poisson,
                                         viscosity_pa_s, model.density_kg_m3),
                  ElementKind::tet4);
}

DrivenTerms rayleigh(const SparseMatrix& stiffness, const SparseMatrix& mass, double alpha_per_s,
                     double beta_s, bool with_driven) {
  return {stiffness, alpha_per_s * mass + beta_s * stiffness, mass, with_driven, with_driven};
}

struct Compared {
  History imitated, ccx;
};

/// Runs both programs and checks that they agree.
Compared expect_agreement(const DrivenTerms& imitation, const CalculixModel& model) {
  const auto start = std::chrono::steady_clock::now();
  Compared c;
  c.imitated = test::integrate(imitation, model);
  const double own_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const test::CalculixRun run =
      test::run_calculix(model, test::calculix_gain(test::greatest(c.imitated)));
  c.ccx = run.displacement_m;
  const double apart = test::difference(c.imitated, c.ccx);
  const auto steps = static_cast<int>(model.motion_m.rows());
  std::printf(
      "%ld nodes, %ld tetrahedra, %zu driven unknowns, %d steps: ccx %.0f ms a step, "
      "the imitation %.1f ms; greatest displacement %.3f mm, apart %.2e of it\n",
      model.nodes.rows(), model.tets.rows(), model.driven.size(), steps, 1e3 * run.seconds / steps,
      1e3 * own_s / steps, 1e3 * test::greatest(c.imitated), apart);
  EXPECT_LT(apart, kAgreement);
  return c;
}

/// The lag of ccx. Let C = beta K, with negligible inertia, and G the static map from driven to
/// free unknowns. The correct solution is d_o = G d_c. Without the damping of driven unknowns it is
/// d_o + beta d'_o = G d_c. The difference p therefore obeys p + beta p' = beta (G d_c)'. Returns
/// |p - measured| / |measured|.
double lag_error(const History& own, const History& ccx, const CalculixModel& model) {
  const double h = model.dt_s, beta = model.beta_s;
  Eigen::VectorXd p = Eigen::VectorXd::Zero(own.front().size()), before = p;
  double off = 0, all = 0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    p = ((beta - h / 2) * p + beta * (own[i] - before)) / (beta + h / 2);  // trapezoidal
    before = own[i];
    Eigen::VectorXd measured = own[i] - ccx[i], predicted = p;
    for (const int u : model.driven) measured[u] = predicted[u] = 0;
    off += (predicted - measured).squaredNorm();
    all += measured.squaredNorm();
  }
  return std::sqrt(off / all);
}

void skip_without_ccx() {
  if (!test::find_calculix())
    GTEST_SKIP() << "ccx is not on the PATH (Debian: apt-get install calculix-ccx)";
}

class CalculiX : public ::testing::Test {
 protected:
  void SetUp() override { skip_without_ccx(); }
};

TEST_F(CalculiX, MovesTheFaceAlikeWithRayleighDamping) {
  CalculixModel model = face_model(resolution(tissue::TissueMeshOptions().element_size_m));
  model.young_pa = kYoung;
  model.poisson = kPoisson;
  model.alpha_per_s = 5;
  model.beta_s = kEta / kShear;  // as much in shear as the default viscosity
  const System system = assembled(model, 0);
  const SparseMatrix mass = test::one_point_mass(model);
  const auto [imitated, ccx] = expect_agreement(
      rayleigh(system.stiffness, mass, model.alpha_per_s, model.beta_s, false), model);

  // To be meaningful, the check must fail where a term is slightly wrong.
  const auto apart = [&, &ccx = ccx](const char* what, const DrivenTerms& terms) {
    const double d = test::difference(test::integrate(terms, model), ccx);
    std::printf("  %-44s %.2e\n", what, d);
    return d;
  };
  const auto with = [&](const SparseMatrix& k, const SparseMatrix& m, double alpha, double beta) {
    return rayleigh(k, m, model.alpha_per_s * alpha, model.beta_s * beta, false);
  };
  CalculixModel other = model;
  other.poisson = 0.4951;
  EXPECT_GT(apart("Poisson's ratio 0.4951", with(assembled(other, 0).stiffness, mass, 1, 1)),
            kAgreement);
  EXPECT_GT(apart("beta 1.001", with(system.stiffness, mass, 1, 1.001)), kAgreement);
  EXPECT_GT(apart("alpha 1.1", with(system.stiffness, mass, 1.1, 1)), kAgreement);
  EXPECT_GT(apart("mass entries V/15 on the diagonal",
                  with(system.stiffness, test::one_point_mass(model, 1.0 / 15), 1, 1)),
            kAgreement);
  EXPECT_GT(apart("consistent mass", with(system.stiffness, system.mass, 1, 1)), kAgreement);
  DrivenTerms inertia = with(system.stiffness, mass, 1, 1);
  inertia.inertia_of_driven = true;
  EXPECT_GT(apart("inertia of driven nodes", inertia), kAgreement);
  DrivenTerms damping = with(system.stiffness, mass, 1, 1);
  damping.damping_of_driven = true;
  EXPECT_GT(apart("damping of driven nodes", damping), kAgreement);

  const History own = test::integrate(
      rayleigh(system.stiffness, system.mass, model.alpha_per_s, model.beta_s, true), model);
  const double lag = lag_error(own, ccx, model);
  std::printf("  %-44s %.2e, as the lag predicts to %.2g of it\n", "the library's terms, all three",
              test::difference(own, ccx), lag);
  EXPECT_LT(lag, 1e-3);
}

TEST_F(CalculiX, DissipatesAlikeWithStokesViscosity) {
  // For a material without resistance to changes of volume, K = G / eta C. The beta K of ccx is
  // then the damping of Stokes' viscosity, which ccx does not have otherwise.
  CalculixModel model = face_model(resolution(0.006));
  model.poisson = -1 + 1e-8;
  model.young_pa = 2 * kShear * (1 + model.poisson);
  model.beta_s = kEta / kShear;
  const System system = assembled(model, kEta);
  DrivenTerms terms{system.stiffness, system.damping, test::one_point_mass(model), false, false};
  const Compared c = expect_agreement(terms, model);
  terms.damping = assembled(model, 1.001 * kEta).damping;
  const double off = test::difference(test::integrate(terms, model), c.ccx);
  std::printf("  viscosity 1.001: %.2e\n", off);
  EXPECT_GT(off, kAgreement);
}

}  // namespace
}  // namespace hyperex::fem
