// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <tbb/parallel_invoke.h>

#include <Eigen/Dense>
#include <vector>

#include "hyperex/fem/solve/supernodes.hpp"

namespace hyperex::bench {

/// An experiment: solves with a copy of a supernodal factor in another number type. The elimination
/// tree is divided into two halves and a top, as in fem::TriangularSolver. Running the same code in
/// double and in float shows the effect of the width of the numbers.
template <class T>
class TreeKernel {
 public:
  using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;

  explicit TreeKernel(const fem::Supernodes& factor) : f_(factor) {
    const std::size_t values = static_cast<std::size_t>(f_.value_start[f_.count]);
    value_.assign(f_.value, f_.value + values);
    divide();
  }

  double bytes() const { return static_cast<double>(value_.size() * sizeof(T)); }

  /// y := L^-T L^-1 y in the factor's order.
  void solve(Vector& y) {
    const auto each_half = [](auto work) {
      tbb::parallel_invoke([&] { work(0); }, [&] { work(1); });
    };
    each_half([&](int h) {
      aside_[h].setZero();
      for (const int s : half_[h]) forward(s, y, work_[h], aside_[h].data());
    });
    for (const int k : top_columns_) y[k] -= aside_[0][k] + aside_[1][k];
    for (const int s : top_) forward(s, y, work_[0], nullptr);
    for (auto s = top_.rbegin(); s != top_.rend(); ++s) backward(*s, y, work_[0]);
    each_half([&](int h) {
      for (auto s = half_[h].rbegin(); s != half_[h].rend(); ++s) backward(*s, y, work_[h]);
    });
  }

 private:
  using Block =
      Eigen::Map<const Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>, 0, Eigen::OuterStride<>>;
  struct Panel {
    int columns, below;
    const int* rows;
    Block diagonal, under;
  };
  Panel panel(int s) const {
    const int columns = f_.first[s + 1] - f_.first[s];
    const int height = f_.row_start[s + 1] - f_.row_start[s];
    const T* value = value_.data() + f_.value_start[s];
    return {columns, height - columns, f_.row + f_.row_start[s] + columns,
            Block(value, columns, columns, Eigen::OuterStride<>(height)),
            Block(value + columns, height - columns, columns, Eigen::OuterStride<>(height))};
  }

  void forward(int s, Vector& y, Vector& sum, T* aside) {
    const Panel p = panel(s);
    auto x = y.segment(f_.first[s], p.columns);
    p.diagonal.template triangularView<Eigen::Lower>().solveInPlace(x);
    auto part = sum.head(p.below);
    part.noalias() = p.under * x;
    const int inner = aside ? inner_[s] : p.below;
    for (int i = 0; i < inner; ++i) y[p.rows[i]] -= part[i];
    for (int i = inner; i < p.below; ++i) aside[p.rows[i]] += part[i];
  }
  void backward(int s, Vector& y, Vector& work) {
    const Panel p = panel(s);
    auto x = y.segment(f_.first[s], p.columns);
    auto above = work.head(p.below);
    for (int i = 0; i < p.below; ++i) above[i] = y[p.rows[i]];
    x.noalias() -= p.under.transpose() * above;
    p.diagonal.transpose().template triangularView<Eigen::Upper>().solveInPlace(x);
  }

  void divide() {
    const std::vector<int> half = fem::halves(f_, fem::parents(f_), [](const fem::Panel& p) {
      return (p.below + 0.5 * p.columns) * p.columns;  // numbers to read
    });
    std::vector<int> holder(static_cast<std::size_t>(f_.columns));
    Eigen::Index tallest = 0;
    for (int s = 0; s < f_.count; ++s) {
      std::fill(holder.begin() + f_.first[s], holder.begin() + f_.first[s + 1], s);
      tallest = std::max<Eigen::Index>(tallest, panel(s).below);
    }
    settle(half, holder, tallest);
  }

  void settle(const std::vector<int>& half, const std::vector<int>& holder, Eigen::Index tallest) {
    inner_.assign(static_cast<std::size_t>(f_.count), 0);
    for (int s = 0; s < f_.count; ++s) {
      (half[s] < 0 ? top_ : half_[half[s]]).push_back(s);
      const Panel p = panel(s);
      while (inner_[s] < p.below && half[holder[p.rows[inner_[s]]]] >= 0) ++inner_[s];
      if (half[s] < 0)
        for (int k = f_.first[s]; k < f_.first[s + 1]; ++k) top_columns_.push_back(k);
    }
    for (int h = 0; h < 2; ++h) {
      aside_[h].resize(f_.columns);
      work_[h].resize(tallest);
    }
  }

  fem::Supernodes f_;
  std::vector<T> value_;
  std::vector<int> half_[2], top_, inner_, top_columns_;
  Vector aside_[2], work_[2];
};

}  // namespace hyperex::bench
