// SPDX-License-Identifier: GPL-3.0-or-later
// Natural frequencies of a clamped bar compared with formulas, and the effect of the time steps on
// them.
#include <gtest/gtest.h>

#include <Eigen/SparseLU>
#include <functional>
#include <stdexcept>
#include <unsupported/Eigen/MatrixFunctions>

#include "hyperex/fem/time/newmark.hpp"
#include "support/fem_support.hpp"

namespace hyperex::fem {
namespace {

constexpr double kLength = 0.1, kWidth = 0.02, kDepth = 0.01;
constexpr double kBarYoung = 192.4e3, kBarDensity = 1100;

/// Clamped at x = 0. Poisson's ratio is 0, so that bar theory is valid at the clamp without
/// correction.
struct Cantilever {
  test::BoxMesh box;
  System system;
  std::vector<int> held, free;

  explicit Cantilever(std::array<int, 3> cells)
      : box(test::box_mesh(cells, Vec3(kLength, kWidth, kDepth))),
        system(assemble(box.nodes, box.tets,
                        test::uniform_material(box.tets.rows(), kBarYoung, 0, 0, kBarDensity),
                        ElementKind::tet4)),
        held(test::unknowns_where(box.nodes, [](const Vec3& p) { return p.x() < 1e-9; })),
        free(test::complement(system.mass.cols(), held)) {}

  SparseMatrix among_free(const SparseMatrix& m) const {
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t i = 0; i < free.size(); ++i)
      entries.emplace_back(free[i], static_cast<int>(i), 1.0);
    SparseMatrix choose(m.rows(), static_cast<Eigen::Index>(free.size()));
    choose.setFromTriplets(entries.begin(), entries.end());
    return choose.transpose() * m * choose;
  }
};

struct Mode {
  double omega;  // rad/s
  Eigen::VectorXd shape;
};

/// The mode nearest to a frequency, by inverse iteration from a guess of its shape.
Mode mode_near(const Cantilever& bar, double omega, const std::function<Vec3(double)>& guess) {
  const SparseMatrix k = bar.among_free(bar.system.stiffness), m = bar.among_free(bar.system.mass);
  const Eigen::SparseLU<SparseMatrix> factor(k - omega * omega * m);
  Points start(bar.box.nodes.rows(), 3);
  for (Eigen::Index n = 0; n < start.rows(); ++n)
    start.row(n) = guess(bar.box.nodes(n, 0) / kLength).transpose();
  Eigen::VectorXd x = test::flat(start)(bar.free);
  double square = 0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::VectorXd right = m * x;
    x = factor.solve(right);
    x /= std::sqrt(x.dot(m * x));
    const double before = square;
    square = x.dot(k * x);
    if (std::abs(square - before) < 1e-13 * square) break;
  }
  Mode mode{std::sqrt(square), Eigen::VectorXd::Zero(bar.system.mass.cols())};
  mode.shape(bar.free) = x / x.cwiseAbs().maxCoeff();
  return mode;
}

/// Three meshes, each twice as fine as the previous one: the error decreases with order 2, and the
/// last two frequencies, extrapolated with that order, agree with the formula.
void expect_frequency(double formula, double shift, std::array<int, 3> cells,
                      const std::function<Vec3(double)>& guess, double tolerance) {
  std::vector<double> found;
  for (int level = 0; level < 3; ++level) {
    const int f = 1 << level;
    found.push_back(
        mode_near(Cantilever({f * cells[0], f * cells[1], f * cells[2]}), shift, guess).omega);
    std::printf("%3d cells along: %.4f Hz, %+.2f %%\n", f * cells[0], found.back() / 2 / M_PI,
                100 * (found.back() / formula - 1));
  }
  const double extrapolated = (4 * found[2] - found[1]) / 3;
  std::printf("extrapolated %.4f Hz, formula %.4f Hz, %+.3f %%\n", extrapolated / 2 / M_PI,
              formula / 2 / M_PI, 100 * (extrapolated / formula - 1));
  EXPECT_NEAR(extrapolated / formula, 1, tolerance);
  EXPECT_NEAR(std::log2((found[1] - formula) / (found[2] - formula)), 2, 0.2);
}

TEST(ClampedBar, StretchesAtItsNaturalFrequency) {
  const double omega = M_PI / 2 / kLength * std::sqrt(kBarYoung / kBarDensity);
  expect_frequency(
      omega, omega, {12, 2, 2}, [](double s) { return Vec3(std::sin(M_PI / 2 * s), 0, 0); }, 2e-5);
}

/// The lowest frequency of a clamped-free Timoshenko beam. The state obeys (w, psi, M, Q)' =
/// A(omega) (w, psi, M, Q). At a natural frequency, (M, Q) at the clamp can be chosen such that (M,
/// Q) at the free end vanish.
double timoshenko_omega() {
  const double area = kWidth * kDepth, inertia = area * kDepth * kDepth / 12;
  const double shear = 5.0 / 6 * kBarYoung / 2 * area;
  const auto determinant = [&](double omega) {
    Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
    a(0, 1) = 1;  // w' = psi + Q / (kappa G A)
    a(0, 3) = 1 / shear;
    a(1, 2) = 1 / (kBarYoung * inertia);               // psi' = M / (E I)
    a(2, 1) = -kBarDensity * inertia * omega * omega;  // M' = -Q - rho I omega^2 psi
    a(2, 3) = -1;
    a(3, 0) = -kBarDensity * area * omega * omega;  // Q' = -rho A omega^2 w
    return Eigen::Matrix4d((a * kLength).exp()).bottomRightCorner<2, 2>().determinant();
  };
  // Start below the frequency of the Euler-Bernoulli beam, which is slightly too high.
  const double thin =
      1.8751 * 1.8751 / (kLength * kLength) * std::sqrt(kBarYoung * inertia / (kBarDensity * area));
  double low = 0.8 * thin, high = thin;
  if (determinant(low) * determinant(high) >= 0) throw std::logic_error("no frequency between");
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (determinant(low) * determinant(middle) <= 0 ? high : low) = middle;
  }
  return low;
}

TEST(ClampedBar, BendsAtItsNaturalFrequency) {
  expect_frequency(
      timoshenko_omega(), 0, {16, 2, 2}, [](double s) { return Vec3(0, 0, s * s); }, 5e-3);
}

TEST(ClampedBar, TimeStepsTurnTheFrequencyAsTheFormula) {
  // Average acceleration turns cos(w t) into exactly cos(i theta), with tan(theta / 2) = w dt / 2.
  const Cantilever bar({16, 2, 2});
  const Mode mode = mode_near(bar, 0, [](double s) { return Vec3(0, 0, s * s); });
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(bar.held.size()));
  for (const double share : {0.3, 1.0, 3.0}) {
    const double dt_s = share / mode.omega, theta = 2 * std::atan(share / 2);
    Newmark newmark(bar.system, bar.held, {dt_s});
    newmark.set_state(mode.shape, 0 * mode.shape, -mode.omega * mode.omega * mode.shape);
    double worst = 0;
    for (int i = 1; i <= 300; ++i) {
      newmark.step(still);
      worst = std::max(
          worst, (newmark.displacement() - std::cos(i * theta) * mode.shape).cwiseAbs().maxCoeff());
    }
    std::printf("w dt = %.1f: %.1e off after 300 steps\n", share, worst);
    EXPECT_LT(worst, 1e-7);
  }
}

}  // namespace
}  // namespace hyperex::fem
