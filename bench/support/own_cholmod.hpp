// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cholmod.h>

#include "hyperex/core/error.hpp"
#include "hyperex/fem/solve/cholmod_view.hpp"
#include "support/timing.hpp"

namespace hyperex::bench {

/// CHOLMOD alone, with a chosen ordering, to compare fem::Cholesky with.
class OwnCholmod {
 public:
  /// Analyses and factors the lower triangle. `ordering`: CHOLMOD_AMD, CHOLMOD_METIS ...
  OwnCholmod(const fem::SparseMatrix& lower, int ordering) {
    cholmod_start(&common_);
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.nmethods = 1;
    common_.method[0].ordering = ordering;
    common_.postorder = 1;
    cholmod_sparse view = fem::cholmod_view(lower);
    Stopwatch watch;
    factor_ = cholmod_analyze(&view, &common_);
    analyse_s_ = watch.lap();
    for (int i = 0; i < 2; ++i) {  // the second time memory is there, as when re-factoring
      watch.lap();
      cholmod_factorize(&view, factor_, &common_);
      factor_s_ = watch.lap();
    }
    if (!factor_ || common_.status != CHOLMOD_OK) throw NumericalError("CHOLMOD did not factor");
  }
  ~OwnCholmod() {
    cholmod_free_dense(&x_, &common_);
    cholmod_free_dense(&y_, &common_);
    cholmod_free_dense(&e_, &common_);
    cholmod_free_factor(&factor_, &common_);
    cholmod_finish(&common_);
  }
  OwnCholmod(const OwnCholmod&) = delete;

  void solve(const Eigen::MatrixXd& b) {
    cholmod_dense view{};
    view.nrow = view.d = static_cast<std::size_t>(b.rows());
    view.ncol = static_cast<std::size_t>(b.cols());
    view.nzmax = static_cast<std::size_t>(b.size());
    view.x = const_cast<double*>(b.data());
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    cholmod_solve2(CHOLMOD_A, factor_, &view, nullptr, &x_, nullptr, &y_, &e_, &common_);
  }

  fem::Supernodes supernodes() const { return fem::supernodes_of(*factor_); }
  const int* permutation() const { return static_cast<const int*>(factor_->Perm); }
  double entries() const { return static_cast<double>(factor_->xsize); }
  double analyse_seconds() const { return analyse_s_; }
  double factor_seconds() const { return factor_s_; }

 private:
  cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
  cholmod_dense *x_ = nullptr, *y_ = nullptr, *e_ = nullptr;
  double analyse_s_ = 0, factor_s_ = 0;
};

}  // namespace hyperex::bench
