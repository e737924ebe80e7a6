// SPDX-License-Identifier: GPL-3.0-or-later
// The solver at finite strain: a bar is stretched to half as long again, then let go.
#include <cstdio>

#include "bar.hpp"

using namespace hyperex;

int main() try {
  const Bar bar;
  const fem::Material tissue{.young_pa = bar.all(15e3),
                             .poisson = bar.all(0.49),
                             .viscosity_pa_s = bar.all(20),
                             .density_kg_m3 = bar.all(1000)};
  // Each refers to the one before, which must live as long.
  const fem::Assembler mesh(bar.nodes, bar.tets, fem::ElementKind::tet4_star);
  fem::FiniteStrain form(mesh, tissue, {.law = fem::HyperelasticLaw::yeoh});
  std::vector<int> root, ends;  // unknowns 3 n + axis: nodes at x = 0; these and those at 40 mm
  for (int u = 0; u < 12; ++u) root.push_back(u), ends.push_back(u);
  for (int u = 48; u < 60; ++u) ends.push_back(u);
  Eigen::VectorXd to = Eigen::VectorXd::Zero(24);
  for (int n = 4; n < 8; ++n) to[3 * n] = 0.02;

  fem::FiniteNewton stretched(form, ends, {});
  const fem::FiniteStepReport report = stretched.equilibrium(to);
  const Eigen::VectorXd d = stretched.displacement(), stretch = form.principal_stretches(d).col(2);
  double pull = 0;
  for (int n = 16; n < 20; ++n) pull += stretched.reaction()[3 * n];
  std::printf("pulled by %.3f N, greatest stretch %.2f, estimated error %.0e\n", pull,
              stretch.maxCoeff(), report.error);
  fem::FiniteNewton free(form, root, {});
  free.start(d, Eigen::VectorXd::Zero(d.size()));
  for (int k = 1; k <= 40; ++k) {
    free.step(0.005, Eigen::VectorXd::Zero(12));
    if (k % 8 == 0) std::printf("%.2f s: %6.2f mm\n", free.time_s(), 1e3 * free.displacement()[48]);
  }
} catch (const std::runtime_error& error) {  // InputError and NumericalError name the place
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
