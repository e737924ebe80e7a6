// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/displacement_modes.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/core/assert.hpp"
#include "hyperex/report/frame_products.hpp"

namespace hyperex::report {
namespace {

using Eigen::Index;
using Block = Eigen::MatrixXd;  // rows: coordinates of some vertices; columns: frames

// The allowed error of the shapes that span many frames, as a share of the tolerance.
constexpr double kSpanShare = 0.02;

/// Right singular vectors of a wide matrix X, N x rank, computed from X X^T.
Eigen::MatrixXd right_vectors_of_wide(const Eigen::MatrixXd& wide) {
  Eigen::VectorXd values;
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(wide.rows(), wide.rows());
  gram.selfadjointView<Eigen::Lower>().rankUpdate(wide);
  const Eigen::MatrixXd left = leading_eigenvectors(gram, values);
  return (wide.transpose() * left) * values.cwiseSqrt().cwiseInverse().asDiagonal();
}

/// Right singular vectors of the 3|V| x N matrix X of the frames (orthonormal, N x rank), computed
/// from the smaller one of X^T X and X X^T. If both are large, X is first reduced to shapes whose
/// error is far below the tolerance.
Eigen::MatrixXd right_singular_vectors(const std::vector<PointsF>& frames, double tolerance) {
  const auto n = static_cast<Index>(frames.size());
  const Index coordinates = 3 * frames.front().rows();
  if (std::min(n, coordinates) > kFramesAtOnce)
    return right_vectors_of_wide(courses_along_few_shapes(frames, kSpanShare * tolerance));
  Eigen::VectorXd values;
  if (n <= coordinates) return leading_eigenvectors(frame_products(frames), values);
  Block all;
  gather(frames, 0, frames.front().rows(), all);
  return right_vectors_of_wide(all);
}

/// The least number of columns of `basis` (N x N, orthonormal, most important first) that keeps the
/// block within the tolerance, starting the search at `at_least`.
Index modes_for(const Block& block, const Eigen::MatrixXd& basis, Index at_least,
                double tolerance) {
  Block residual = block;
  const auto used = basis.leftCols(at_least);
  residual.noalias() -= (block * used).eval() * used.transpose();
  Index k = at_least;
  while (k < basis.cols() && largest_row_error(residual) > tolerance) {
    const Eigen::VectorXd along = block * basis.col(k);
    residual.noalias() -= along * basis.col(k).transpose();
    ++k;
  }
  return k;
}

/// Least K that holds for all blocks. The error of one vertex need not fall with every mode, so a
/// K raised by a later block is tried again on the earlier ones.
Index modes_needed(const std::vector<PointsF>& frames, const Eigen::MatrixXd& basis, Index most,
                   double tolerance) {
  Index k = 0;
  for (Index before = -1; before != k;) {
    before = k;
    for_blocks(frames, [&](Index, Index, const Block& block) {
      k = modes_for(block, basis.leftCols(most), k, tolerance);
    });
  }
  return k;
}

void fill(const std::vector<PointsF>& frames, const Eigen::MatrixXd& basis,
          const Eigen::VectorXd& scale, DisplacementModes& out) {
  const Index k = basis.cols();
  out.modes.assign(k, PointsF(frames.front().rows(), 3));
  out.weights = (basis * scale.cwiseInverse().asDiagonal()).cast<float>();
  const Eigen::MatrixXd weights = out.weights.cast<double>();
  for_blocks(frames, [&](Index first, Index count, Block& block) {
    // Basis columns are orthonormal: block * basis are the coefficients.
    const Block shapes = block * basis * scale.asDiagonal();
    for (Index j = 0; j < k; ++j)
      Eigen::Map<Eigen::VectorXf>(out.modes[j].data() + 3 * first, 3 * count) =
          shapes.col(j).cast<float>();
    // Measured on what is handed out, rounding to single precision included.
    block.noalias() -= shapes.cast<float>().cast<double>() * weights.transpose();
    out.max_error_m = std::max(out.max_error_m, largest_row_error(block));
  });
}

}  // namespace

PointsF DisplacementModes::displacement(Index frame) const {
  if (modes.empty()) return {};
  PointsF sum = weights(frame, 0) * modes[0];
  for (std::size_t k = 1; k < modes.size(); ++k) sum += weights(frame, k) * modes[k];
  return sum;
}

DisplacementModes displacement_modes(const std::vector<PointsF>& frames, double tolerance_m) {
  DisplacementModes out;
  const auto n = static_cast<Index>(frames.size());
  out.weights.resize(n, 0);
  if (n == 0 || frames.front().rows() == 0) return out;
  for ([[maybe_unused]] const auto& frame : frames)
    HX_ASSERT(frame.rows() == frames.front().rows());

  const Eigen::MatrixXd basis = right_singular_vectors(frames, tolerance_m);
  const Index k = modes_needed(frames, basis, basis.cols(), tolerance_m);
  Eigen::VectorXd scale(k);
  for (Index j = 0; j < k; ++j) {
    Index at = 0;
    basis.col(j).cwiseAbs().maxCoeff(&at);
    scale[j] = basis(at, j);  // signed: the largest weight becomes +1
  }
  fill(frames, basis.leftCols(k), scale, out);
  return out;
}

}  // namespace hyperex::report
