// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <vector>

#include "hyperex/core/describe.hpp"

namespace hyperex::fem {

/// The viscous tensor C', which maps the rate of engineering strain to the viscous stress.
///  isotropic: Stokes' law s' = 2 eta dev(e'): eta/3 ([4 -2 -2; ...] (+) 3 I)
///  printed:   as printed in the thesis [4.26], not isotropic: eta/3 ([2 -1 -1; ...] (+) 3 I)
enum class ViscousForm { isotropic, printed };
constexpr auto words_of(ViscousForm) {
  return std::array{Word{"isotropic", ViscousForm::isotropic},
                    Word{"printed", ViscousForm::printed}};
}

/// Linear viscoelastic material, one value per element.
struct Material {
  std::vector<double> young_pa;        ///< > 0
  std::vector<double> poisson;         ///< in (-1, 0.5)
  std::vector<double> viscosity_pa_s;  ///< >= 0
  std::vector<double> density_kg_m3;   ///< >= 0
  ViscousForm viscous_form = ViscousForm::isotropic;
};

/// Throws the InputError for an inadmissible modulus or Poisson's ratio.
[[noreturn, gnu::cold]] void refuse_modulus(double young_pa, double poisson);

/// E / (2 (1 + nu))
inline double shear_modulus_pa(double young_pa, double poisson) {
  if (!(young_pa > 0 && poisson > -1)) refuse_modulus(young_pa, poisson);
  return young_pa / (2 * (1 + poisson));
}
/// E / (3 (1 - 2 nu))
inline double bulk_modulus_pa(double young_pa, double poisson) {
  if (!(young_pa > 0 && poisson < 0.5)) refuse_modulus(young_pa, poisson);
  return young_pa / (3 * (1 - 2 * poisson));
}

using Voigt = Eigen::Matrix<double, 6, 6>;
/// Strain order (e_x, e_y, e_z, g_xy, g_yz, g_zx), engineering shear.
Voigt elastic_tensor(double young_pa, double poisson);
Voigt viscous_tensor(double viscosity_pa_s, ViscousForm form);

}  // namespace hyperex::fem
