// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string_view>
#include <vector>

#include "hyperex/core/describe.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex::fem {

/// The law of the resistance to a change of shape. mu = E / (2 (1 + nu)) of the Material is the
/// shear modulus of each law at rest, so that all laws have the same stiffness there as the linear
/// formulation. I1 = |F|^2, I2 = |cof F|^2, J = det F. I1bar = J^(-2/3) I1 and I2bar = J^(-4/3) I2
/// do not depend on the change of volume, which the dilatation groups resist
/// (form/finite_strain.hpp).
///  linear:        W = mu |dev e|^2 with the small strain e; the linear formulation
///  neo_hookean:   W = mu/2 (I1 - 3) - mu (J - 1) + mu/6 (J - 1)^2, finite for any F; the base of
///                 Smith, de Goes and Kim (Stable Neo-Hookean Flesh Simulation, ACM Trans. Graph.
///                 37, 2018), minus its own volumetric part at rest
///  isochoric_neo_hookean: W = mu/2 (I1bar - 3)
///  yeoh:          W = C10 (x + c20 x^2 + c30 x^3), x = I1bar - 3, C10 = mu/2
///                 (Yeoh, Rubber Chem. Technol. 66, 1993)
///  mooney_rivlin: W = C10 (I1bar - 3 + c01 (I2bar - 3)), C10 = mu / (2 (1 + c01))
///                 (Mooney, J. Appl. Phys. 11, 1940; Rivlin, Phil. Trans. R. Soc. A 241, 1948)
enum class HyperelasticLaw { linear, neo_hookean, isochoric_neo_hookean, yeoh, mooney_rivlin };

inline constexpr HyperelasticLaw kHyperelasticLaws[] = {
    HyperelasticLaw::linear, HyperelasticLaw::neo_hookean, HyperelasticLaw::isochoric_neo_hookean,
    HyperelasticLaw::yeoh, HyperelasticLaw::mooney_rivlin};

/// The laws that the user can choose. `linear` is for comparisons only and has no name.
constexpr auto words_of(HyperelasticLaw) {
  return std::array{Word{"neo-hookean", HyperelasticLaw::neo_hookean},
                    Word{"isochoric-neo-hookean", HyperelasticLaw::isochoric_neo_hookean},
                    Word{"yeoh", HyperelasticLaw::yeoh},
                    Word{"mooney-rivlin", HyperelasticLaw::mooney_rivlin}};
}
constexpr std::string_view to_string(HyperelasticLaw law) {
  return law == HyperelasticLaw::linear ? "linear" : word_of(law);
}

/// A spring and a dashpot in series, parallel to the law. After a step of stretch, its stress is
/// `ratio` times that of the law and then decays as exp(-t / relaxation_s). E is the modulus after
/// full relaxation.
struct MaxwellBranch {
  double ratio = 0;
  double relaxation_s = 1;
  bool operator==(const MaxwellBranch&) const = default;

  static constexpr const char* about = "A spring and a dashpot in series, parallel to the law.";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.option(HX_MEMBER(ratio), "Instantaneous stress of the branch, as a ratio to that of the law.",
             {.bounds = {0, 100}, .required = true});
    v.option(HX_MEMBER(relaxation_s),
             "Relaxation time: the time in which that stress falls to 1/e at a constant stretch.",
             {.unit = kSeconds, .bounds = {1e-6, 1e6}, .required = true});
  }
};

/// A law with its parameters. They are dimensionless ratios, so that only E varies in space.
struct Hyperelastic {
  HyperelasticLaw law = HyperelasticLaw::neo_hookean;
  /// C20/C10 and C30/C10 of yeoh. Default: 1.175 / 2.5 kPa of facial tissue (Nazari, Perrier,
  /// Chabanas and Payan, Comput. Methods Biomech. Biomed. Engin. 13, 2010).
  double c20 = 0.47, c30 = 0;
  double c01 = 0;  ///< C01/C10 of mooney_rivlin; 0 is isochoric_neo_hookean
  /// Prevents the inversion of elements: adds mu (-ln J + x - x^2/2), x = J - 1, where J < 1. The
  /// first two derivatives vanish at J = 1. Below kLeastRatio it is continued by its second-order
  /// Taylor polynomial, so that it is finite for any F. `linear` has no barrier.
  bool barrier = true;
  std::vector<MaxwellBranch> branches = {};  ///< in addition to the Material's viscosity
  bool operator==(const Hyperelastic&) const = default;

  static constexpr const char* about = "The hyperelastic law at finite strain.";
  /// The setting that a scene needs for the law to have an effect.
  static constexpr const char* only_where = "tissue.strain = \"finite\"";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.option(HX_MEMBER(law),
             "The hyperelastic law where tissue.strain = \"finite\". Its stiffness at small strain "
             "is that of tissue.young_kpa and tissue.poisson.",
             {.key = "law", .name = "name", .only_where = only_where});
    v.option(HX_MEMBER(c20),
             "C20 / C10 of tissue.law = \"yeoh\", a ratio. C10 is no key: it follows from "
             "tissue.young_kpa = 4 (1 + poisson) C10. The default is of facial tissue "
             "(C10 2.5 kPa, C20 1.175 kPa, so young_kpa = 15).",
             {.bounds = {-10, 100}, .key = "yeoh_c20", .only_where = only_where});
    v.option(HX_MEMBER(c30), "C30 / C10 of tissue.law = \"yeoh\", a ratio.",
             {.bounds = {0, 100}, .key = "yeoh_c30", .only_where = only_where});
    v.option(HX_MEMBER(c01),
             "C01 / C10 of tissue.law = \"mooney-rivlin\", a ratio: tissue.young_kpa = "
             "4 (1 + poisson) (C10 + C01).",
             {.bounds = {0, 100}, .key = "mooney_c01", .only_where = only_where});
    v.option(HX_MEMBER(branches),
             "A Maxwell branch (a spring and a dashpot in series), parallel to the law and the "
             "viscosity: tissue held at a stretch relaxes. tissue.young_kpa is the long-term "
             "stiffness. Only where tissue.strain = \"finite\".",
             {.name = "maxwell", .only_where = only_where});
  }
};

/// Below this volume ratio, functions that are singular at J = 0 are continued by a second-order
/// polynomial: the barrier, and J^(-2/3), J^(-4/3) of the isochoric laws.
inline constexpr double kLeastRatio = 0.05;

/// The least c20 for which the derivative of yeoh's energy with respect to I1bar is positive:
/// -sqrt(3 c30).
double least_c20(const Hyperelastic& law);

/// Whether the parameters are within their bounds and c20 >= least_c20().
bool is_admissible(const Hyperelastic& law);

/// W (J/m^3 = Pa) and its derivatives with respect to I1, I2 and J.
struct LawResponse {
  double w = 0;
  double d1 = 0, d2 = 0, dj = 0;
  /// Those by I1 and I2 and by I2 twice are always zero.
  double d11 = 0, d1j = 0, d2j = 0, djj = 0;
};

/// The energy of the law without the barrier; not for `linear`. Only mooney_rivlin uses `i2`.
LawResponse respond(const Hyperelastic& law, double shear_pa, double i1, double i2, double j);

/// A function of J with its first two derivatives.
struct OfRatio {
  double w = 0, d = 0, dd = 0;
};

/// The barrier divided by the shear modulus.
OfRatio volume_barrier(double j);

/// First Piola-Kirchhoff stress dW/dF (Pa) of law and barrier at the deformation gradient F, and
/// their energy density. For evaluation at single points; `linear` is allowed.
Eigen::Matrix3d first_piola_pa(const Hyperelastic& law, double shear_pa, const Eigen::Matrix3d& f,
                               double* energy_pa = nullptr);

/// cof F = dJ/dF.
inline Eigen::Matrix3d cofactor(const Eigen::Matrix3d& f) {
  Eigen::Matrix3d c;
  c.col(0) = f.col(1).cross(f.col(2));
  c.col(1) = f.col(2).cross(f.col(0));
  c.col(2) = f.col(0).cross(f.col(1));
  return c;
}

}  // namespace hyperex::fem
