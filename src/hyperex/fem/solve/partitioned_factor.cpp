// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/partitioned_factor.hpp"

#include <cholmod.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <chrono>

#include "hyperex/core/error.hpp"

namespace hyperex::fem {
namespace {
/// The blocks of a factor are small: a second BLAS thread gains nothing on a free machine, and on a
/// busy one its spinning makes a step ten times slower (measured: 114 against 14 ms). OpenBLAS is
/// found at run time, as any BLAS may stand behind CHOLMOD.
void keep_blas_to_one_thread() {
  using SetThreads = void (*)(int);
  if (void* set = dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))
    reinterpret_cast<SetThreads>(set)(1);
}
}  // namespace

namespace {

/// A pivot this small against its own diagonal entry is rounding: the direction has no stiffness.
/// (A free body leaves about 1e-15; a bar a hundred elements long still has 1e-8.)
constexpr double kLeastPivot = 1e-12;

}  // namespace

struct PartitionedFactor::Impl {
  std::vector<int> prescribed, free;
  SparseMatrix oo;  // lower triangle
  SparseMatrix oc;
  std::string purpose;
  double seconds = 0;
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  cholmod_dense *x = nullptr, *y = nullptr, *e = nullptr;  // solution and kept workspaces

  Impl() {
    keep_blas_to_one_thread();
    cholmod_start(&common);
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.print = 0;
    common.nmethods = 1;
    // Measured against AMD: a little slower to order, but a step is 1.2 times (layers) to twice
    // (blocks) as quick.
    common.method[0].ordering = CHOLMOD_METIS;
    common.postorder = 1;
  }
  ~Impl() {
    cholmod_free_dense(&x, &common);
    cholmod_free_dense(&y, &common);
    cholmod_free_dense(&e, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Impl(const Impl&) = delete;

  void partition(const SparseMatrix& a);
  void factorize();
  void check_pivots() const;
  [[noreturn]] void refuse(int unknown) const;
};

void PartitionedFactor::Impl::partition(const SparseMatrix& a) {
  const int n = static_cast<int>(a.cols());
  assert(std::is_sorted(prescribed.begin(), prescribed.end()));
  assert(prescribed.empty() || (prescribed.front() >= 0 && prescribed.back() < n));
  std::vector<int> free_index(n, 0);
  for (const int c : prescribed) free_index[c] = -1;
  for (int i = 0; i < n; ++i)
    if (free_index[i] == 0) {
      free_index[i] = static_cast<int>(free.size());
      free.push_back(i);
    }
  assert(free.size() + prescribed.size() == static_cast<std::size_t>(n));

  const auto take_columns = [&](const std::vector<int>& columns, bool lower) {
    SparseMatrix part(free.size(), columns.size());
    part.reserve(a.nonZeros());
    for (std::size_t c = 0; c < columns.size(); ++c) {
      part.startVec(c);
      for (SparseMatrix::InnerIterator it(a, columns[c]); it; ++it) {
        const int row = free_index[it.row()];
        if (row >= 0 && (!lower || it.row() >= columns[c])) part.insertBack(row, c) = it.value();
      }
    }
    part.finalize();
    return part;
  };
  oo = take_columns(free, true);
  oc = take_columns(prescribed, false);
}

void PartitionedFactor::Impl::factorize() {
  cholmod_sparse view{};
  view.nrow = view.ncol = free.size();
  view.nzmax = oo.nonZeros();
  view.p = oo.outerIndexPtr();
  view.i = oo.innerIndexPtr();
  view.x = oo.valuePtr();
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = view.packed = 1;
  factor = cholmod_analyze(&view, &common);
  if (factor) cholmod_factorize(&view, factor, &common);
  if (!factor || common.status < CHOLMOD_OK)
    throw NumericalError(
        fmt::format("{}: the factorisation of {} unknowns failed ({})", purpose, free.size(),
                    common.status == CHOLMOD_OUT_OF_MEMORY ? "out of memory" : "CHOLMOD"));
  if (common.status == CHOLMOD_NOT_POSDEF)
    refuse(free[static_cast<const int*>(factor->Perm)[factor->minor]]);
  check_pivots();
}

void PartitionedFactor::Impl::check_pivots() const {
  const auto* perm = static_cast<const int*>(factor->Perm);
  const auto* super = static_cast<const int*>(factor->super);
  const auto* rows = static_cast<const int*>(factor->pi);
  const auto* start = static_cast<const int*>(factor->px);
  const auto* values = static_cast<const double*>(factor->x);
  for (std::size_t s = 0; s < factor->nsuper; ++s) {
    const int height = rows[s + 1] - rows[s];
    for (int k = 0; k < super[s + 1] - super[s]; ++k) {
      const double l = values[start[s] + static_cast<std::ptrdiff_t>(k) * (height + 1)];
      const int unknown = perm[super[s] + k];
      // The diagonal entry is the first of its column in the lower triangle.
      if (!(l * l > kLeastPivot * oo.valuePtr()[oo.outerIndexPtr()[unknown]]))
        refuse(free[unknown]);
    }
  }
}

void PartitionedFactor::Impl::refuse(int unknown) const {
  throw NumericalError(fmt::format(
      "{}: the matrix of the {} free unknowns is not positive definite (seen at node {}, axis {}): "
      "too few supports to hold every part of the mesh ({} unknowns are prescribed), or a node "
      "that no element uses",
      purpose, free.size(), unknown / 3, "xyz"[unknown % 3], prescribed.size()));
}

PartitionedFactor::PartitionedFactor(const SparseMatrix& a, std::vector<int> prescribed,
                                     const std::string& purpose)
    : impl_(std::make_unique<Impl>()) {
  assert(a.rows() == a.cols() && a.isCompressed());
  impl_->prescribed = std::move(prescribed);
  impl_->purpose = purpose;
  impl_->partition(a);
  const auto start = std::chrono::steady_clock::now();
  if (!impl_->free.empty()) impl_->factorize();
  impl_->seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

PartitionedFactor::~PartitionedFactor() = default;
PartitionedFactor::PartitionedFactor(PartitionedFactor&&) noexcept = default;

const std::vector<int>& PartitionedFactor::prescribed() const {
  return impl_->prescribed;
}
const std::vector<int>& PartitionedFactor::free() const {
  return impl_->free;
}
double PartitionedFactor::factor_seconds() const {
  return impl_->seconds;
}

void PartitionedFactor::solve(const Eigen::VectorXd& x_c, Eigen::VectorXd& x_o) {
  Impl& m = *impl_;
  assert(x_c.size() == m.oc.cols() && x_o.size() == m.oo.cols());
  if (m.free.empty()) return;
  if (x_c.size() > 0) x_o.noalias() -= m.oc * x_c;
  cholmod_dense b{};
  b.nrow = b.nzmax = b.d = m.free.size();
  b.ncol = 1;
  b.x = x_o.data();
  b.xtype = CHOLMOD_REAL;
  b.dtype = CHOLMOD_DOUBLE;
  if (!cholmod_solve2(CHOLMOD_A, m.factor, &b, nullptr, &m.x, nullptr, &m.y, &m.e, &m.common))
    throw NumericalError(m.purpose + ": the solve failed (CHOLMOD)");
  std::copy_n(static_cast<const double*>(m.x->x), x_o.size(), x_o.data());
}

}  // namespace hyperex::fem
