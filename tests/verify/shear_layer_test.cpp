// SPDX-License-Identifier: GPL-3.0-or-later
// A layer of Kelvin-Voigt tissue on a rigid base in simple shear u_x(z, t):
//   rho u'' = G u_zz + eta u'_zz.
// Its solutions are known both for a driven and for a free top.
#include <gtest/gtest.h>

#include <complex>

#include "hyperex/fem/time/newmark.hpp"
#include "support/fem_support.hpp"

namespace hyperex::fem {
namespace {

using Complex = std::complex<double>;

// The default tissue's shear modulus; the solution does not depend on Poisson's ratio.
constexpr double kHeight = 0.02, kDensity = 1100, kShear = 64.35e3, kLayerPoisson = 0.3;
constexpr double kLayerYoung = 2 * (1 + kLayerPoisson) * kShear;

/// Half as wide as high. Nodes move along x alone, and not at all at the base.
struct Layer {
  test::BoxMesh box;
  System system;
  std::vector<int> prescribed;

  Layer(int cells, double viscosity_pa_s, bool driven)
      : box(test::box_mesh({cells / 2, cells / 2, cells}, Vec3(0.01, 0.01, kHeight), 0.1)),
        system(assemble(box.nodes, box.tets,
                        test::uniform_material(box.tets.rows(), kLayerYoung, kLayerPoisson,
                                               viscosity_pa_s, kDensity),
                        ElementKind::tet4)) {
    for (Eigen::Index n = 0; n < box.nodes.rows(); ++n) {
      const int u = static_cast<int>(3 * n);
      if (box.nodes(n, 2) < 1e-9 || (driven && is_top(u))) prescribed.push_back(u);
      prescribed.push_back(u + 1);
      prescribed.push_back(u + 2);
    }
  }
  bool is_top(int unknown) const {
    return unknown % 3 == 0 && box.nodes(unknown / 3, 2) > kHeight - 1e-9;
  }
  /// The field f(z) in the direction x.
  template <class F>
  Eigen::VectorXd field(const F& f) const {
    Points d = Points::Zero(box.nodes.rows(), 3);
    for (Eigen::Index n = 0; n < d.rows(); ++n) d(n, 0) = f(box.nodes(n, 2));
    return test::flat(d);
  }
};

struct DrivenError {
  double amplitude, phase_rad;  // at mid height, relative and absolute
  double field;                 // complex amplitudes of all nodes, relative to the driven one
};

/// The top moves as U sin(w t); inside, u = Im U e^(iwt) sin(kz) / sin(kH) with k^2 = rho w^2 / (G
/// + i w eta). The numerical solution is Fourier-analysed over the third period.
DrivenError driven_error(int cells, int steps_per_period) {
  const double eta = 40, w = 2 * M_PI * 150, way = 1e-3;
  const Complex i(0, 1);
  const Complex k = w * std::sqrt(kDensity / (kShear + i * w * eta));
  const auto exact = [&](double z) { return way * std::sin(k * z) / std::sin(k * kHeight); };
  const Layer layer(cells, eta, true);
  const double dt_s = 2 * M_PI / w / steps_per_period;
  Newmark newmark(layer.system, layer.prescribed, {dt_s});
  const auto at = [&](double t, Complex factor) {
    return layer.field(
        [&](double z) { return std::imag(factor * exact(z) * std::exp(i * w * t)); });
  };
  newmark.set_state(at(0, 1), at(0, i * w), at(0, -w * w));

  Eigen::VectorXcd found = Eigen::VectorXcd::Zero(layer.system.mass.cols());
  for (int step = 1; step <= 3 * steps_per_period; ++step) {
    const double t = step * dt_s;
    Eigen::VectorXd next(static_cast<Eigen::Index>(layer.prescribed.size()));
    for (Eigen::Index j = 0; j < next.size(); ++j)
      next[j] = layer.is_top(layer.prescribed[j]) ? way * std::sin(w * t) : 0;
    newmark.step(next);
    if (step > 2 * steps_per_period)
      found += 2.0 / steps_per_period * i * std::exp(-i * w * t) *
               newmark.displacement().cast<Complex>();
  }
  DrivenError error{};
  for (Eigen::Index n = 0; n < layer.box.nodes.rows(); ++n)
    error.field =
        std::max(error.field, std::abs(found[3 * n] - exact(layer.box.nodes(n, 2))) / way);
  const int middle = 3 * layer.box.node(0, 0, cells / 2);
  const Complex ratio = found[middle] / exact(kHeight / 2);
  error.amplitude = std::abs(ratio) - 1;
  error.phase_rad = std::arg(ratio);
  if (cells == 4)
    std::printf("exact at mid height: amplitude %.4f of the driven one, %.4f rad behind it\n",
                std::abs(exact(kHeight / 2)) / way, -std::arg(exact(kHeight / 2)));
  std::printf("%2d cells, %3d steps a period: amplitude %+.1e, phase %+.1e rad, field %.1e\n",
              cells, steps_per_period, error.amplitude, error.phase_rad, error.field);
  return error;
}

TEST(ShearLayer, FollowsAHarmonicDriveInAmplitudeAndPhase) {
  const DrivenError coarse = driven_error(4, 40), middle = driven_error(8, 80),
                    fine = driven_error(16, 160);
  EXPECT_LT(std::abs(fine.amplitude), 1e-3);
  EXPECT_LT(std::abs(fine.phase_rad), 2e-3);
  EXPECT_LT(fine.field, 3e-3);
  EXPECT_NEAR(std::log2(coarse.field / middle.field), 2, 0.25);
  EXPECT_NEAR(std::log2(middle.field / fine.field), 2, 0.25);
}

/// With a free top the layer oscillates as sin(pi z / 2H) q(t), q'' + eta k^2 / rho q' + G k^2 /
/// rho q = 0. Returns the greatest difference over three periods, divided by the initial amplitude.
double decay_error(int cells, int steps_per_period) {
  const double eta = 10, k = M_PI / 2 / kHeight;
  const double w2 = kShear * k * k / kDensity, decay = eta * k * k / kDensity / 2;
  const double damped = std::sqrt(w2 - decay * decay);
  const Layer layer(cells, eta, false);
  const double dt_s = 2 * M_PI / damped / steps_per_period;
  Newmark newmark(layer.system, layer.prescribed, {dt_s});
  const Eigen::VectorXd shape = layer.field([&](double z) { return std::sin(k * z); });
  newmark.set_state(shape, 0 * shape, -w2 * shape);
  const Eigen::VectorXd still =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(layer.prescribed.size()));
  double worst = 0;
  for (int step = 1; step <= 3 * steps_per_period; ++step) {
    newmark.step(still);
    const double t = step * dt_s;
    const double q =
        std::exp(-decay * t) * (std::cos(damped * t) + decay / damped * std::sin(damped * t));
    worst = std::max(worst, (newmark.displacement() - q * shape).cwiseAbs().maxCoeff());
  }
  std::printf("%2d cells, %3d steps a period: off by %.1e of the start\n", cells, steps_per_period,
              worst);
  return worst;
}

TEST(ShearLayer, SwingsAndDecaysFreely) {
  const double coarse = decay_error(4, 40), middle = decay_error(8, 80),
               fine = decay_error(16, 160);
  EXPECT_LT(fine, 5e-3);
  EXPECT_NEAR(std::log2(coarse / middle), 2, 0.25);
  EXPECT_NEAR(std::log2(middle / fine), 2, 0.25);
}

}  // namespace
}  // namespace hyperex::fem
