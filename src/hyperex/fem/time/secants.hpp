// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>

namespace hyperex::fem {

/// L-BFGS updates of an old factor (Nocedal, Math. Comp. 35, 1980). Stores the last kPairs pairs;
/// a pair is a correction s and the change y of the gradient along it.
class Secants {
 public:
  explicit Secants(Eigen::Index unknowns) {
    for (Pair& p : pair_) p.s = p.y = Eigen::VectorXd::Zero(unknowns);
  }
  void clear() { count_ = 0; }
  void add(const Eigen::VectorXd& s, const Eigen::VectorXd& y) {
    const double sy = s.dot(y);
    if (!(sy > 1e-10 * s.norm() * y.norm())) return;
    Pair& p = pair_[count_ % kPairs];
    p.s = s;
    p.y = y;
    p.rho = 1 / sy;
    ++count_;
  }
  /// q := H q. `solve` applies the initial H without any pairs: the old factor.
  template <typename Solve>
  void apply(Eigen::VectorXd& q, Solve solve) {
    const int first = std::max(0, count_ - kPairs);
    for (int i = count_ - 1; i >= first; --i) {
      Pair& p = pair_[i % kPairs];
      p.alpha = p.rho * p.s.dot(q);
      q -= p.alpha * p.y;
    }
    solve(q);
    for (int i = first; i < count_; ++i) {
      const Pair& p = pair_[i % kPairs];
      q += (p.alpha - p.rho * p.y.dot(q)) * p.s;
    }
  }

 private:
  static constexpr int kPairs = 5;
  struct Pair {
    Eigen::VectorXd s, y;
    double rho = 0, alpha = 0;
  };
  std::array<Pair, kPairs> pair_;
  int count_ = 0;
};

}  // namespace hyperex::fem
