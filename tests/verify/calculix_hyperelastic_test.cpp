// SPDX-License-Identifier: GPL-3.0-or-later
// Equilibria at finite strain against CalculiX: the same linear tetrahedra, the same energy. With
// HYPEREX_CALCULIX_FINE=1 the face has the default size of mesh.
#include <gtest/gtest.h>

#include <cstdlib>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/core/stopwatch.hpp"
#include "hyperex/fem/time/finite_newton.hpp"
#include "hyperex/motion/embedded_motion.hpp"
#include "hyperex/simulate/drive/boundary.hpp"
#include "hyperex/simulate/drive/point_curve.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"
#include "support/calculix.hpp"
#include "support/fem_support.hpp"

namespace hyperex::fem {
namespace {

constexpr double kAgreementOfPrints =
    1e-6;  // of the greatest displacement; ccx prints seven digits
constexpr double kShear_pa = 2e4, kPoissonRatio = 0.45;

/// A model, and the same problem in the library.
struct ComparedFinite {
  test::CalculixModel model;
  Material material;
  std::vector<int> prescribed;

  void prescribe() {
    prescribed = model.driven;
    for (const int n : model.held_nodes)
      for (int axis = 0; axis < 3; ++axis) prescribed.push_back(3 * n + axis);
    std::sort(prescribed.begin(), prescribed.end());
  }

  test::History own(const Hyperelastic& law, double tolerance = 1e-10) const {
    const Assembler assembler(model.nodes, model.tets, ElementKind::tet4);
    FiniteStrain form(assembler, material, law);
    FiniteNewtonOptions options;
    options.tolerance = tolerance;
    FiniteNewton newton(form, prescribed, options);
    test::History history;
    for (Eigen::Index i = 0; i < model.motion_m.rows(); ++i) {
      Eigen::VectorXd d = Eigen::VectorXd::Zero(model.nodes.size());
      d(model.driven) = model.motion_m.row(i).transpose();
      newton.equilibrium(d(prescribed));
      history.push_back(newton.displacement());
    }
    return history;
  }

  double apart(const Hyperelastic& law, const test::History& ccx, const char* what) const {
    const double d = test::difference(own(law), ccx);
    std::printf("  %-44s %.2e\n", what, d);
    return d;
  }
};

struct Pulled : ComparedFinite {
  Pulled() {
    const test::BoxMesh box = test::box_mesh({4, 3, 3}, Vec3(0.04, 0.03, 0.03), 0.15);
    model.nodes = box.nodes;
    model.tets = box.tets;
    const double young = 2 * kShear_pa * (1 + kPoissonRatio);
    material = test::uniform_material(box.tets.rows(), young, kPoissonRatio, 0, 1000);
    model.hyperelastic = {kShear_pa / 2, 0, 0, bulk_modulus_pa(young, kPoissonRatio)};
    model.dt_s = 0.25;
    // One end is held, the other is stretched by half, sheared, and rotated by 0.4 rad.
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.4, Vec3::UnitX()).toRotationMatrix();
    const Vec3 centre(0.04, 0.015, 0.015);
    std::vector<double> way;
    for (int n = 0; n < box.nodes.rows(); ++n) {
      const Vec3 p = box.nodes.row(n).transpose();
      if (p.x() < 1e-9) model.held_nodes.push_back(n);
      if (p.x() < 0.04 - 1e-9) continue;
      const Vec3 to = centre + turn * (p - centre) + Vec3(0.02, 0.01, 0) - p;
      for (int axis = 0; axis < 3; ++axis) {
        model.driven.push_back(3 * n + axis);
        way.push_back(to[axis]);
      }
    }
    const auto count = static_cast<Eigen::Index>(way.size());
    model.motion_m.resize(4, count);
    for (int i = 0; i < 4; ++i)
      model.motion_m.row(i) =
          (i + 1) / 4.0 * Eigen::Map<const Eigen::RowVectorXd>(way.data(), count);
    prescribe();
  }
};

/// The embedded face, held at its outer border. Its driven patches are displaced by `share` of
/// their displacement at the peak of the embedded mouth opening.
struct OpenMouth : ComparedFinite {
  OpenMouth(double element_size_m, double share, int steps, double young, double poisson) {
    const anatomy::EmbeddedFace face = anatomy::embedded_face();
    tissue::TissueMeshOptions options;
    options.element_size_m = element_size_m;
    const tissue::TissueMesh mesh =
        tissue::build_tissue_mesh(face.mesh, face.landmarks, options, "the embedded face");
    model.nodes = mesh.volume.nodes;
    model.tets = mesh.volume.tets;
    material = test::uniform_material(model.tets.rows(), young, poisson, 0, 1000);
    model.hyperelastic = {shear_modulus_pa(young, poisson) / 2, 0, 0,
                          bulk_modulus_pa(young, poisson)};
    model.dt_s = 1.0 / steps;

    motion::MouthOpeningOptions opening;
    opening.head_moves = false;
    const simulate::AlignedMotion motion =
        simulate::align(motion::embedded_mouth_opening(face.landmarks, opening), face.landmarks);
    const auto region = simulate::measured_region(mesh, face.landmarks, motion, {});
    const simulate::DrivenSkin driven =
        simulate::driven_skin(mesh, face.landmarks, motion, region, {});
    const Points at_peak =
        driven.weights * simulate::PointCurve(motion, 1).at(motion.motion.time_s.back() / 2);
    const auto surface = static_cast<int>(mesh.volume.surface_nodes());
    for (int level = 0; level <= mesh.volume.layers; ++level)
      for (int v = 0; v < surface; ++v)
        if (mesh.on_border[v] &&
            !std::binary_search(driven.nodes.begin(), driven.nodes.end(), level * surface + v))
          model.held_nodes.push_back(level * surface + v);
    for (const int n : driven.nodes)
      for (int axis = 0; axis < 3; ++axis) model.driven.push_back(3 * n + axis);
    const Eigen::Map<const Eigen::RowVectorXd> way(at_peak.data(), at_peak.size());
    model.motion_m.resize(steps, way.size());
    for (int i = 0; i < steps; ++i) model.motion_m.row(i) = share * (i + 1) / steps * way;
    prescribe();
  }
};

class CalculiXHyperelastic : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!test::find_calculix())
      GTEST_SKIP() << "ccx is not on the PATH (Debian: apt-get install calculix-ccx)";
  }
};

TEST_F(CalculiXHyperelastic, NeoHookean) {
  const Pulled pulled;
  Hyperelastic law;
  law.law = HyperelasticLaw::isochoric_neo_hookean;
  law.barrier = false;
  const auto ccx = test::run_calculix(pulled.model).displacement_m;
  EXPECT_LT(pulled.apart(law, ccx, "neo-Hookean"), kAgreementOfPrints);
  // To be meaningful, the check must fail where a law is slightly wrong.
  law.barrier = true;
  EXPECT_GT(pulled.apart(law, ccx, "with the barrier"), 10 * kAgreementOfPrints);
  law.barrier = false;
  law.law = HyperelasticLaw::mooney_rivlin;
  law.c01 = 0.01;
  EXPECT_GT(pulled.apart(law, ccx, "a hundredth of I2bar"), 10 * kAgreementOfPrints);
  law.law = HyperelasticLaw::neo_hookean;
  EXPECT_GT(pulled.apart(law, ccx, "I1 in place of I1bar"), 10 * kAgreementOfPrints);
}

TEST_F(CalculiXHyperelastic, Yeoh) {
  Pulled pulled;
  Hyperelastic law;
  law.law = HyperelasticLaw::yeoh;
  law.c30 = 0.2;
  law.barrier = false;
  pulled.model.hyperelastic->c20_pa = law.c20 * kShear_pa / 2;
  pulled.model.hyperelastic->c30_pa = law.c30 * kShear_pa / 2;
  const auto ccx = test::run_calculix(pulled.model).displacement_m;
  EXPECT_LT(pulled.apart(law, ccx, "Yeoh"), kAgreementOfPrints);
  law.c30 *= 1.01;
  EXPECT_GT(pulled.apart(law, ccx, "c30 by 1 %"), 10 * kAgreementOfPrints);
}

/// The greatest stretch and the smallest volume ratio of all elements that are not entirely
/// prescribed.
std::pair<double, double> extremes(const ComparedFinite& model, const Eigen::VectorXd& d) {
  const Assembler assembler(model.model.nodes, model.model.tets, ElementKind::tet4);
  const FiniteStrain form(assembler, model.material, {});
  const Points stretch = form.principal_stretches(d);
  const Eigen::VectorXd ratio = form.volume_ratio(d);
  double most = 1, least = 1;
  for (Eigen::Index t = 0; t < ratio.size(); ++t) {
    int fixed = 0;
    for (int a = 0; a < 4; ++a)
      fixed += std::binary_search(model.prescribed.begin(), model.prescribed.end(),
                                  3 * model.model.tets(t, a));
    if (fixed == 4) continue;
    most = std::max(most, stretch(t, 2));
    least = std::min(least, ratio[t]);
  }
  return {most, least};
}

TEST_F(CalculiXHyperelastic, OpensTheMouthOfTheFace) {
  const bool fine = std::getenv("HYPEREX_CALCULIX_FINE");
  const double size_m = fine ? tissue::TissueMeshOptions().element_size_m : 0.006;
  const double share = 0.2;  // for much larger shares ccx finds no equilibrium
  const int steps = fine ? 12 : 6;
  const OpenMouth face(size_m, share, steps, 192.4e3, 0.495);
  Hyperelastic law;
  law.law = HyperelasticLaw::isochoric_neo_hookean;
  law.barrier = false;
  Stopwatch watch;
  const test::History own = face.own(law, 1e-6);
  const double own_s = watch.lap();
  const test::CalculixRun run = test::run_calculix(face.model, 1, 2);
  const double apart = test::difference(own, run.displacement_m);
  const auto [stretch, ratio] = extremes(face, own.back());
  std::printf(
      "%ld nodes, %ld tetrahedra, %zu driven unknowns, %d equilibria: ccx %.2f s, the library "
      "%.2f s (%.1f times as fast); greatest displacement %.2f mm, stretch %.2f, J from %.2f; "
      "apart %.2e\n",
      face.model.nodes.rows(), face.model.tets.rows(), face.model.driven.size(), steps, run.seconds,
      own_s, run.seconds / own_s, 1e3 * test::greatest(own), stretch, ratio, apart);
  EXPECT_LT(apart, 1e-5);
  EXPECT_GT(stretch, 1.3) << "a case of finite strain";
  law.barrier = true;
  EXPECT_GT(face.apart(law, run.displacement_m, "with the barrier"), 1e-4);
  law.barrier = false;
  law.law = HyperelasticLaw::linear;
  EXPECT_GT(face.apart(law, run.displacement_m, "small strain"), 0.01);
}

}  // namespace
}  // namespace hyperex::fem
