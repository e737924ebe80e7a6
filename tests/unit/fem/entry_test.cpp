// SPDX-License-Identifier: GPL-3.0-or-later
// Invalid input of a calling program is refused at entry, by a sentence that names the entry.
// Nothing is computed from it, and the calling program continues.
#include "hyperex/fem/material/entry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "hyperex/fem.hpp"
#include "hyperex/fem/solve/complementarity.hpp"
#include "support/fem_support.hpp"
#include "support/refusal.hpp"

namespace hyperex::fem {
namespace {

using Eigen::VectorXd;
using test::refusal;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class Entry : public testing::Test {
 protected:
  Entry()
      : box(test::box_mesh({2, 2, 2}, {0.02, 0.02, 0.02}, 0)),
        material(test::uniform_material(box.tets.rows(), 1e4, 0.45, 100, 1000)),
        held(test::unknowns_where(box.nodes, [](const Vec3& p) { return p.x() < 1e-9; })),
        values(VectorXd::Zero(static_cast<Eigen::Index>(held.size()))),
        force(VectorXd::Zero(box.nodes.size())) {
    force[force.size() - 1] = 0.1;
  }
  System system() const { return assemble(box.nodes, box.tets, material); }
  VectorXd with(VectorXd v, Eigen::Index at, double value) const {
    v[at] = value;
    return v;
  }

  test::BoxMesh box;
  Material material;
  std::vector<int> held;
  VectorXd values, force;
};

TEST_F(Entry, CornersThatAreNoNodes) {
  const auto assembled = [&](const Tetrahedra& tets) {
    return refusal([&] { assemble(box.nodes, tets, material); });
  };
  for (const int wrong : {-1, 27, 1 << 30}) {
    Tetrahedra tets = box.tets;
    tets(5, 1) = wrong;
    const std::string said = "tetrahedron 5 has the corner " + std::to_string(wrong);
    EXPECT_THAT(assembled(tets), HasSubstr(said));
    EXPECT_THAT(refusal([&] { dilatation_groups(ElementKind::tet4_star, 27, tets); }),
                HasSubstr(said));
    EXPECT_THAT(refusal([&] { ElementStrain(box.nodes, tets); }), HasSubstr(said));
    EXPECT_THAT(refusal([&] { inverted_tets(box.nodes, tets, box.nodes); }), HasSubstr(said));
  }
  EXPECT_THAT(assembled(Tetrahedra(0, 4)), HasSubstr("no tetrahedra"));
  DilatationGroups groups;
  groups.tets.item = {0, 1, static_cast<int>(box.tets.rows())};
  groups.tets.start = {0, 3};
  EXPECT_THAT(refusal([&] { Assembler(box.nodes, box.tets, groups); }),
              HasSubstr("dilatation group 0 names tetrahedron"));
}

TEST_F(Entry, ValuesThatNoMaterialHas) {
  const auto said = [&](std::vector<double> Material::*member, double value) {
    Material wrong = material;
    (wrong.*member)[7] = value;
    const std::string linear = refusal([&] { assemble(box.nodes, box.tets, wrong); });
    const Assembler mesh(box.nodes, box.tets, ElementKind::tet4_star);
    EXPECT_EQ(linear, refusal([&] { FiniteStrain(mesh, wrong, {}); }));
    EXPECT_EQ(linear, refusal([&] { mesh.stress_pa(wrong, box.nodes); }));
    return linear;
  };
  EXPECT_THAT(said(&Material::poisson, 0.5), HasSubstr("poisson of tetrahedron 7 is 0.5"));
  EXPECT_THAT(said(&Material::poisson, kNan), HasSubstr("poisson of tetrahedron 7 is nan"));
  EXPECT_THAT(said(&Material::young_pa, 0), HasSubstr("young_pa of tetrahedron 7 is 0"));
  EXPECT_THAT(said(&Material::density_kg_m3, -5),
              HasSubstr("density_kg_m3 of tetrahedron 7 is -5"));
  EXPECT_THAT(said(&Material::viscosity_pa_s, -1), HasSubstr("viscosity_pa_s of tetrahedron 7"));
  material.viscosity_pa_s.clear();
  EXPECT_THAT(refusal([&] { system(); }), HasSubstr("viscosity_pa_s has 0 values: expected 48"));
  EXPECT_THAT(refusal([] { elastic_tensor(0, 0.4); }), HasSubstr("young_pa = 0"));
  EXPECT_THAT(refusal([] { shear_modulus_pa(1, -1); }), HasSubstr("poisson = -1"));
}

TEST_F(Entry, PrescribedUnknownsOutOfOrder) {
  const SparseMatrix stiffness = system().stiffness;
  const auto said = [&](std::size_t at, int unknown) {
    std::vector<int> wrong = held;
    wrong[at] = unknown;
    return refusal([&] { StaticSolver(stiffness, wrong); });
  };
  EXPECT_THAT(said(1, held[0]), HasSubstr("prescribed unknown 1 is 0 (node 0, axis x), after 0"));
  EXPECT_THAT(said(0, held[5]), HasSubstr("expected rising numbers, each once"));
  EXPECT_THAT(said(held.size() - 1, 99999), HasSubstr("is 99999: expected 0 to 80"));
  EXPECT_THAT(said(0, -3), HasSubstr("is -3: expected 0 to 80"));
}

TEST_F(Entry, StaticSolver) {
  const StaticSolver solver(system().stiffness, held);
  EXPECT_GT(solver.solve(values, force).norm(), 0);
  EXPECT_THAT(refusal([&] { solver.solve(VectorXd::Zero(3), force); }),
              HasSubstr("the prescribed displacement has 3 entries"));
  EXPECT_THAT(refusal([&] { solver.solve(with(values, 4, kNan), force); }),
              HasSubstr("entry 4 (node 3, axis y) is nan"));
  EXPECT_THAT(
      refusal([&] { solver.solve(values, with(force, 40, kNan)); }),
      HasSubstr("the force: entry 40 (node 13, axis y) is nan: expected a finite number (N)"));
  EXPECT_THAT(refusal([&] { solver.solve(values, VectorXd::Ones(5)); }),
              HasSubstr("the force has 5 entries: expected 81"));
  EXPECT_THAT(refusal([&] { StaticSolver(SparseMatrix(6, 9), {}); }), HasSubstr("6 x 9"));
}

TEST_F(Entry, Newmark) {
  for (const double dt : {0.0, -0.1, kNan})
    EXPECT_THAT(refusal([&] { Newmark(system(), held, {.dt_s = dt}); }), HasSubstr("dt_s = "));
  EXPECT_THAT(refusal([&] { Newmark(system(), held, {.beta = 0}); }), HasSubstr("beta = 0"));
  Newmark newmark(system(), held, {});
  EXPECT_THAT(refusal([&] { newmark.step(values, with(force, 40, kNan)); }),
              HasSubstr("entry 40 (node 13, axis y) is nan"));
  EXPECT_THAT(refusal([&] { newmark.step(with(values, 1, kNan)); }), HasSubstr("entry 1 (node 0"));
  EXPECT_THAT(refusal([&] { newmark.step(VectorXd::Zero(2)); }), HasSubstr("has 2 entries"));
  EXPECT_THAT(refusal([&] { newmark.start(force, with(force, 3, kNan), values); }),
              HasSubstr("the velocity: entry 3"));
  EXPECT_TRUE(newmark.displacement().isZero(0)) << "a refused step changes nothing";
  System wrong = system();
  wrong.mass = SparseMatrix(3, 3);
  EXPECT_THAT(refusal([&] { Newmark(wrong, held, {}); }), HasSubstr("81, 81 and 3 columns"));
  System broken = system();
  broken.damping.valuePtr()[17] = kNan;
  EXPECT_THAT(refusal([&] { Newmark(broken, held, {}); }), HasSubstr("System::damping has nan at"));
}

TEST_F(Entry, ReducedModel) {
  ReducedModel model(system(), held);
  Drive drive{Eigen::MatrixXd::Zero(values.size(), 1),
              {},
              Eigen::MatrixXd::Ones(1, 4),
              Eigen::MatrixXd::Zero(1, 4),
              Eigen::MatrixXd::Zero(1, 4)};
  drive.prescribed(3, 0) = kNan;
  EXPECT_THAT(refusal([&] { model.run(drive, {}); }),
              HasSubstr("Drive::prescribed has nan at (3, 0)"));
  EXPECT_THAT(refusal([&] { model.at_rest(drive, {0.0}); }), HasSubstr("Drive::prescribed"));
  drive.prescribed.setZero();
  drive.rate.resize(1, 3);
  EXPECT_THAT(refusal([&] { model.run(drive, {}); }), HasSubstr("Drive::rate is 1 x 3"));
  EXPECT_THAT(refusal([&] { model.at_rest(Eigen::MatrixXd::Zero(5, 1)); }), HasSubstr("5 rows"));
}

class FiniteEntry : public Entry {
 protected:
  Assembler mesh{box.nodes, box.tets, ElementKind::tet4_star};
};

TEST_F(FiniteEntry, NumbersThatAreNone) {
  FiniteStrain form(mesh, material, {});
  FiniteNewton newton(form, held, {});
  newton.start();
  const auto both = [&](const VectorXd& to, const VectorXd& f) {
    const std::string said = refusal([&] { newton.equilibrium(to, f); });
    EXPECT_EQ(said, refusal([&] { newton.step(0.01, to, f); }));
    return said;
  };
  EXPECT_THAT(both(values, with(force, 40, kNan)),
              HasSubstr("the force: entry 40 (node 13, axis y)"));
  EXPECT_THAT(both(with(values, 1, kNan), force), HasSubstr("entry 1 (node 0, axis y) is nan"));
  EXPECT_THAT(both(VectorXd::Zero(2), force), HasSubstr("has 2 entries"));
  for (const double dt : {0.0, kNan, -1.0})
    EXPECT_THAT(refusal([&] { newton.step(dt, values); }), HasSubstr("the step dt_s = "));
  const VectorXd guess = with(force, 2, kNan);
  EXPECT_THAT(refusal([&] { newton.step(0.01, values, {}, {}, &guess); }), HasSubstr("the guess"));
  FiniteNewtonHooks hooks;
  hooks.before_iteration = [](const VectorXd&, double, VectorXd& f) { f[8] = kNan; };
  EXPECT_THAT(refusal([&] { newton.step(0.01, values, force, hooks); }),
              HasSubstr("the force of before_iteration: entry 8 (node 2, axis z) is nan"));
  EXPECT_EQ(newton.equilibrium(values, force).parts, 1);  // as before
}

TEST_F(FiniteEntry, LawsAndOptions) {
  Hyperelastic softening, branch;
  softening.law = HyperelasticLaw::yeoh;
  softening.c20 = -1;
  branch.branches = {{0.5, 0}};
  EXPECT_THAT(refusal([&] { FiniteStrain(mesh, material, softening); }), HasSubstr("c20 = -1"));
  EXPECT_THAT(refusal([&] { FiniteStrain(mesh, material, branch); }),
              HasSubstr("branches[0].relaxation_s = 0"));
  Material printed = material;
  printed.viscous_form = ViscousForm::printed;
  EXPECT_THAT(refusal([&] { FiniteStrain(mesh, printed, {}); }), HasSubstr("expected isotropic"));
  FiniteStrain form(mesh, material, {});
  EXPECT_THAT(refusal([&] { FiniteNewton(form, held, {.tolerance = 0}); }),
              HasSubstr("tolerance = 0"));
  EXPECT_THAT(refusal([&] { FiniteNewton(form, held, {}, {}, {nullptr}); }), HasSubstr("null"));
  EXPECT_THAT(refusal([&] { form.volume_ratio(VectorXd::Zero(3)); }), HasSubstr("3 entries"));
}

TEST(ComplementarityEntry, RowsThatHaveNoAnswer) {
  VectorXd z = VectorXd::Zero(2);
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(2, 2);
  EXPECT_THAT(refusal([&] { solve_complementarity(unit, Eigen::Vector2d(1, kNan), 1e-9, 9, z); }),
              HasSubstr("row 1"));
  EXPECT_THAT(refusal([&] { solve_complementarity(0 * unit, Eigen::Vector2d(1, 1), 1e-9, 9, z); }),
              HasSubstr("the diagonal 0"));
}

TEST_F(Entry, TheElementThatDoesNotLockIsTheDefault) {
  const System star = assemble(box.nodes, box.tets, material, ElementKind::tet4_star);
  EXPECT_EQ(system().stiffness.nonZeros(), star.stiffness.nonZeros());
  EXPECT_EQ((system().stiffness - star.stiffness).norm(), 0);
}

}  // namespace
}  // namespace hyperex::fem
