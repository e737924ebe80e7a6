// SPDX-License-Identifier: GPL-3.0-or-later
// A bar held at one end, bent and released: energy, dissipation, and the order in dt.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <unsupported/Eigen/MatrixFunctions>

#include "hyperex/fem/solve/static_solve.hpp"
#include "hyperex/fem/time/newmark.hpp"
#include "support/fem_support.hpp"

namespace hyperex::fem {
namespace {

struct Bar {
  test::BoxMesh box;
  Material material;
  System system;
  std::vector<int> held;

  Bar(std::array<int, 3> cells, double viscosity_pa_s)
      : box(test::box_mesh(cells, Vec3(0.08, 0.02, 0.02), 0.1)),
        material(test::uniform_material(box.tets.rows(), 192.4e3, 0.45, viscosity_pa_s, 1100)),
        system(assemble(box.nodes, box.tets, material, ElementKind::tet4)),
        held(test::unknowns_where(box.nodes, [](const Vec3& p) { return p.x() < 1e-9; })) {}

  Eigen::VectorXd still() const {
    return Eigen::VectorXd::Zero(static_cast<Eigen::Index>(held.size()));
  }

  /// The displacement under an oblique force at the free end.
  Eigen::VectorXd bent() const {
    Points force = Points::Zero(box.nodes.rows(), 3);
    for (Eigen::Index n = 0; n < force.rows(); ++n)
      if (box.nodes(n, 0) > 0.08 - 1e-9) force.row(n) << 0.02, 0.01, -0.004;
    return StaticSolver(system.stiffness, held).solve(still(), test::flat(force));
  }

  /// The acceleration in equilibrium with K d + C v.
  Eigen::VectorXd balanced_acceleration(const Eigen::VectorXd& d, const Eigen::VectorXd& v) const {
    return StaticSolver(system.mass, held)
        .solve(still(), Eigen::VectorXd(-(system.stiffness * d) - system.damping * v));
  }

  /// Energies are computed from the fields, not from K and M.
  double energy(const Newmark& newmark) const {
    return test::strain_energy(box, material, test::unflat(newmark.displacement())) +
           test::kinetic_energy(box, material, test::unflat(newmark.velocity()));
  }
};

TEST(OscillatingBar, KeepsItsEnergyOverAThousandStepsWithoutViscosity) {
  const Bar bar({6, 2, 2}, 0);
  const Eigen::VectorXd d = bar.bent(), v = Eigen::VectorXd::Zero(d.size());
  for (const double dt_s : {5e-4, 2e-3, 2e-2}) {
    Newmark newmark(bar.system, bar.held, {dt_s});
    newmark.set_state(d, v, bar.balanced_acceleration(d, v));
    const double start = bar.energy(newmark);
    ASSERT_GT(start, 0);
    double drift = 0, most_kinetic = 0;
    for (int i = 0; i < 1000; ++i) {
      newmark.step(bar.still());
      drift = std::max(drift, std::abs(bar.energy(newmark) / start - 1));
      most_kinetic = std::max(most_kinetic, test::kinetic_energy(bar.box, bar.material,
                                                                 test::unflat(newmark.velocity())));
    }
    EXPECT_LT(drift, 1e-8) << "dt " << dt_s;
    EXPECT_GT(most_kinetic, 0.3 * start) << "it must swing";
  }
}

TEST(OscillatingBar, LosesWhatTheViscosityDissipates) {
  const Bar bar({6, 2, 2}, 40);
  const Eigen::VectorXd d = bar.bent(), v = Eigen::VectorXd::Zero(d.size());
  Newmark newmark(bar.system, bar.held, {2e-3});
  newmark.set_state(d, v, bar.balanced_acceleration(d, v));
  const double start = bar.energy(newmark);
  double dissipated = 0, worst = 0;
  for (int i = 0; i < 500; ++i) {
    const Eigen::VectorXd before = newmark.velocity();
    newmark.step(bar.still());
    const Points middle = test::unflat((before + newmark.velocity()) / 2);
    dissipated += 2e-3 * 2 * test::dissipation_potential(bar.box, bar.material, middle);
    worst = std::max(worst, std::abs(bar.energy(newmark) + dissipated - start) / start);
  }
  EXPECT_LT(worst, 1e-8);
  EXPECT_GT(dissipated, 0.3 * start) << "viscosity must matter";
}

TEST(OscillatingBar, ConvergesWithOrderTwoInTheStep) {
  const Bar bar({3, 1, 1}, 40);
  const auto n = bar.system.mass.cols();
  const auto free = test::complement(n, bar.held);
  const auto f = static_cast<Eigen::Index>(free.size());
  const Eigen::MatrixXd k = Eigen::MatrixXd(bar.system.stiffness)(free, free);
  const Eigen::MatrixXd c = Eigen::MatrixXd(bar.system.damping)(free, free);
  const Eigen::MatrixXd m = Eigen::MatrixXd(bar.system.mass)(free, free);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(k, m);
  // The initial state contains only the two slowest modes, which the time steps resolve.
  Eigen::VectorXd d = Eigen::VectorXd::Zero(n), v = d;
  d(free) = modes.eigenvectors().col(0);
  v(free) = std::sqrt(modes.eigenvalues()[1]) * modes.eigenvectors().col(1);

  const double period = 2 * M_PI / std::sqrt(modes.eigenvalues()[0]), end = 0.75 * period;
  Eigen::MatrixXd first_order = Eigen::MatrixXd::Zero(2 * f, 2 * f);
  first_order.topRightCorner(f, f).setIdentity();
  first_order.bottomLeftCorner(f, f) = -m.llt().solve(k);
  first_order.bottomRightCorner(f, f) = -m.llt().solve(c);
  Eigen::VectorXd exact(2 * f);
  exact << d(free), v(free);
  exact = (first_order * end).exp() * exact;

  std::vector<double> d_error, v_error;
  for (const int steps : {60, 120, 240}) {
    Newmark newmark(bar.system, bar.held, {end / steps});
    newmark.set_state(d, v, bar.balanced_acceleration(d, v));
    for (int i = 0; i < steps; ++i) newmark.step(bar.still());
    d_error.push_back((newmark.displacement()(free) - exact.head(f)).norm() / exact.head(f).norm());
    v_error.push_back((newmark.velocity()(free) - exact.tail(f)).norm() / exact.tail(f).norm());
  }
  for (int i = 0; i < 2; ++i) {
    const double d_order = std::log2(d_error[i] / d_error[i + 1]);
    const double v_order = std::log2(v_error[i] / v_error[i + 1]);
    std::printf("order in dt: displacement %.3f, velocity %.3f (errors %.1e, %.1e)\n", d_order,
                v_order, d_error[i + 1], v_error[i + 1]);
    EXPECT_NEAR(d_order, 2, 0.1);
    EXPECT_NEAR(v_order, 2, 0.1);
  }
}

}  // namespace
}  // namespace hyperex::fem
