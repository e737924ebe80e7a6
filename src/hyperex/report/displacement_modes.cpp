// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/displacement_modes.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/core/assert.hpp"

namespace hyperex::report {
namespace {

using Eigen::Index;
using Block = Eigen::MatrixXd;  // rows: coordinates of some vertices; columns: frames

// Vertices taken at a time: the whole matrix in double precision would need twice the memory of
// the frames themselves.
constexpr Index block_vertices = 2048;

void gather(const std::vector<PointsF>& frames, Index first, Index count, Block& block) {
  block.resize(3 * count, static_cast<Index>(frames.size()));
  for (Index f = 0; f < block.cols(); ++f)
    block.col(f) =
        Eigen::Map<const Eigen::VectorXf>(frames[f].data() + 3 * first, 3 * count).cast<double>();
}

template <typename Visit>
void for_blocks(const std::vector<PointsF>& frames, Visit visit) {
  const Index vertices = frames.front().rows();
  Block block;
  for (Index first = 0; first < vertices; first += block_vertices) {
    const Index count = std::min(block_vertices, vertices - first);
    gather(frames, first, count, block);
    visit(first, count, block);
  }
}

/// Eigenvectors of a Gram matrix (its lower half), most important first; directions below its
/// rounding carry nothing and are left out.
Eigen::MatrixXd leading_eigenvectors(const Eigen::MatrixXd& gram, Eigen::VectorXd& values) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(gram);
  values = eigen.eigenvalues().reverse();
  const Index rank = (values.array() > 1e-15 * values[0]).count() * (values[0] > 0);
  values.conservativeResize(rank);
  return eigen.eigenvectors().rowwise().reverse().leftCols(rank);
}

/// Of the 3|V| x N matrix X of the frames, orthonormal, N x rank, through the smaller one of X^T X
/// and X X^T.
Eigen::MatrixXd right_singular_vectors(const std::vector<PointsF>& frames) {
  const auto n = static_cast<Index>(frames.size());
  const Index coordinates = 3 * frames.front().rows();
  Eigen::VectorXd values;
  if (n <= coordinates) {
    Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(n, n);
    for_blocks(frames, [&](Index, Index, const Block& block) {
      gram.selfadjointView<Eigen::Lower>().rankUpdate(block.transpose());
    });
    return leading_eigenvectors(gram, values);
  }
  Block all;
  gather(frames, 0, frames.front().rows(), all);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(coordinates, coordinates);
  gram.selfadjointView<Eigen::Lower>().rankUpdate(all);
  const Eigen::MatrixXd left = leading_eigenvectors(gram, values);
  return (all.transpose() * left) * values.cwiseSqrt().cwiseInverse().asDiagonal();
}

double largest_row_error(const Block& residual) {
  const Eigen::Map<const Eigen::Matrix<double, 3, Eigen::Dynamic>> vertices(residual.data(), 3,
                                                                            residual.size() / 3);
  return vertices.size() == 0 ? 0. : std::sqrt(vertices.colwise().squaredNorm().maxCoeff());
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

  const Eigen::MatrixXd basis = right_singular_vectors(frames);
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
