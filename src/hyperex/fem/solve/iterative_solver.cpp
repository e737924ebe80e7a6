// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/iterative_solver.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "hyperex/core/assert.hpp"
#include "hyperex/core/error.hpp"

namespace hyperex::fem {
namespace {

/// Right-hand sides solved in step: more gain little and need much memory.
constexpr Eigen::Index kTogether = 16;
constexpr Eigen::Index kChunk = 4096;

Points points_of(const NodeBlocks& a, const Points& all) {
  Points points(a.node_count(), 3);
  for (int i = 0; i < a.node_count(); ++i) points.row(i) = all.row(a.nodes()[i]);
  return points;
}

template <typename F>
void for_each_chunk(Eigen::Index rows, F f) {
  tbb::parallel_for(Eigen::Index{0}, (rows + kChunk - 1) / kChunk, [&](Eigen::Index chunk) {
    f(chunk, chunk * kChunk, std::min(kChunk, rows - chunk * kChunk));
  });
}

/// a_c . b_c of each column: chunks summed in their order, whatever the number of threads.
Eigen::RowVectorXd dots(const Columns& a, const Columns& b) {
  Columns part((a.rows() + kChunk - 1) / kChunk, a.cols());
  for_each_chunk(a.rows(), [&](Eigen::Index chunk, Eigen::Index from, Eigen::Index count) {
    part.row(chunk).setZero();
    for (Eigen::Index i = from; i < from + count; ++i)
      part.row(chunk) += a.row(i).cwiseProduct(b.row(i));
  });
  return part.colwise().sum();
}

/// a += b diag(factor)
void add(Columns& a, const Columns& b, const Eigen::RowVectorXd& factor) {
  for_each_chunk(a.rows(), [&](Eigen::Index, Eigen::Index from, Eigen::Index count) {
    for (Eigen::Index i = from; i < from + count; ++i) a.row(i) += b.row(i).cwiseProduct(factor);
  });
}

/// a := b + a diag(factor)
void scale_and_add(Columns& a, const Eigen::RowVectorXd& factor, const Columns& b) {
  for_each_chunk(a.rows(), [&](Eigen::Index, Eigen::Index from, Eigen::Index count) {
    for (Eigen::Index i = from; i < from + count; ++i)
      a.row(i) = b.row(i) + a.row(i).cwiseProduct(factor);
  });
}

void keep_columns(Columns& m, const std::vector<int>& columns) {
  m = Columns(m(Eigen::all, columns));
}

}  // namespace

IterativeSolver::IterativeSolver(const SparseMatrix& a, const Partition& partition,
                                 const Points& nodes, std::string purpose,
                                 const IterativeOptions& options)
    : purpose_(std::move(purpose)),
      options_(options),
      a_(a, partition),
      schwarz_(a_, points_of(a_, nodes), options.subdomain_nodes, purpose_) {
  HX_ASSERT(3 * nodes.rows() == a.cols());
}

int IterativeSolver::factorize(const SparseMatrix& a) {
  a_.refill(a);
  const int row = schwarz_.factorize(a_);
  if (row < 0) return -1;
  const int* unknown = a_.unknown().data() + row / 3 * 3;
  return unknown[row % 3] >= 0 ? unknown[row % 3] : *std::max_element(unknown, unknown + 3);
}

void IterativeSolver::solve(Eigen::MatrixXd& x, const Eigen::MatrixXd& guess) {
  last_iterations_ = 0;
  HX_ASSERT(guess.cols() == 0 || (guess.cols() == x.cols() && guess.rows() == x.rows()));
  for (Eigen::Index from = 0; from < x.cols(); from += kTogether)
    solve_together(x.middleCols(from, std::min(kTogether, x.cols() - from)), guess, from);
}

void IterativeSolver::solve_together(Eigen::Ref<Eigen::MatrixXd> x, const Eigen::MatrixXd& guess,
                                     Eigen::Index from) {
  const auto& unknown = a_.unknown();
  Columns r = Columns::Zero(a_.size(), x.cols()), solution = r, z, p, q(a_.size(), x.cols());
  for (int i = 0; i < a_.size(); ++i)
    if (unknown[i] >= 0) {
      r.row(i) = x.row(unknown[i]);
      if (guess.cols() > 0) solution.row(i) = guess.row(unknown[i]).segment(from, x.cols());
    }
  const Eigen::RowVectorXd wanted = options_.tolerance * dots(r, r).cwiseSqrt();
  const Eigen::RowVectorXd minus = Eigen::RowVectorXd::Constant(x.cols(), -1);
  if (guess.cols() > 0) {
    a_.product(solution, q);
    add(r, q, minus);
  }
  schwarz_.start(r, z);
  add(solution, z, -minus);
  a_.product(z, q);
  add(r, q, minus);

  std::vector<int> active(x.cols());  // their columns of x, where r, p, q and z are narrower
  for (std::size_t c = 0; c < active.size(); ++c) active[c] = static_cast<int>(c);
  Eigen::RowVectorXd rz;
  for (int iteration = 0;; ++iteration) {
    const Eigen::RowVectorXd norm = dots(r, r).cwiseSqrt();
    std::vector<int> still;
    for (std::size_t c = 0; c < active.size(); ++c) {
      if (!(norm[static_cast<Eigen::Index>(c)] <= wanted[active[c]])) {
        still.push_back(static_cast<int>(c));
        continue;
      }
      const auto column = static_cast<Eigen::Index>(c);
      for (int i = 0; i < a_.size(); ++i)
        if (unknown[i] >= 0) x(unknown[i], active[c]) = solution(i, column);
    }
    if (still.size() < active.size()) {
      for (Columns* m : {&r, &solution, &p})
        if (m->cols() > 0) keep_columns(*m, still);
      q.resize(a_.size(), static_cast<Eigen::Index>(still.size()));
      for (std::size_t c = 0; c < still.size(); ++c) {
        active[c] = active[still[c]];
        if (rz.size() > 0) rz[static_cast<Eigen::Index>(c)] = rz[still[c]];
      }
      active.resize(still.size());
      if (rz.size() > 0) rz.conservativeResize(static_cast<Eigen::Index>(still.size()));
    }
    if (active.empty()) return;
    if (iteration == options_.most_iterations)
      throw NumericalError(fmt::format(
          "{}: conjugate gradients did not reach the relative residual {:g} in {} iterations",
          purpose_, options_.tolerance, iteration));
    last_iterations_ = std::max(last_iterations_, iteration + 1);
    schwarz_.apply(r, z);
    const Eigen::RowVectorXd rz_new = dots(r, z);
    if (iteration == 0)
      p = z;
    else
      scale_and_add(p, rz_new.cwiseQuotient(rz), z);
    rz = rz_new;
    a_.product(p, q);
    const Eigen::RowVectorXd alpha = rz.cwiseQuotient(dots(p, q));
    add(solution, p, alpha);
    add(r, q, -alpha);
  }
}

}  // namespace hyperex::fem
