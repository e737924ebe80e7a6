// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/cholesky.hpp"

#include <cholmod.h>
#include <fmt/format.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <vector>

#include "hyperex/core/error.hpp"
#include "hyperex/core/one_thread.hpp"
#include "hyperex/fem/material/entry.hpp"
#include "hyperex/fem/solve/cholmod_view.hpp"
#include "hyperex/fem/solve/metis_turn.hpp"
#include "hyperex/fem/solve/multifrontal.hpp"
#include "hyperex/fem/solve/triangular.hpp"

extern "C" void dpotri_(const char* part, const int* n, double* a, const int* stride, int* info);

namespace hyperex::fem {
namespace {

/// A pivot smaller than this share of its diagonal entry is rounding error: the direction has no
/// stiffness. (A free body gives about 1e-15; a bar of a hundred elements still gives 1e-8.)
constexpr double kLeastPivot = 1e-12;

}  // namespace

struct Cholesky::Impl {
  std::string purpose;
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  struct Block {  // CHOLMOD's workspaces for several right-hand sides
    cholmod_common common{};
    cholmod_dense *x = nullptr, *y = nullptr, *e = nullptr;
    Block() { cholmod_start(&common); }
    ~Block() {
      cholmod_free_dense(&x, &common);
      cholmod_free_dense(&y, &common);
      cholmod_free_dense(&e, &common);
      cholmod_finish(&common);
    }
    Block(const Block&) = delete;
    Block& operator=(const Block&) = delete;
  } block[2];
  std::vector<double> permuted;
  Multifrontal multifrontal;
  TriangularSolver triangular;
  bool prepared = false;  // whether both blocks are prepared
  double entries_needed = 0, flops = 0;

  Impl() {
    keep_blas_to_one_thread();
    cholmod_start(&common);
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.print = 0;
    common.nmethods = 1;
    // Compared with AMD, METIS takes a little longer to order, but a step is then 1.2 times
    // (layers) to 2 times (blocks) as fast.
    common.method[0].ordering = CHOLMOD_METIS;
    common.postorder = 1;
  }
  ~Impl() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Impl(const Impl&) = delete;

  [[noreturn]] void fail() const {
    throw NumericalError(fmt::format("{}: the factorisation of {} unknowns failed ({})", purpose,
                                     permuted.size(),
                                     common.status == CHOLMOD_OUT_OF_MEMORY ? "out of memory"
                                     : common.status == CHOLMOD_TOO_LARGE   ? "too large"
                                                                            : "CHOLMOD"));
  }

  /// Allocates memory for the numbers of the analysed factor.
  void prepare(const SparseMatrix& lower) {
    if (!cholmod_change_factor(CHOLMOD_REAL, 1, 1, 1, 1, factor, &common)) fail();
    factor->minor = factor->n;
    multifrontal = Multifrontal(supernodes(), static_cast<const int*>(factor->Perm), lower);
    triangular = TriangularSolver(supernodes());
    prepared = true;
  }

  /// Solves for the columns of B by CHOLMOD.
  void solve(Block& part, double* columns, std::size_t count) const {
    if (count == 0) return;
    cholmod_dense b{};
    b.nrow = b.d = factor->n;
    b.ncol = count;
    b.nzmax = b.nrow * b.ncol;
    b.x = columns;
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    if (!cholmod_solve2(CHOLMOD_A, factor, &b, nullptr, &part.x, nullptr, &part.y, &part.e,
                        &part.common))
      throw NumericalError(purpose + ": the solve failed (CHOLMOD)");
    std::copy_n(static_cast<const double*>(part.x->x), b.nzmax, columns);
  }

  Supernodes supernodes() const { return supernodes_of(*factor); }

  /// The column of the first pivot that is only rounding error, or -1 if there is none.
  int lost_pivot(const SparseMatrix& lower) const {
    const Supernodes l = supernodes();
    const auto* perm = static_cast<const int*>(factor->Perm);
    for (int s = 0; s < l.count; ++s) {
      const std::ptrdiff_t height = l.row_start[s + 1] - l.row_start[s];
      for (int k = 0; k < l.first[s + 1] - l.first[s]; ++k) {
        const double pivot = l.value[l.value_start[s] + k * (height + 1)];
        const int column = perm[l.first[s] + k];
        // The diagonal entry is the first of its column in the lower triangle.
        if (!(pivot * pivot > kLeastPivot * lower.valuePtr()[lower.outerIndexPtr()[column]]))
          return column;
      }
    }
    return -1;
  }
};

Cholesky::Cholesky(const SparseMatrix& lower, std::string purpose, std::vector<int> order)
    : impl_(std::make_unique<Impl>()) {
  require(lower.rows() == lower.cols() && lower.isCompressed(),
          "{}: the lower triangle is {} x {}: expected a square, compressed matrix", purpose,
          lower.rows(), lower.cols());
  impl_->purpose = std::move(purpose);
  impl_->permuted.resize(static_cast<std::size_t>(lower.cols()));
  if (lower.cols() == 0) return;
  cholmod_sparse view = cholmod_view(lower);
  if (!order.empty()) {
    check_size("the order of elimination", static_cast<Eigen::Index>(order.size()), lower.cols());
    impl_->common.method[0].ordering = CHOLMOD_GIVEN;
  }
  const auto turn = metis_turn();
  impl_->factor =
      cholmod_analyze_p(&view, order.empty() ? nullptr : order.data(), nullptr, 0, &impl_->common);
  if (!impl_->factor || impl_->common.status < CHOLMOD_OK) impl_->fail();
  impl_->entries_needed = impl_->common.lnz;
  impl_->flops = impl_->common.fl;
}

Cholesky::~Cholesky() = default;
Cholesky::Cholesky(Cholesky&&) noexcept = default;
Cholesky& Cholesky::operator=(Cholesky&&) noexcept = default;

int Cholesky::factorize(const SparseMatrix& lower) {
  Impl& m = *impl_;
  check_size("the lower triangle", lower.cols(), size());
  if (size() == 0) return -1;
  if (!m.prepared) m.prepare(lower);
  const int lost =
      m.multifrontal.factorize(m.supernodes(), lower, static_cast<double*>(m.factor->x));
  if (lost >= 0) return static_cast<const int*>(m.factor->Perm)[lost];
  return m.lost_pivot(lower);
}

void Cholesky::solve(Eigen::VectorXd& x) {
  Impl& m = *impl_;
  check_size("the right-hand side", x.size(), size());
  if (size() == 0) return;
  const auto* perm = static_cast<const int*>(m.factor->Perm);
  for (int i = 0; i < size(); ++i) m.permuted[i] = x[perm[i]];
  m.triangular.solve(m.supernodes(), m.permuted.data());
  for (int i = 0; i < size(); ++i) x[perm[i]] = m.permuted[i];
}

void Cholesky::solve(Eigen::MatrixXd& x) {
  Impl& m = *impl_;
  check_rows("the right-hand side", x.rows(), size());
  if (size() == 0 || x.cols() == 0) return;
  // Always in two parts, whatever the number of threads, so that the results are reproducible.
  const auto half = static_cast<std::size_t>(x.cols() / 2);
  tbb::parallel_invoke([&] { m.solve(m.block[0], x.data(), half); },
                       [&] {
                         m.solve(m.block[1], x.data() + half * x.rows(),
                                 static_cast<std::size_t>(x.cols()) - half);
                       });
}

Eigen::MatrixXd Cholesky::inverse_of_last(const std::vector<int>& columns) const {
  const Impl& m = *impl_;
  const int n = static_cast<int>(columns.size()), before = size() - n;
  require(n <= size(), "{} columns of {} are wanted", n, size());
  if (n == 0) return {};
  const auto* perm = static_cast<const int*>(m.factor->Perm);
  std::vector<int> last(perm + before, perm + size());
  std::sort(last.begin(), last.end());
  if (last != columns) return {};
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(n, n);
  const Supernodes l = m.supernodes();
  for (int s = l.count - 1; s >= 0 && l.first[s + 1] > before; --s) {
    const std::ptrdiff_t height = l.row_start[s + 1] - l.row_start[s];
    for (int c = std::max(before, l.first[s]); c < l.first[s + 1]; ++c) {
      const std::ptrdiff_t k = c - l.first[s];
      for (std::ptrdiff_t r = k; r < height; ++r)
        inverse(l.row[l.row_start[s] + r] - before, c - before) =
            l.value[l.value_start[s] + k * height + r];
    }
  }
  int info = 0;
  dpotri_("L", &n, inverse.data(), &n, &info);
  if (info != 0) throw NumericalError(m.purpose + ": a pivot of the factor is 0");
  // Position in `columns` of the k-th of the last columns.
  std::vector<int> place(static_cast<std::size_t>(n));
  for (int k = 0; k < n; ++k)
    place[static_cast<std::size_t>(k)] = static_cast<int>(
        std::lower_bound(columns.begin(), columns.end(), perm[before + k]) - columns.begin());
  Eigen::MatrixXd out(n, n);
  for (int c = 0; c < n; ++c)
    for (int r = c; r < n; ++r)
      out(place[std::size_t(r)], place[std::size_t(c)]) =
          out(place[std::size_t(c)], place[std::size_t(r)]) = inverse(r, c);
  return out;
}

int Cholesky::size() const {
  return static_cast<int>(impl_->permuted.size());
}
double Cholesky::entries() const {
  return impl_->factor ? static_cast<double>(impl_->factor->xsize) : 0;
}
double Cholesky::entries_needed() const {
  return impl_->entries_needed;
}
double Cholesky::flops() const {
  return impl_->flops;
}

}  // namespace hyperex::fem
