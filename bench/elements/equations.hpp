// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <chrono>

#include "candidates.hpp"

namespace hyperex::study {

template <typename F>
double quickest(int repeats, F f) {
  double best = 1e300;
  for (int i = 0; i < repeats; ++i) {
    const auto start = std::chrono::steady_clock::now();
    f();
    best = std::min(
        best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return best;
}

/// Prescribed unknowns 3 n + axis, by position; further unknowns (pressures) are free.
struct Constraints {
  std::vector<char> fixed;
  Eigen::VectorXd value;
  Constraints(const Points& nodes, const Support& support, Eigen::Index more = 0);
};

/// Consistent loads of the tractions on linear triangles.
Eigen::VectorXd load_linear(const Problem& p);

/// a x = b with constraints; b comes in and the whole x goes out in `x`. Notes times and fill.
void solve_definite(const fem::SparseMatrix& a, const Constraints& constraints, Eigen::VectorXd& x,
                    int repeats, Solution& s);
/// The same for a quasi-definite matrix, by a simplicial LDL^T.
void solve_quasidefinite(const fem::SparseMatrix& a, const Constraints& constraints,
                         Eigen::VectorXd& x, int repeats, Solution& s);

/// Linear displacement and pressure with the pressure's projection as stabilisation (Dohrmann and
/// Bochev 2004).
Solution solve_p1p1(const Problem& p, int repeats);
/// Quadratic displacement (straight edges), one dilatation a tetrahedron.
Solution solve_p2p0(const Problem& p, int repeats);

}  // namespace hyperex::study
