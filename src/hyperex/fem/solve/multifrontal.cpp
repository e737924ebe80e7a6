// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/multifrontal.hpp"

#include <cblas.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "hyperex/core/assert.hpp"
#include "hyperex/fem/material/entry.hpp"

extern "C" void dpotrf_(const char* part, const int* n, double* a, const int* stride, int* info);

namespace hyperex::fem {
namespace {

/// With fewer rows than this, a second thread does not pay.
constexpr int kPartedFrom = 128;

/// b := b L^-T; b: `rows` x `columns`.
void divide_by_transposed(const double* l, double* b, int rows, int columns, int stride) {
  cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, rows, columns, 1, l,
              stride, b, stride);
}

/// c := -a a^T, lower triangle; a: `rows` x `columns`, c: `c_stride` apart.
void negative_square(const double* a, int rows, int columns, int stride, double* c, int c_stride) {
  cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, rows, columns, -1, a, stride, 0, c,
              c_stride);
}

}  // namespace

Multifrontal::Multifrontal(const Supernodes& f, const int* order, const SparseMatrix& lower)
    : parent_(parents(f)),
      half_(halves(f, parent_,
                   [](const Panel& p) {  // number of multiplications
                     const double n = p.columns, m = p.below;
                     return n * (n * n / 3 + n * m + m * m) + 100 * n;
                   })),
      children_(f.count) {
  for (int s = 0; s < f.count; ++s) {
    (half_[s] < 0 ? top_ : by_half_[half_[s]]).push_back(s);
    if (parent_[s] >= 0) children_[parent_[s]].push_back(s);
  }
  map_entries(f, order, lower);
  map_children(f);
  lay_out_stacks(f);
}

void Multifrontal::map_entries(const Supernodes& f, const int* order, const SparseMatrix& lower) {
  std::vector<int> rank(f.columns), holder(f.columns);
  for (int k = 0; k < f.columns; ++k) rank[order[k]] = k;
  for (int s = 0; s < f.count; ++s)
    std::fill(holder.begin() + f.first[s], holder.begin() + f.first[s + 1], s);
  const auto each = [&](const auto& work) {
    for (int c = 0; c < f.columns; ++c)
      for (int k = lower.outerIndexPtr()[c]; k < lower.outerIndexPtr()[c + 1]; ++k) {
        const auto [column, row] = std::minmax(rank[c], rank[lower.innerIndexPtr()[k]]);
        work(holder[column], column, row, k);
      }
  };
  entries_.start.assign(f.count + 1, 0);
  each([&](int s, int, int, int) { ++entries_.start[s + 1]; });
  std::partial_sum(entries_.start.begin(), entries_.start.end(), entries_.start.begin());
  entries_.from.resize(lower.nonZeros());
  entries_.place.resize(lower.nonZeros());
  std::vector<int> next(entries_.start.begin(), entries_.start.end() - 1);
  each([&](int s, int column, int row, int k) {
    const int* const rows = f.row + f.row_start[s];
    const int height = f.row_start[s + 1] - f.row_start[s];
    const int* const at = std::lower_bound(rows, rows + height, row);
    HX_ASSERT(at < rows + height && *at == row);
    entries_.from[next[s]] = k;
    entries_.place[next[s]++] = (column - f.first[s]) * height + static_cast<int>(at - rows);
  });
}

void Multifrontal::map_children(const Supernodes& f) {
  relative_start_.assign(f.count + 1, 0);
  for (int s = 0; s < f.count; ++s) relative_start_[s + 1] = relative_start_[s] + panel(f, s).below;
  relative_.resize(relative_start_.back());
  for (int s = 0; s < f.count; ++s) {
    if (parent_[s] < 0) continue;
    const Panel p = panel(f, s);
    const int* const rows = f.row + f.row_start[parent_[s]];
    const int* at = rows;
    for (int i = 0; i < p.below; ++i) {
      while (*at != p.rows[i]) ++at;  // a parent holds all rows of its children
      relative_[relative_start_[s] + i] = static_cast<int>(at - rows);
    }
  }
}

void Multifrontal::lay_out_stacks(const Supernodes& f) {
  std::vector<int> depth(f.count, 0);
  for (int s = f.count - 1; s >= 0; --s)
    if (parent_[s] >= 0) depth[s] = depth[parent_[s]] + 1;
  stack_of_.resize(f.count);
  offset_.resize(f.count);
  std::array<std::ptrdiff_t, 6> height{}, most{};
  // The numbering is a postorder: the children come directly before their parent.
  for (int s = 0; s < f.count; ++s) {
    const int group = half_[s] < 0 ? 2 : half_[s];
    for (const int child : children_[s])
      if (half_[child] == half_[s])
        height[stack_of_[child]] = std::min(height[stack_of_[child]], offset_[child]);
    const int stack = stack_of_[s] = 2 * group + depth[s] % 2;
    offset_[s] = height[stack];
    const std::ptrdiff_t rows = panel(f, s).below;
    height[stack] += rows * rows;
    most[stack] = std::max(most[stack], height[stack]);
  }
  for (int i = 0; i < 6; ++i) stack_[i].resize(static_cast<std::size_t>(most[i]));
}

/// Performs one factorisation.
struct Multifrontal::Run {
  Multifrontal& m;
  const Supernodes& f;
  const double* entries;
  double* value;

  /// Adds those columns of a child's contribution that belong to the parent's own columns (`own`),
  /// or the remaining columns.
  void add_child(int child, bool own, const Panel& p, double* l, double* left) const {
    const int rows = panel(f, child).below;
    const int* const at = m.relative_.data() + m.relative_start_[child];
    const double* const from = m.left_over(child);
    const int mine = static_cast<int>(std::lower_bound(at, at + rows, p.columns) - at);
    for (int j = own ? 0 : mine; j < (own ? mine : rows); ++j) {
      double* const to = own ? l + std::ptrdiff_t{at[j]} * p.height()
                             : left + std::ptrdiff_t{at[j] - p.columns} * p.below - p.columns;
      const double* const column = from + std::ptrdiff_t{j} * rows;
      for (int i = j; i < rows; ++i) to[at[i]] += column[i];
    }
  }

  /// Returns -1, or the column of the panel at which the pivot is not positive.
  int eliminate(int s, bool parted) const {
    const Panel p = panel(f, s);
    const int height = p.height();
    double* const l = value + f.value_start[s];
    double* const left = m.left_over(s);
    std::fill_n(l, std::ptrdiff_t{height} * p.columns, 0.0);
    for (int k = m.entries_.start[s]; k < m.entries_.start[s + 1]; ++k)
      l[m.entries_.place[k]] = entries[m.entries_.from[k]];
    for (const int child : m.children_[s]) add_child(child, true, p, l, left);
    int info = 0;
    dpotrf_("L", &p.columns, l, &height, &info);
    if (info != 0) return info - 1;
    if (p.below == 0) return -1;
    if (parted && p.below >= kPartedFrom)
      reduce_parted(p, l, left);
    else
      reduce(p, l, left);
    for (const int child : m.children_[s]) add_child(child, false, p, l, left);
    return -1;
  }

  static void reduce(const Panel& p, double* l, double* left) {
    double* const under = l + p.columns;
    divide_by_transposed(l, under, p.below, p.columns, p.height());
    negative_square(under, p.below, p.columns, p.height(), left, p.below);
  }

  /// The same with the rows divided in two, such that both parts of the lower triangle have equal
  /// size.
  static void reduce_parted(const Panel& p, double* l, double* left) {
    const int height = p.height(), half = p.below / 2;
    double* const under = l + p.columns;
    tbb::parallel_invoke(
        [&] { divide_by_transposed(l, under, half, p.columns, height); },
        [&] { divide_by_transposed(l, under + half, p.below - half, p.columns, height); });
    const int first = static_cast<int>(std::lround(p.below * std::sqrt(0.5)));
    tbb::parallel_invoke([&] { negative_square(under, first, p.columns, height, left, p.below); },
                         [&] {
                           cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, p.below - first,
                                       first, p.columns, -1, under + first, height, under, height,
                                       0, left + first, p.below);
                           negative_square(under + first, p.below - first, p.columns, height,
                                           left + first + std::ptrdiff_t{first} * p.below, p.below);
                         });
  }

  /// Returns -1, or the column in elimination order at which the pivot is not positive.
  int eliminate_all(const std::vector<int>& supernodes, bool parted) const {
    for (const int s : supernodes)
      if (const int lost = eliminate(s, parted); lost >= 0) return f.first[s] + lost;
    return -1;
  }
};

int Multifrontal::factorize(const Supernodes& pattern, const SparseMatrix& lower, double* value) {
  require(
      static_cast<std::size_t>(lower.nonZeros()) == entries_.from.size(),
      "the matrix has {} entries in its lower triangle: expected the {} of the pattern analysed",
      lower.nonZeros(), entries_.from.size());
  const Run run{*this, pattern, lower.valuePtr(), value};
  std::array<int, 2> lost{-1, -1};
  tbb::parallel_invoke([&] { lost[0] = run.eliminate_all(by_half_[0], false); },
                       [&] { lost[1] = run.eliminate_all(by_half_[1], false); });
  if (lost[0] >= 0 && lost[1] >= 0) return std::min(lost[0], lost[1]);
  if (lost[0] >= 0 || lost[1] >= 0) return std::max(lost[0], lost[1]);
  return run.eliminate_all(top_, true);
}

}  // namespace hyperex::fem
