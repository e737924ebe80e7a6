// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/reduced/dense.hpp"

#include <cblas.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <array>

#include "hyperex/core/assert.hpp"

namespace hyperex::fem {
namespace {
constexpr int kParts = 4;
}

Eigen::MatrixXd inner_products(const Eigen::Ref<const Eigen::MatrixXd>& a,
                               const Eigen::Ref<const Eigen::MatrixXd>& b) {
  const int m = static_cast<int>(a.cols()), n = static_cast<int>(b.cols());
  if (m == 0 || n == 0) return Eigen::MatrixXd::Zero(m, n);
  HX_ASSERT(a.rows() == b.rows());
  std::array<Eigen::MatrixXd, kParts> part;
  tbb::parallel_for(0, kParts, [&](int i) {
    const Eigen::Index from = a.rows() * i / kParts, to = a.rows() * (i + 1) / kParts;
    part[i].resize(m, n);
    cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, m, n, static_cast<int>(to - from), 1,
                a.data() + from, static_cast<int>(a.outerStride()), b.data() + from,
                static_cast<int>(b.outerStride()), 0, part[i].data(), m);
  });
  return (part[0] + part[1]) + (part[2] + part[3]);
}

void add_product(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::MatrixXd& b,
                 double factor, Eigen::Ref<Eigen::MatrixXd> out) {
  HX_ASSERT(a.cols() == b.rows() && out.cols() == b.cols());
  if (a.cols() == 0 || b.cols() == 0) return;
  HX_ASSERT(out.rows() == a.rows());
  tbb::parallel_for(0, kParts, [&](int i) {
    const Eigen::Index from = a.rows() * i / kParts, to = a.rows() * (i + 1) / kParts;
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, static_cast<int>(to - from),
                static_cast<int>(b.cols()), static_cast<int>(a.cols()), factor, a.data() + from,
                static_cast<int>(a.outerStride()), b.data(), static_cast<int>(b.outerStride()), 1,
                out.data() + from, static_cast<int>(out.outerStride()));
  });
}

Eigen::MatrixXd symmetric_product(const SparseMatrix& s,
                                  const Eigen::Ref<const Eigen::MatrixXd>& b) {
  HX_ASSERT(s.cols() == b.rows());
  // By rows, so that one entry of S meets neighbouring numbers.
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Rows in = b;
  Rows out(b.rows(), b.cols());
  tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, s.cols(), 512), [&](const auto& range) {
    for (Eigen::Index r = range.begin(); r < range.end(); ++r) {
      out.row(r).setZero();
      for (int k = s.outerIndexPtr()[r]; k < s.outerIndexPtr()[r + 1]; ++k)
        out.row(r) += s.valuePtr()[k] * in.row(s.innerIndexPtr()[k]);
    }
  });
  return out;
}

}  // namespace hyperex::fem
