// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/muscles/bounded_least_squares.hpp"

#include <limits>
#include <vector>

namespace hyperex::muscles {

void bounded_least_squares(const Eigen::MatrixXd& h, const Eigen::VectorXd& g,
                           const Eigen::VectorXd& lower, Eigen::VectorXd& x) {
  const Eigen::Index n = g.size();
  constexpr int kBlockSteps = 10;  // block steps without progress, before Murty's rule is used
  std::vector<char> bound(n);
  for (Eigen::Index i = 0; i < n; ++i) bound[i] = x[i] <= lower[i];
  int patience = kBlockSteps;
  auto fewest = std::numeric_limits<std::size_t>::max();
  for (int step = 0; step < 100 + 20 * n; ++step) {
    std::vector<Eigen::Index> free, held;
    for (Eigen::Index i = 0; i < n; ++i) (bound[i] ? held : free).push_back(i);
    const Eigen::VectorXd at = lower(held);
    x(held) = at;
    if (!free.empty()) {
      Eigen::VectorXd right = g(free);
      if (!held.empty()) right -= h(free, held) * at;
      const Eigen::VectorXd answer = h(free, free).eval().llt().solve(right);
      x(free) = answer;
    }
    const Eigen::VectorXd slope = h * x - g;
    const double small = 1e-10 * g.cwiseAbs().maxCoeff();
    std::vector<Eigen::Index> wrong;
    for (Eigen::Index i = 0; i < n; ++i)
      if (bound[i] ? slope[i] < -small : x[i] < lower[i]) wrong.push_back(i);
    if (wrong.empty()) return;
    if (wrong.size() < fewest) {
      fewest = wrong.size();
      patience = kBlockSteps;
    } else {
      --patience;
    }
    if (patience < 0) wrong = {wrong.back()};
    for (const Eigen::Index i : wrong) bound[i] = !bound[i];
  }
}

}  // namespace hyperex::muscles
