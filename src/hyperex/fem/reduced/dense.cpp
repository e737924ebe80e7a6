// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/reduced/dense.hpp"

#include <cblas.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <array>

#include "hyperex/core/assert.hpp"
#include "hyperex/core/vector_clones.hpp"

namespace hyperex::fem {
namespace {
constexpr int kParts = 4;
constexpr int kWidth = 8;

/// Rows `from` to `to` of out = S in. `in` and `out` are row-major; `width` is a multiple of
/// kWidth.
HX_CLONES void multiply_rows(const int* start, const int* index, const double* value,
                             Eigen::Index from, Eigen::Index to, Eigen::Index width,
                             const double* __restrict in, double* __restrict out) {
  for (Eigen::Index r = from; r < to; ++r)
    for (Eigen::Index c = 0; c < width; c += kWidth) {
      double sum[kWidth] = {};
      for (int k = start[r]; k < start[r + 1]; ++k) {
        const double* __restrict x = in + index[k] * width + c;
        const double v = value[k];
        for (int j = 0; j < kWidth; ++j) sum[j] += v * x[j];
      }
      for (int j = 0; j < kWidth; ++j) out[r * width + c + j] = sum[j];
    }
}
}  // namespace

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
  // B is stored by rows, so that one entry of S multiplies adjacent numbers and the sums stay in
  // registers.
  const Eigen::Index width = (b.cols() + kWidth - 1) / kWidth * kWidth;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Rows in = Rows::Zero(b.rows(), width), out(b.rows(), width);
  in.leftCols(b.cols()) = b;
  tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, s.cols(), 512), [&](const auto& range) {
    multiply_rows(s.outerIndexPtr(), s.innerIndexPtr(), s.valuePtr(), range.begin(), range.end(),
                  width, in.data(), out.data());
  });
  return out.leftCols(b.cols());
}

}  // namespace hyperex::fem
