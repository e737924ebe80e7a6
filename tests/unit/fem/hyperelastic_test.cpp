// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/material/hyperelastic.hpp"

#include <gtest/gtest.h>

#include <array>

#include "support/fem_support.hpp"
#include "support/laws.hpp"

namespace hyperex::fem {
namespace {

using Eigen::Matrix3d;

Matrix3d random_gradient(unsigned seed, double size) {
  return Matrix3d::Identity() + size * test::random_vector(9, seed).reshaped(3, 3);
}

Matrix3d random_rotation(unsigned seed) {
  const Eigen::VectorXd w = test::random_vector(4, seed);
  return Eigen::Quaterniond(w[0], w[1], w[2], w[3]).normalized().toRotationMatrix();
}

TEST(Hyperelastic, StressIsTheDerivativeOfTheEnergy) {
  for (const Hyperelastic& law : test::all_laws())
    for (unsigned seed = 1; seed < 30; ++seed) {
      Matrix3d f = random_gradient(seed, 0.4);
      if (seed % 3 == 0) f *= 0.5;                                  // deep in the barrier
      if (seed % 7 == 0) f.col(0) *= -0.2 * (seed % 2 ? 0.03 : 1);  // beyond it, inside out
      const Matrix3d p = first_piola_pa(law, 2e4, f);
      Matrix3d difference;
      const double h = 1e-6;
      for (int i = 0; i < 9; ++i) {
        Matrix3d to = f, from = f;
        to.data()[i] += h;
        from.data()[i] -= h;
        double up = 0, down = 0;
        first_piola_pa(law, 2e4, to, &up);
        first_piola_pa(law, 2e4, from, &down);
        difference.data()[i] = (up - down) / (2 * h);
      }
      EXPECT_LT((p - difference).norm(), 1e-6 * (p.norm() + 2e4))
          << to_string(law.law) << " " << seed << " J " << f.determinant();
    }
}

TEST(Hyperelastic, SecondDerivativesAreThoseOfTheResponse) {
  for (const Hyperelastic& law : test::finite_laws())
    for (const double j : {-0.5, 0.03, 0.3, 0.9, 1.2, 2.0}) {
      const double i1 = 4.1, i2 = 5.2, h = 1e-6;
      const LawResponse r = respond(law, 2e4, i1, i2, j);
      // Derivatives of w, d1, d2 and dj in one direction.
      const auto expect = [&](const Vec3& way, const std::array<double, 4>& expected) {
        const Vec3 step = h * way;
        const LawResponse up = respond(law, 2e4, i1 + step[0], i2 + step[1], j + step[2]);
        const LawResponse down = respond(law, 2e4, i1 - step[0], i2 - step[1], j - step[2]);
        const double found[] = {up.w - down.w, up.d1 - down.d1, up.d2 - down.d2, up.dj - down.dj};
        for (int i = 0; i < 4; ++i)
          EXPECT_NEAR(found[i] / (2 * h), expected[i], 1e-5 * (std::abs(expected[i]) + 1e3))
              << to_string(law.law) << " " << j << " " << i;
      };
      expect({1, 0, 0}, {r.d1, r.d11, 0, r.d1j});
      expect({0, 1, 0}, {r.d2, 0, 0, r.d2j});
      expect({0, 0, 1}, {r.dj, r.d1j, r.d2j, r.djj});
    }
}

TEST(Hyperelastic, BarrierIsSmoothZeroFromOneUpAndRisesToTheInverted) {
  EXPECT_EQ(volume_barrier(1.3).w, 0);
  double before = 0;
  for (double j = 1 - 1e-3; j > -1; j -= 1e-3) {
    const OfRatio at = volume_barrier(j);
    const double h = 1e-6;
    EXPECT_GT(at.w, before) << j;
    before = at.w;
    EXPECT_NEAR(at.d, (volume_barrier(j + h).w - volume_barrier(j - h).w) / (2 * h),
                1e-4 * (1 + std::abs(at.d)));
    EXPECT_NEAR(at.dd, (volume_barrier(j + h).d - volume_barrier(j - h).d) / (2 * h),
                1e-3 * (1 + at.dd));
  }
  // -ln J + x - x^2/2 begins with -x^3/3.
  EXPECT_NEAR(volume_barrier(0.99).w, 1e-6 / 3, 1e-8);
  EXPECT_NEAR(volume_barrier(0.5).w, std::log(2.0) - 0.5 - 0.125, 1e-15);
}

TEST(Hyperelastic, RestHasNoStressAndTheLinearStiffness) {
  const double shear = 3e4;
  for (Hyperelastic law : test::all_laws()) {
    EXPECT_LT(first_piola_pa(law, shear, Matrix3d::Identity()).norm(), 1e-10 * shear);
    for (unsigned seed = 1; seed < 6; ++seed) {
      const Matrix3d g = test::random_vector(9, seed).reshaped(3, 3);
      const double h = 1e-6;  // of the barrier's one-sided third derivative h remains
      const Matrix3d rate = (first_piola_pa(law, shear, Matrix3d::Identity() + h * g) -
                             first_piola_pa(law, shear, Matrix3d::Identity() - h * g)) /
                            (2 * h);
      Matrix3d e = (g + g.transpose()) / 2;
      e.diagonal().array() -= e.trace() / 3;
      EXPECT_LT((rate - 2 * shear * e).norm(), 1e-5 * shear) << to_string(law.law);
    }
  }
}

TEST(Hyperelastic, DoesNotSeeRotations) {
  for (const Hyperelastic& law : test::finite_laws())
    for (unsigned seed = 1; seed < 6; ++seed) {
      const Matrix3d f = random_gradient(seed, 0.3), q = random_rotation(seed);
      double energy = 0, turned = 0;
      const Matrix3d p = first_piola_pa(law, 2e4, f, &energy);
      const Matrix3d p_turned = first_piola_pa(law, 2e4, q * f, &turned);
      EXPECT_NEAR(turned, energy, 1e-11 * (energy + 2e4));
      EXPECT_LT((p_turned - q * p).norm(), 1e-11 * (p.norm() + 2e4));
    }
}

// The closed forms of textbooks for constant volume: W of I1 and I2 alone. `p` is the pressure at
// which the lateral sides carry no force.
TEST(Hyperelastic, UniaxialBiaxialAndSimpleShearAtConstantVolume) {
  const double mu = 2e4;
  for (const Hyperelastic& law : test::finite_laws()) {
    const bool yeoh = law.law == HyperelasticLaw::yeoh;
    const double c01 = law.law == HyperelasticLaw::mooney_rivlin ? law.c01 : 0;
    const double c10 = mu / 2 / (1 + c01);
    const auto w1 = [&](double i1) {
      const double x = i1 - 3;
      return c10 * (1 + (yeoh ? 2 * law.c20 * x + 3 * law.c30 * x * x : 0));
    };
    const double w2 = c10 * c01;
    // True stresses s_i - s_k = l_i P_i - l_k P_k.
    const auto difference = [&](const Vec3& stretch, int i, int k) {
      const Matrix3d p = first_piola_pa(law, mu, stretch.asDiagonal());
      return stretch[i] * p(i, i) - stretch[k] * p(k, k);
    };
    for (const double l : {0.6, 0.8, 1.3, 1.9}) {
      const double r = 1 / std::sqrt(l);
      const double uniaxial = 2 * (l * l - 1 / l) * (w1(l * l + 2 / l) + w2 / l);
      EXPECT_NEAR(difference({l, r, r}, 0, 1), uniaxial, 1e-9 * mu) << to_string(law.law);
      const double q = 1 / (l * l);
      const double biaxial = 2 * (l * l - q * q) * (w1(2 * l * l + q * q) + w2 * l * l);
      EXPECT_NEAR(difference({l, l, q}, 0, 2), biaxial, 1e-9 * mu) << to_string(law.law);
      Matrix3d shear = Matrix3d::Identity();
      shear(0, 1) = l;
      const Matrix3d cauchy = first_piola_pa(law, mu, shear) * shear.transpose();
      EXPECT_NEAR(cauchy(0, 1), 2 * l * (w1(3 + l * l) + w2), 1e-9 * mu) << to_string(law.law);
      // Poynting's effect: s_xx - s_yy = shear * s_xy (Rivlin 1948).
      EXPECT_NEAR(cauchy(0, 0) - cauchy(1, 1), l * cauchy(0, 1), 1e-9 * mu) << to_string(law.law);
    }
  }
}

TEST(Hyperelastic, RatiosThatWouldSoftenAreNotAdmissible) {
  Hyperelastic law;
  EXPECT_TRUE(is_admissible(law));
  law.c20 = -0.5;
  EXPECT_FALSE(is_admissible(law));
  law.c30 = 0.09;
  EXPECT_TRUE(is_admissible(law));
  law.c01 = -0.1;
  EXPECT_FALSE(is_admissible(law));
  law = {};
  law.branches = {{0.5, 0}};
  EXPECT_FALSE(is_admissible(law));
  law.branches = {{-0.5, 1}};
  EXPECT_FALSE(is_admissible(law));
  law.branches = {{0.5, 1}};
  EXPECT_TRUE(is_admissible(law));
}

}  // namespace
}  // namespace hyperex::fem
