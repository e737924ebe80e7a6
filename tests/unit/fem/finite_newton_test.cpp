// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/time/finite_newton.hpp"

#include <gtest/gtest.h>

#include "hyperex/core/error.hpp"
#include "hyperex/fem/form/inverted.hpp"
#include "hyperex/fem/solve/partition.hpp"
#include "hyperex/fem/solve/static_solve.hpp"
#include "hyperex/fem/time/finite_newton_impl.hpp"
#include "support/fem_support.hpp"
#include "support/laws.hpp"
#include "support/refusal.hpp"

namespace hyperex::fem {
namespace {

using Eigen::VectorXd;

const Vec3 kSize{0.04, 0.03, 0.02};

/// A block held at x = 0, its far end prescribed or free.
struct Block {
  test::BoxMesh box;
  Material material;
  Assembler assembler;
  std::vector<int> held, ends;

  explicit Block(double nu = 0.45, double eta = 0, double young = 2e4,
                 ElementKind kind = ElementKind::tet4_star, std::array<int, 3> cells = {4, 3, 2})
      : box(test::box_mesh(cells, kSize, 0.1)),
        material(test::uniform_material(box.tets.rows(), young, nu, eta, 1000)),
        assembler(box.nodes, box.tets, kind) {
    held = test::unknowns_where(box.nodes, [](const Vec3& p) { return p.x() < 1e-9; });
    ends = test::unknowns_where(
        box.nodes, [](const Vec3& p) { return p.x() < 1e-9 || p.x() > kSize.x() - 1e-9; });
  }
  System system() const {
    System s;
    assembler.assemble(material, s);
    return s;
  }
  VectorXd zeros() const { return VectorXd::Zero(box.nodes.size()); }
  /// Displacements of `ends`: the far end moved by `by`.
  VectorXd moved(const Vec3& by) const {
    VectorXd d(static_cast<Eigen::Index>(ends.size()));
    for (std::size_t i = 0; i < ends.size(); ++i)
      d[i] = box.nodes(ends[i] / 3, 0) > 1e-9 ? by[ends[i] % 3] : 0;
    return d;
  }
  /// A dead force on the nodes of the far end.
  VectorXd pull(const Vec3& newton) const {
    VectorXd f = zeros();
    int count = 0;
    for (Eigen::Index n = 0; n < box.nodes.rows(); ++n) count += box.nodes(n, 0) > kSize.x() - 1e-9;
    for (Eigen::Index n = 0; n < box.nodes.rows(); ++n)
      if (box.nodes(n, 0) > kSize.x() - 1e-9) f.segment<3>(3 * n) = newton / count;
    return f;
  }
  VectorXd at_rest() const { return VectorXd::Zero(static_cast<Eigen::Index>(held.size())); }
};

FiniteNewtonOptions exact() {
  FiniteNewtonOptions options;
  options.tolerance = 1e-9;
  return options;
}

TEST(FiniteNewton, TheLinearLawTakesOneIterationAndIsTheStaticSolution) {
  const Block block(0.49);
  Hyperelastic law;
  law.law = HyperelasticLaw::linear;
  FiniteStrain form(block.assembler, block.material, law);
  FiniteNewton newton(form, block.ends, {});
  const VectorXd to = block.moved({3e-3, 2e-3, 0}), force = 0.01 * block.pull({0, 0, 1});
  const FiniteStepReport report = newton.equilibrium(to, force);
  EXPECT_EQ(report.parts, 1);
  EXPECT_EQ(report.iterations, 1);
  EXPECT_EQ(report.factorisations, 1);
  const VectorXd d = StaticSolver(block.system().stiffness, block.ends).solve(to, force);
  EXPECT_LT((newton.displacement() - d).norm(), 1e-10 * d.norm());
  // In time, too, with viscosity and branches.
  Material viscous = block.material;
  viscous.viscosity_pa_s.assign(viscous.viscosity_pa_s.size(), 200);
  law.branches = {{0.5, 0.03}};
  FiniteStrain moving(block.assembler, viscous, law);
  FiniteNewton in_time(moving, block.ends, {});
  for (int i = 1; i <= 5; ++i) EXPECT_EQ(in_time.step(0.01, i * to / 5, force).iterations, 1) << i;
}

TEST(FiniteNewton, AFactorServesManyStepsAndTheAnswerIsThatOfFullNewton) {
  const Block block(0.49, 50);
  FiniteNewtonOptions old_factors, full = exact();
  old_factors.tolerance = 1e-4;
  full.full_newton = true;
  FiniteStrain form(block.assembler, block.material, {}),
      other(block.assembler, block.material, {});
  FiniteNewton newton(form, block.ends, old_factors), reference(other, block.ends, full);
  constexpr int kSteps = 40;
  int factorisations = 0;
  for (int i = 1; i <= kSteps; ++i) {  // stretched by a third, sheared, and half of the way back
    const double way = i <= 30 ? i / 30.0 : 1 - (i - 30) / 20.0;
    const VectorXd to = block.moved(way * Vec3(0.012, 0.008, 0));
    factorisations += newton.step(0.01, to).factorisations;
    reference.step(0.01, to);
    EXPECT_LT((newton.displacement() - reference.displacement()).lpNorm<Eigen::Infinity>(), 5e-6)
        << i;
  }
  EXPECT_LT(factorisations, kSteps / 2);
}

TEST(FiniteNewton, ForcesGrowFromThoseItStartedUnder) {
  const Block block(0.45);
  FiniteStrain form(block.assembler, block.material, {});
  FiniteNewton newton(form, block.ends, {});
  const VectorXd force = block.pull({0, 0, 0.1});
  FiniteNewtonHooks hooks;
  hooks.before_iteration = [&](const VectorXd&, double, VectorXd& now) {
    EXPECT_LT((now - force).norm(), 1e-12 * force.norm());
  };
  newton.start(block.zeros(), block.zeros(), force);
  // Crushed to a sixth at once: elements would turn inside out, and so it is done in parts.
  const FiniteStepReport report = newton.equilibrium(block.moved({-0.033, 0, 0}), force, hooks);
  EXPECT_GT(report.parts, 1);
}

TEST(FiniteNewton, TinyLoadsGiveTheLinearAnswer) {
  for (const Hyperelastic& law : test::finite_laws()) {
    const Block block(0.49);
    FiniteStrain form(block.assembler, block.material, law);
    FiniteNewtonOptions options = exact();
    options.least_motion_m = 1e-12;
    FiniteNewton newton(form, block.ends, options);
    const VectorXd to = block.moved({3e-9, 2e-9, 1e-9});
    newton.equilibrium(to);
    const VectorXd d = StaticSolver(block.system().stiffness, block.ends).solve(to);
    EXPECT_LT((newton.displacement() - d).norm(), 1e-6 * d.norm()) << to_string(law.law);
  }
}

TEST(FiniteNewton, LeavesNoForceOnFreeUnknownsAndReactsWithWhatPulls) {
  for (const Hyperelastic& law : test::all_laws()) {
    const Block block(0.49);
    FiniteStrain form(block.assembler, block.material, law);
    FiniteNewton newton(form, block.held, exact());
    const Vec3 pull(0.5, 0.2, -0.1);
    newton.equilibrium(block.at_rest(), block.pull(pull));
    Vec3 held = Vec3::Zero(), free = Vec3::Zero();
    for (Eigen::Index n = 0; n < block.box.nodes.rows(); ++n)
      (block.box.nodes(n, 0) < 1e-9 ? held : free) += newton.reaction().segment<3>(3 * n);
    EXPECT_LT((held + pull).norm(), 1e-7 * pull.norm()) << to_string(law.law);
    EXPECT_LT(free.norm(), 1e-7 * pull.norm());
  }
}

/// Full and modified Newton find the same solution from every start.
TEST(FiniteNewton, TheAnswerDoesNotDependOnTheWay) {
  const Block block(0.495, 200);
  std::vector<VectorXd> ends;
  for (const bool full : {false, true}) {
    FiniteStrain form(block.assembler, block.material, {});
    FiniteNewtonOptions options = exact();
    options.full_newton = full;
    FiniteNewton newton(form, block.ends, options);
    for (int i = 1; i <= 4; ++i) {
      const VectorXd to = block.moved({2e-3 * i, -3e-3 * i, 0});
      const FiniteStepReport report = newton.step(0.02, to);
      EXPECT_EQ(report.parts, 1);
      if (full) {
        EXPECT_EQ(report.factorisations - report.projections, report.iterations);
      }
    }
    ends.push_back(newton.displacement());
  }
  FiniteStrain form(block.assembler, block.material, {});
  FiniteNewton newton(form, block.ends, exact());
  for (int i = 1; i <= 4; ++i) {
    const VectorXd guess = ends[0] * i / 4;
    newton.step(0.02, block.moved({2e-3 * i, -3e-3 * i, 0}), {}, {}, &guess);
  }
  ends.push_back(newton.displacement());
  EXPECT_LT((ends[0] - ends[1]).norm(), 1e-7 * ends[0].norm());
  EXPECT_LT((ends[0] - ends[2]).norm(), 1e-7 * ends[0].norm());
}

TEST(FiniteNewton, TheEstimatedErrorIsTheTrueOneOrMore) {
  const Block block(0.495, 200);
  VectorXd truth;
  for (const double tolerance : {1e-10, 1e-2, 1e-3, 1e-4}) {
    FiniteStrain form(block.assembler, block.material, {});
    FiniteNewtonOptions options;
    options.tolerance = tolerance;
    FiniteNewton newton(form, block.ends, options);
    for (int i = 1; i <= 4; ++i) newton.step(0.02, block.moved({2e-3 * i, -3e-3 * i, 0}));
    if (truth.size() == 0)
      truth = newton.displacement();
    else
      EXPECT_LT((newton.displacement() - truth).cwiseAbs().maxCoeff(),
                2 * tolerance * truth.cwiseAbs().maxCoeff());
  }
}

// A step of 1e-7 s leaves a velocity with which the next step starts about 1e5 edge lengths away.
// At that start, the force for 2e-5 of an edge is less than 1e-9 of the whole force, so that a
// tolerance relative to it would accept too large a remainder.
TEST(FiniteNewton, AStartFarOffDoesNotExcuseWhatIsLeft) {
  test::BoxMesh box = test::box_mesh({2, 2, 2}, {2, 2, 2}, 0);
  constexpr int kInner = 13;
  ASSERT_LT((box.nodes.row(kInner) - Eigen::RowVector3d(1, 1, 1)).norm(), 1e-12);
  box.nodes.row(kInner) += Eigen::RowVector3d(0.1, -0.08, 0.05);
  std::vector<int> outer;
  VectorXd sheared = VectorXd::Zero(box.nodes.size()), to;
  for (int n = 0; n < box.nodes.rows(); ++n) {
    sheared[3 * n] = 0.5 * box.nodes(n, 1);
    for (int axis = 0; axis < 3 && n != kInner; ++axis) outer.push_back(3 * n + axis);
  }
  to = sheared(outer);
  const Assembler mesh(box.nodes, box.tets, ElementKind::tet4);
  Hyperelastic law;
  law.branches = {{0.5, 0.1}, {1.2, 1.0}};
  for (const double first_s : {1e-7, 1e-3}) {
    for (const bool full : {false, true}) {
      for (const double tolerance : {1e-3, 1e-6, 1e-10}) {
        FiniteStrain form(mesh, test::uniform_material(box.tets.rows(), 1e5, 0.49, 0, 1000), law);
        FiniteNewtonOptions options;
        options.tolerance = tolerance;
        options.inertia = false;
        options.full_newton = full;
        FiniteNewton newton(form, outer, options);
        newton.start();
        double worst = newton.step(first_s, to).error;
        for (int hold = 0; hold < 3; ++hold) {
          const FiniteStepReport report = newton.step(0.05, to);
          const double off = (newton.displacement() - sheared).segment<3>(3 * kInner).norm() /
                             greatest_motion(sheared);
          worst = std::max(worst, report.error);  // branches remember what was missing before
          EXPECT_LE(off, std::max(2 * worst, 1e-10))
              << first_s << " s, full " << full << ", tolerance " << tolerance << ", " << hold;
          EXPECT_LE(report.error, std::max(tolerance, 1e-7));
        }
      }
    }
  }
}

TEST(FiniteNewton, IsOfOrderTwoInTheStep) {
  const Block block(0.4, 20, 2e4, ElementKind::tet4_star, {3, 2, 2});
  const VectorXd force = block.pull({0.15, 0.3, 0.1});
  Hyperelastic law;
  law.branches = {{0.5, 0.05}};
  const auto run = [&](int steps) {
    FiniteStrain form(block.assembler, block.material, law);
    FiniteNewton newton(form, block.held, exact());
    const double h = 0.16 / steps;
    for (int i = 1; i <= steps; ++i)  // a load that comes, goes and comes again smoothly
      newton.step(h, block.at_rest(), std::pow(std::sin(1.5 * M_PI * i / steps), 2) * force);
    return newton.displacement();
  };
  const VectorXd d1 = run(40), d2 = run(80), d3 = run(160);
  EXPECT_GT(d3.cwiseAbs().maxCoeff(), 1e-3) << "it swings";
  EXPECT_NEAR(std::log2((d1 - d2).norm() / (d2 - d3).norm()), 2, 0.2);
}

TEST(FiniteNewton, IsOfOrderTwoOnUnequalStepsToo) {
  const Block block(0.4, 20, 2e4, ElementKind::tet4_star, {3, 2, 2});
  const VectorXd force = block.pull({0.15, 0.3, 0.1});
  const auto run = [&](int halvings) {
    FiniteStrain form(block.assembler, block.material, {});
    FiniteNewton newton(form, block.held, exact());
    for (int i = 0; i < 12; ++i)  // lengths in turn 0.75, 1.25 of the mean
      for (int k = 0; k < (1 << halvings); ++k) {
        const double h = (i % 2 ? 0.015 : 0.009) / (1 << halvings);
        const double t = newton.time_s() + h;
        newton.step(h, block.at_rest(), std::pow(std::sin(1.5 * M_PI * t / 0.144), 2) * force);
      }
    EXPECT_NEAR(newton.time_s(), 0.144, 1e-12);
    return newton.displacement();
  };
  const VectorXd d1 = run(2), d2 = run(3), d3 = run(4);
  EXPECT_NEAR(std::log2((d1 - d2).norm() / (d2 - d3).norm()), 2, 0.3);
}

/// The work of the forces goes into kinetic energy, strain energy and dissipation. The remainder is
/// the method's own dissipation, which vanishes with the square of the step.
TEST(FiniteNewton, BalancesItsEnergy) {
  const Block block(0.4, 0, 2e4, ElementKind::tet4_star, {3, 2, 2});
  const VectorXd force = block.pull({0.15, 0.3, 0.1});
  const auto gap = [&](int steps) {
    FiniteStrain form(block.assembler, block.material, {});
    FiniteNewton newton(form, block.held, exact());
    const double h = 0.12 / steps;
    double work = 0;
    VectorXd before = block.zeros(), f_before = before, mv(before.size());
    for (int i = 1; i <= steps; ++i) {
      const VectorXd f = std::pow(std::sin(M_PI * i / steps / 2), 2) * force;
      newton.step(h, block.at_rest(), f);
      work += (f + f_before).dot(newton.displacement() - before) / 2;
      before = newton.displacement();
      f_before = f;
    }
    form.mass_product(newton.velocity(), mv);
    const double stored = form.elastic_energy(newton.displacement());
    const double kinetic = newton.velocity().dot(mv) / 2;
    EXPECT_GT(kinetic + stored, 1e-5);
    return std::abs(work - stored - kinetic) / (stored + kinetic);
  };
  const double coarse = gap(60), fine = gap(120), finest = gap(240);
  EXPECT_LT(finest, 2e-3);
  EXPECT_GT(coarse / fine, 3);
  EXPECT_GT(fine / finest, 3);
}

TEST(FiniteNewton, AThrownBlockKeepsItsVelocityAndSpinWithoutForce) {
  const Block block(0.45, 300);
  FiniteStrain form(block.assembler, block.material, {});
  FiniteNewton newton(form, {}, exact());
  VectorXd v(block.box.nodes.size());
  const Vec3 spin(0, 0, 8), along(0.3, 0, 0.1);  // rad/s, m/s
  for (Eigen::Index n = 0; n < block.box.nodes.rows(); ++n)
    v.segment<3>(3 * n) = along + spin.cross(Vec3(block.box.nodes.row(n).transpose()) - kSize / 2);
  newton.start(block.zeros(), v);
  VectorXd momentum(v.size());
  for (int i = 0; i < 40; ++i) newton.step(2.5e-3, VectorXd());
  form.mass_product(newton.velocity(), momentum);
  Vec3 sum = Vec3::Zero(), turning = Vec3::Zero(), turning_before = Vec3::Zero();
  VectorXd start(v.size());
  form.mass_product(v, start);
  for (Eigen::Index n = 0; n < block.box.nodes.rows(); ++n) {
    const Vec3 x = block.box.nodes.row(n).transpose();
    sum += momentum.segment<3>(3 * n);
    turning_before += (x - kSize / 2).cross(Vec3(start.segment<3>(3 * n)));
    turning += (x + newton.displacement().segment<3>(3 * n) - kSize / 2 - 0.1 * along)
                   .cross(Vec3(momentum.segment<3>(3 * n)));
  }
  // Each of the 40 steps is solved to 1e-9.
  EXPECT_LT((sum - 1000 * kSize.prod() * along).norm(), 4e-8 * sum.norm());
  EXPECT_NEAR(turning.z() / turning_before.z(), 1, 5e-3);
  // Turned by 0.8 rad: no strain but that of the centrifugal force.
  EXPECT_LT((form.principal_stretches(newton.displacement()).array() - 1).abs().maxCoeff(), 0.01);
  EXPECT_GT(newton.displacement().cwiseAbs().maxCoeff(), 0.02);
}

TEST(FiniteNewton, NothingIsTurnedInsideOutWhereTheLinearAnswerIs) {
  // A patch of the top is pushed deeper than a cell, and aside; the bottom is held.
  const Block block(0.495, 0, 2e4, ElementKind::tet4_star, {6, 5, 4});
  const auto bottom = [](const Vec3& p) { return p.z() < 1e-9; };
  const auto driven = test::unknowns_where(block.box.nodes, [&](const Vec3& p) {
    return bottom(p) || (p.z() > kSize.z() - 1e-9 && (p - kSize / 2).head<2>().norm() < 0.011);
  });
  VectorXd to(static_cast<Eigen::Index>(driven.size()));
  for (std::size_t i = 0; i < driven.size(); ++i)
    to[i] = block.box.nodes(driven[i] / 3, 2) < 1e-9 ? 0 : Vec3(10e-3, 0, -9e-3)[driven[i] % 3];
  const VectorXd d = StaticSolver(block.system().stiffness, driven).solve(to);
  const auto inverted = [&](const VectorXd& at) {
    const auto flags = inverted_tets(block.box.nodes, block.box.tets, test::unflat(at));
    return std::count(flags.begin(), flags.end(), 1);
  };
  ASSERT_GT(inverted(d), 0);
  for (const Hyperelastic& law : test::finite_laws()) {
    FiniteStrain form(block.assembler, block.material, law);
    FiniteNewton newton(form, driven, {});
    newton.equilibrium(to);
    EXPECT_EQ(inverted(newton.displacement()), 0) << to_string(law.law);
    EXPECT_GT(form.volume_ratio(newton.displacement()).minCoeff(), 0.02);
  }
}

TEST(FiniteNewton, HalvesAStepThatIsTooLongAndGoesOn) {
  const Block block(0.495, 50, 2e4, ElementKind::tet4_star, {6, 4, 3});
  FiniteStrain form(block.assembler, block.material, {});
  FiniteNewtonOptions options;
  options.most_iterations = 3;
  options.full_newton = true;
  options.tolerance = 1e-4;
  FiniteNewton newton(form, block.ends, options);
  const VectorXd to = block.moved({-8e-3, 5e-3, 2e-3});
  std::vector<double> times;
  FiniteNewtonHooks hooks;
  hooks.after_part = [&](double t) { times.push_back(t); };
  const FiniteStepReport report = newton.step(0.03, to, {}, hooks);
  EXPECT_GT(report.parts, 1);
  EXPECT_LE(report.error, options.tolerance);
  ASSERT_EQ(static_cast<int>(times.size()), report.parts);
  EXPECT_NEAR(times.back(), 0.03, 1e-12);
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  EXPECT_LT((newton.displacement()(block.ends) - to).norm(), 1e-15);
  EXPECT_NEAR(newton.time_s(), 0.03, 1e-12);
}

TEST(FiniteNewton, NamesTimeAndPlaceWhereItFailsAndKeepsTheLastState) {
  const Block block(0.495, 50);
  FiniteStrain form(block.assembler, block.material, {});
  FiniteNewtonOptions options;
  options.most_iterations = 2;
  options.most_halvings = 1;
  options.tolerance = 1e-12;
  FiniteNewton newton(form, block.ends, options);
  newton.step(0.01, block.moved(Vec3::Zero()));
  const VectorXd before = newton.displacement();
  const std::string text = test::refusal<NumericalError>([&] {
    newton.step(0.01, block.moved({-0.02, 0.01, 0}));
  });
  EXPECT_NE(text.find("t = 0.015 s"), std::string::npos) << text;
  EXPECT_NE(text.find("node "), std::string::npos) << text;
  EXPECT_NE(text.find("tetrahedron "), std::string::npos) << text;
  EXPECT_EQ(newton.displacement(), before);
  EXPECT_EQ(newton.time_s(), 0.01);
}

TEST(FiniteNewton, RefusesABodyThatNothingHolds) {
  const Block block;
  FiniteStrain form(block.assembler, block.material, {});
  FiniteNewtonOptions options;
  options.inertia = false;
  EXPECT_THROW(FiniteNewton(form, {}, options), NumericalError);
  EXPECT_NO_THROW(FiniteNewton(form, {}, {})) << "inertia holds it";
}

/// The nodes of one end alternate from step to step, with strains of a third; the nodes between
/// must not move away.
TEST(FiniteNewton, ViolentAlternationDoesNotGrow) {
  const Block block(0.45, 400, 1.5e5);
  FiniteStrain form(block.assembler, block.material, {});
  FiniteNewton newton(form, block.held, {});
  const VectorXd up = 1.2e-3 * test::random_vector(static_cast<Eigen::Index>(block.held.size()), 1);
  for (int i = 0; i < 40; ++i) {
    newton.step(0.01, i % 2 ? up : -up);
    ASSERT_LT(newton.displacement().cwiseAbs().maxCoeff(), 1.5e-3) << i;
  }
}

/// A plane that pushes back nodes that go below it: z < height.
class Floor : public NodalPotential {
 public:
  Floor(const Points& nodes, double height_m, double stiffness)
      : nodes_(nodes), height_(height_m), stiffness_(stiffness) {}
  double add_gradient(const VectorXd& d, VectorXd& gradient) const override {
    double energy = 0;
    for (Eigen::Index n = 0; n < nodes_.rows(); ++n) {
      const double depth = std::max(0.0, height_ - nodes_(n, 2) - d[3 * n + 2]);
      gradient[3 * n + 2] -= stiffness_ * depth;
      energy += stiffness_ / 2 * depth * depth;
    }
    return energy;
  }
  void add_tangent(const VectorXd& d, TangentBlocks& blocks) const override {
    Eigen::Matrix3d block = Eigen::Matrix3d::Zero();
    block(2, 2) = stiffness_;
    for (Eigen::Index n = 0; n < nodes_.rows(); ++n)
      if (nodes_(n, 2) + d[3 * n + 2] < height_) blocks.add(static_cast<int>(n), block);
  }

 private:
  const Points& nodes_;
  double height_, stiffness_;
};

TEST(FiniteNewton, APotentialOfNodesPushesBack) {
  const Block block(0.45);
  FiniteStrain form(block.assembler, block.material, {});
  const Floor floor(block.box.nodes, -1e-3, 1e4);
  const VectorXd force = block.pull({0, 0, -0.4});
  const auto lowest = [&](const VectorXd& d) {
    double z = 1;
    for (Eigen::Index n = 0; n < block.box.nodes.rows(); ++n)
      z = std::min(z, block.box.nodes(n, 2) + d[3 * n + 2]);
    return z;
  };
  FiniteNewton free(form, block.held, exact());
  free.equilibrium(block.at_rest(), force);
  ASSERT_LT(lowest(free.displacement()), -3e-3);
  FiniteNewton newton(form, block.held, exact(), {}, {&floor});
  newton.equilibrium(block.at_rest(), force);
  EXPECT_GT(lowest(newton.displacement()), -1e-3 - 1e-4);
  EXPECT_LT(lowest(newton.displacement()), -1e-3);
  EXPECT_LT(newton.reaction()(test::complement(block.box.nodes.size(), block.held)).norm(), 1e-7);
}

/// Compared with a linear system that has the same entries in its stiffness.
TEST(FiniteNewton, SpringsToTheGround) {
  const Block block(0.45);
  Hyperelastic law;
  law.law = HyperelasticLaw::linear;
  System system = block.system();
  SparseMatrix springs(block.box.nodes.size(), block.box.nodes.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (int n = 0; n < block.box.nodes.rows(); n += 3)
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) entries.emplace_back(3 * n + i, 3 * n + k, i == k ? 40 : 10);
  springs.setFromTriplets(entries.begin(), entries.end());
  system.stiffness += springs;
  FiniteStrain form(block.assembler, block.material, law);
  FiniteNewton newton(form, block.held, {}, springs);
  const VectorXd force = block.pull({0.1, 0.2, 0.3});
  EXPECT_EQ(newton.equilibrium(block.at_rest(), force).iterations, 1);
  const VectorXd d =
      StaticSolver(system.stiffness, block.held).solve(VectorXd(block.at_rest()), force);
  EXPECT_LT((newton.displacement() - d).norm(), 1e-10 * d.norm());
}

/// A follower force: always normal to the present line from the base to the tip, so that it turns
/// with the body.
TEST(FiniteNewton, HooksMayTurnForcesWithTheBody) {
  const Block block(0.45);
  FiniteStrain form(block.assembler, block.material, {});
  FiniteNewton newton(form, block.held, exact());
  const int tip = block.box.node(block.box.cells[0], 1, 1);
  const double newton_force = 0.15;
  const auto direction = [&](const VectorXd& d) -> Vec3 {  // normal to the line from base to tip
    const Vec3 line = Vec3(block.box.nodes.row(tip).transpose()) + d.segment<3>(3 * tip) -
                      Vec3(0, kSize.y() / 2, kSize.z() / 2);
    return line.cross(Vec3::UnitY()).normalized();
  };
  int calls = 0;
  FiniteNewtonHooks hooks;
  hooks.before_iteration = [&](const VectorXd& d, double, VectorXd& force) {
    force.setZero();
    force.segment<3>(3 * tip) = newton_force * direction(d);
    ++calls;
  };
  const FiniteStepReport report = newton.equilibrium(block.at_rest(), {}, hooks);
  EXPECT_EQ(calls, report.iterations + report.parts);
  EXPECT_GT(newton.displacement().segment<3>(3 * tip).norm(), 5e-3);
  Vec3 held = Vec3::Zero();
  for (Eigen::Index n = 0; n < block.box.nodes.rows(); ++n)
    if (block.box.nodes(n, 0) < 1e-9) held += newton.reaction().segment<3>(3 * n);
  EXPECT_LT((held + newton_force * direction(newton.displacement())).norm(), 1e-6 * newton_force);
}

TEST(FiniteNewton, SolveIsTheFirstOrderAnswerToAForce) {
  const Block block(0.45);
  FiniteStrain form(block.assembler, block.material, {});
  FiniteNewtonOptions options = exact();
  options.full_newton = true;
  FiniteNewton newton(form, block.held, options);
  const VectorXd force = block.pull({0.3, 0.1, 0}), more = 1e-6 * block.pull({0, 0, 1});
  newton.equilibrium(block.at_rest(), force);
  VectorXd x = more;
  const VectorXd before = newton.displacement();
  newton.solve(x);
  newton.equilibrium(block.at_rest(), force + more);
  const VectorXd change = newton.displacement() - before;
  EXPECT_LT((x - change).norm(), 1e-2 * change.norm());
}

}  // namespace
}  // namespace hyperex::fem
