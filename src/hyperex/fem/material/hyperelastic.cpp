// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/material/hyperelastic.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/core/check_options.hpp"
#include "hyperex/fem/material/entry.hpp"

namespace hyperex::fem {
namespace {

OfRatio taylor(const OfRatio& at, double s) {
  return {at.w + s * (at.d + s * at.dd / 2), at.d + s * at.dd, at.dd};
}

/// J^exponent, continued by a polynomial below kLeastRatio.
OfRatio power(double j, double exponent) {
  const double from = std::max(j, kLeastRatio);
  const double w = std::pow(from, exponent);
  const OfRatio at{w, exponent * w / from, exponent * (exponent - 1) * w / (from * from)};
  return j < kLeastRatio ? taylor(at, j - kLeastRatio) : at;
}

}  // namespace

double least_c20(const Hyperelastic& law) {
  return 0 - std::sqrt(3 * law.c30);  // 0, not -0
}

bool is_admissible(const Hyperelastic& law) {
  return out_of_bounds(law).empty() && law.c20 >= least_c20(law);
}

LawResponse respond(const Hyperelastic& law, double shear_pa, double i1, double i2, double j) {
  LawResponse r;
  if (law.law == HyperelasticLaw::neo_hookean) {
    const double x = j - 1;
    r.w = shear_pa * ((i1 - 3) / 2 - x + x * x / 6);
    r.d1 = shear_pa / 2;
    r.dj = shear_pa * (x / 3 - 1);
    r.djj = shear_pa / 3;
    return r;
  }
  require(law.law != HyperelasticLaw::linear, "respond(): the linear law has no invariants");
  const bool yeoh = law.law == HyperelasticLaw::yeoh;
  const double c01 = law.law == HyperelasticLaw::mooney_rivlin ? law.c01 : 0;
  const double c10 = shear_pa / (2 * (1 + c01));
  const double c20 = yeoh ? law.c20 : 0, c30 = yeoh ? law.c30 : 0;

  const OfRatio q = power(j, -2.0 / 3);
  const double x = q.w * i1 - 3;
  r.w = c10 * x * (1 + x * (c20 + x * c30));
  const double slope = c10 * (1 + x * (2 * c20 + 3 * c30 * x));
  const double bend = c10 * (2 * c20 + 6 * c30 * x);
  r.d1 = slope * q.w;
  r.dj = slope * q.d * i1;
  r.d11 = bend * q.w * q.w;
  r.d1j = slope * q.d + bend * q.w * q.d * i1;
  r.djj = slope * q.dd * i1 + bend * q.d * q.d * i1 * i1;
  if (c01 > 0) {
    const OfRatio p = power(j, -4.0 / 3);
    const double c = c10 * c01;
    r.w += c * (p.w * i2 - 3);
    r.d2 = c * p.w;
    r.dj += c * p.d * i2;
    r.d2j = c * p.d;
    r.djj += c * p.dd * i2;
  }
  return r;
}

OfRatio volume_barrier(double j) {
  if (j >= 1) return {};
  const double from = std::max(j, kLeastRatio), x = from - 1;
  const OfRatio at{-std::log(from) + x - x * x / 2, -1 / from + 1 - x, 1 / (from * from) - 1};
  return j < kLeastRatio ? taylor(at, j - kLeastRatio) : at;
}

Eigen::Matrix3d first_piola_pa(const Hyperelastic& law, double shear_pa, const Eigen::Matrix3d& f,
                               double* energy_pa) {
  if (law.law == HyperelasticLaw::linear) {
    Eigen::Matrix3d e = (f + f.transpose()) / 2;
    e.diagonal().array() -= e.trace() / 3;
    if (energy_pa) *energy_pa = shear_pa * e.squaredNorm();
    return 2 * shear_pa * e;
  }
  const Eigen::Matrix3d cof = cofactor(f);
  const double i1 = f.squaredNorm(), j = f.col(0).dot(cof.col(0));
  const LawResponse r = respond(law, shear_pa, i1, cof.squaredNorm(), j);
  const OfRatio barrier = law.barrier ? volume_barrier(j) : OfRatio{};
  if (energy_pa) *energy_pa = r.w + shear_pa * barrier.w;
  return 2 * r.d1 * f + 2 * r.d2 * (i1 * f - f * (f.transpose() * f)) +
         (r.dj + shear_pa * barrier.d) * cof;
}

}  // namespace hyperex::fem
