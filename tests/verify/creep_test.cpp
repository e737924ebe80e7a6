// SPDX-License-Identifier: GPL-3.0-or-later
// A Kelvin-Voigt bar with deviatoric viscosity under a suddenly applied traction:
//   e(t) = sigma / (9 K) + sigma / (3 G) (1 - exp(-G t / eta)).
#include <gtest/gtest.h>

#include "hyperex/fem/time/newmark.hpp"
#include "support/fem_support.hpp"

namespace hyperex::fem {
namespace {

constexpr double kYoung_pa = 192.4e3, kPoissonRatio = 0.45, kEta = 476.8, kTraction = 500;
const Vec3 kSize(0.04, 0.02, 0.02);
constexpr double kBulk = kYoung_pa / 3 / (1 - 2 * kPoissonRatio),
                 kShear_pa = kYoung_pa / 2 / (1 + kPoissonRatio);

/// Largest |strain - formula| over three relaxation times, divided by the final strain.
/// `viscosity_share`: the part of eta with which the form resists stretching (the printed form
/// halves it).
double creep_error(ViscousForm form, double viscosity_share) {
  const auto box = test::box_mesh({4, 2, 2}, kSize, 0.1);
  // Negligible inertia: the slowest elastic wave is a thousand times faster than the creep.
  const System s =
      assemble(box.nodes, box.tets,
               test::uniform_material(box.tets.rows(), kYoung_pa, kPoissonRatio, kEta, 1e-3, form),
               ElementKind::tet4);
  std::vector<int> rollers;
  for (int axis = 0; axis < 3; ++axis)
    for (const int u :
         test::unknowns_where(box.nodes, [&](const Vec3& p) { return p[axis] < 1e-9; }, {axis}))
      rollers.push_back(u);
  std::sort(rollers.begin(), rollers.end());

  // Nodal forces of a uniform traction on x = L, integrated over the triangles of that face.
  Points force = Points::Zero(box.nodes.rows(), 3);
  for (Eigen::Index t = 0; t < box.tets.rows(); ++t) {
    std::vector<int> face;
    for (int a = 0; a < 4; ++a)
      if (box.nodes(box.tets(t, a), 0) > kSize.x() - 1e-9) face.push_back(box.tets(t, a));
    if (face.size() != 3) continue;
    const auto at = [&](int i) -> Vec3 { return box.nodes.row(face[i]).transpose(); };
    const double area = (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
    for (const int node : face) force(node, 0) += kTraction * area / 3;
  }
  EXPECT_NEAR(force.col(0).sum(), kTraction * kSize.y() * kSize.z(), 1e-12);

  // Changes of volume are not damped: the test starts on the solution at t = 0+, to avoid undamped
  // oscillation.
  const double eta = viscosity_share * kEta;
  const auto stretch = [&](double volume, double shear) -> Eigen::VectorXd {
    const Points field =
        box.nodes * Vec3(volume + shear, volume - shear / 2, volume - shear / 2).asDiagonal();
    return test::flat(field);
  };
  const double dt_s = 5e-5;
  Newmark newmark(s, rollers, {dt_s});
  newmark.set_state(stretch(kTraction / (9 * kBulk), 0), stretch(0, kTraction / (3 * eta)),
                    stretch(0, -kTraction * kShear_pa / (3 * eta * eta)));
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rollers.size()));
  const double end = kTraction / (9 * kBulk) + kTraction / (3 * kShear_pa);
  const int far = box.node(4, 2, 2);
  double worst = 0;
  for (int i = 1; i * dt_s < 3 * kEta / kShear_pa; ++i) {
    newmark.step(still, test::flat(force));
    const double t = i * dt_s;
    const double expected = kTraction / (9 * kBulk) +
                            kTraction / (3 * kShear_pa) * (1 - std::exp(-kShear_pa * t / eta));
    worst = std::max(worst, std::abs(newmark.displacement()[3 * far] / kSize.x() - expected) / end);
  }
  return worst;
}

TEST(KelvinVoigtBar, CreepsAsTheFormula) {
  EXPECT_LT(creep_error(ViscousForm::isotropic, 1), 2e-5);
}

TEST(KelvinVoigtBar, PrintedFormResistsStretchingHalfAsMuch) {
  EXPECT_LT(creep_error(ViscousForm::printed, 0.5), 4e-5);
}

}  // namespace
}  // namespace hyperex::fem
