// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/material/linear_viscoelastic.hpp"

#include "hyperex/fem/material/entry.hpp"

namespace hyperex::fem {

Voigt elastic_tensor(double young_pa, double poisson) {
  if (!(young_pa > 0 && poisson > -1 && poisson < 0.5)) refuse_modulus(young_pa, poisson);
  const double lambda = young_pa * poisson / ((1 + poisson) * (1 - 2 * poisson));
  const double shear = young_pa / (2 * (1 + poisson));
  Voigt d = Voigt::Zero();
  d.topLeftCorner<3, 3>().setConstant(lambda);
  d.diagonal().head<3>().array() += 2 * shear;
  d.diagonal().tail<3>().setConstant(shear);
  return d;
}

Voigt viscous_tensor(double viscosity_pa_s, ViscousForm form) {
  require(viscosity_pa_s >= 0, "viscosity_pa_s = {}: expected 0 or a number above it",
          viscosity_pa_s);
  // Engineering shear rates are twice the tensor components. So s' = 2 eta dev(e') has eta on the
  // shear diagonal and 2 eta (1 - 1/3) on the normal diagonal. The printed form halves only the
  // normal block.
  const double off = (form == ViscousForm::isotropic ? -2.0 : -1.0) * viscosity_pa_s / 3;
  Voigt c = Voigt::Zero();
  c.topLeftCorner<3, 3>().setConstant(off);
  c.diagonal().head<3>().setConstant(-2 * off);
  c.diagonal().tail<3>().setConstant(viscosity_pa_s);
  return c;
}

}  // namespace hyperex::fem
