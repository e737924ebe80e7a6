// SPDX-License-Identifier: GPL-3.0-or-later
#include "infsup.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <cmath>

namespace hyperex::study {

InfSup inf_sup(const Candidate& candidate, const Problem& cube) {
  const auto nodes = static_cast<int>(cube.nodes.rows());
  fem::DilatationGroups groups = groups_of(candidate, nodes, cube.tets);
  if (groups.tets.size() == 0)
    for (int t = 0; t < cube.tets.rows(); ++t) groups.tets.append(std::array{t});
  const fem::Lists groups_of_tet = fem::transposed(groups.tets, static_cast<int>(cube.tets.rows()));

  std::vector<int> place(nodes, -1);
  int inner = 0;
  for (int n = 0; n < nodes; ++n)
    if (!cube.support(cube.nodes.row(n).transpose())[0]) place[n] = inner++;

  std::vector<Eigen::Triplet<double>> laplace, divergence;
  Eigen::VectorXd volume = Eigen::VectorXd::Zero(groups.tets.size());
  for (int t = 0; t < cube.tets.rows(); ++t) {
    const fem::Tet4 tet = fem::make_tet4(fem::corners_of(cube.nodes, cube.tets, t));
    const double share = tet.volume / static_cast<double>(groups_of_tet[t].size());
    for (const int g : groups_of_tet[t]) volume[g] += share;
    for (int a = 0; a < 4; ++a) {
      const int na = place[cube.tets(t, a)];
      if (na < 0) continue;
      for (int b = 0; b < 4; ++b)
        if (const int nb = place[cube.tets(t, b)]; nb >= 0)
          laplace.emplace_back(na, nb, tet.volume * tet.gradient.row(a).dot(tet.gradient.row(b)));
      for (const int g : groups_of_tet[t])
        for (int axis = 0; axis < 3; ++axis)
          divergence.emplace_back(3 * na + axis, g, share * tet.gradient(a, axis));
    }
  }
  fem::SparseMatrix k(inner, inner), b(3 * inner, groups.tets.size());
  k.setFromTriplets(laplace.begin(), laplace.end());
  b.setFromTriplets(divergence.begin(), divergence.end());
  const Eigen::SimplicialLDLT<fem::SparseMatrix> factor(k);
  Eigen::MatrixXd solved(b);
  for (Eigen::Index g = 0; g < solved.cols(); ++g) {
    Eigen::Map<Points> field(solved.col(g).data(), inner, 3);
    field = Points(factor.solve(Eigen::MatrixXd(field)));
  }
  const Eigen::VectorXd root = volume.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd schur =
      root.asDiagonal() * Eigen::MatrixXd(b.transpose() * solved) * root.asDiagonal();
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(schur, Eigen::EigenvaluesOnly).eigenvalues();
  int zeros = 0;
  while (zeros < values.size() && values[zeros] < 1e-9) ++zeros;
  return {groups.tets.size(), zeros - 1,
          std::sqrt(values[std::min<Eigen::Index>(zeros, values.size() - 1)])};
}

}  // namespace hyperex::study
