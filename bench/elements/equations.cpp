// SPDX-License-Identifier: GPL-3.0-or-later
#include "equations.hpp"

#include <Eigen/CholmodSupport>

namespace hyperex::study {

Constraints::Constraints(const Points& nodes, const Support& support, Eigen::Index more)
    : fixed(nodes.size() + more, 0), value(Eigen::VectorXd::Zero(nodes.size() + more)) {
  for (Eigen::Index n = 0; n < nodes.rows(); ++n) {
    const auto held = support(nodes.row(n).transpose());
    for (int axis = 0; axis < 3; ++axis)
      if (held[axis]) {
        fixed[3 * n + axis] = 1;
        value[3 * n + axis] = *held[axis];
      }
  }
}

Eigen::VectorXd load_linear(const Problem& p) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(p.nodes.size());
  for (const auto& f : p.loaded) {
    const Vec3 x[3] = {p.nodes.row(f[0]).transpose(), p.nodes.row(f[1]).transpose(),
                       p.nodes.row(f[2]).transpose()};
    const Vec3 area = (x[1] - x[0]).cross(x[2] - x[0]) / 2;
    for (int k = 0; k < 3; ++k) {  // the middle of each edge: exact for quadratics
      const int next = (k + 1) % 3;
      const Vec3 t = p.traction((x[k] + x[next]) / 2, area.normalized()) * area.norm() / 3;
      load.segment<3>(3 * f[k]) += t / 2;
      load.segment<3>(3 * f[next]) += t / 2;
    }
  }
  return load;
}

namespace {

template <typename Solver>
void solve_with(const fem::SparseMatrix& a, const Constraints& constraints, Eigen::VectorXd& x,
                int repeats, Solution& s) {
  const int n = static_cast<int>(a.cols());
  std::vector<int> place(n, -1), free;
  for (int i = 0; i < n; ++i)
    if (!constraints.fixed[i]) {
      place[i] = static_cast<int>(free.size());
      free.push_back(i);
    }
  const Eigen::VectorXd b = x - a * constraints.value;
  fem::SparseMatrix part(free.size(), free.size());
  part.reserve(a.nonZeros() / 2 + n);
  for (std::size_t c = 0; c < free.size(); ++c) {
    part.startVec(c);
    for (fem::SparseMatrix::InnerIterator it(a, free[c]); it; ++it)
      if (it.row() >= free[c] && place[it.row()] >= 0)
        part.insertBack(place[it.row()], c) = it.value();
  }
  part.finalize();
  Solver solver;
  solver.cholmod().nmethods = 1;
  solver.cholmod().method[0].ordering = CHOLMOD_METIS;
  solver.cholmod().postorder = 1;
  solver.cholmod().print = 0;
  s.unknowns = static_cast<int>(free.size());
  s.analyse_s = quickest(1, [&] { solver.analyzePattern(part); });
  s.factor_entries = solver.cholmod().lnz;
  s.factor_s = quickest(repeats, [&] { solver.factorize(part); });
  s.solved = solver.info() == Eigen::Success;
  Eigen::VectorXd rhs(part.cols()), solved;
  for (int i = 0; i < n; ++i)
    if (place[i] >= 0) rhs[place[i]] = b[i];
  solved = rhs;
  if (s.solved) s.solve_s = quickest(repeats + 1, [&] { solved = solver.solve(rhs); });
  x = constraints.value;
  for (int i = 0; i < n; ++i)
    if (place[i] >= 0) x[i] = solved[place[i]];
}

}  // namespace

void solve_definite(const fem::SparseMatrix& a, const Constraints& constraints, Eigen::VectorXd& x,
                    int repeats, Solution& s) {
  solve_with<Eigen::CholmodSupernodalLLT<fem::SparseMatrix, Eigen::Lower>>(a, constraints, x,
                                                                           repeats, s);
}

void solve_quasidefinite(const fem::SparseMatrix& a, const Constraints& constraints,
                         Eigen::VectorXd& x, int repeats, Solution& s) {
  solve_with<Eigen::CholmodSimplicialLDLT<fem::SparseMatrix, Eigen::Lower>>(a, constraints, x,
                                                                            repeats, s);
}

}  // namespace hyperex::study
