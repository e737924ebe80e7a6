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

// Of more frames the Gram matrix itself costs: its eigenvectors grow with the third power (five
// minutes for 5,000 frames, which move in some thirty shapes).
constexpr Index kFramesAtOnce = 512;
constexpr Index kFramesOfAPart = 128;
// What is left out of the shapes that span the frames, as a share of the tolerance.
constexpr double kSpanShare = 0.02;

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

double largest_row_error(const Block& residual) {
  const Eigen::Map<const Eigen::Matrix<double, 3, Eigen::Dynamic>> vertices(residual.data(), 3,
                                                                            residual.size() / 3);
  return vertices.size() == 0 ? 0. : std::sqrt(vertices.colwise().squaredNorm().maxCoeff());
}

/// Of a wide matrix, N x rank, through X X^T.
Eigen::MatrixXd right_vectors_of_wide(const Eigen::MatrixXd& wide) {
  Eigen::VectorXd values;
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(wide.rows(), wide.rows());
  gram.selfadjointView<Eigen::Lower>().rankUpdate(wide);
  const Eigen::MatrixXd left = leading_eigenvectors(gram, values);
  return (wide.transpose() * left) * values.cwiseSqrt().cwiseInverse().asDiagonal();
}

/// Adds to the orthonormal `shapes` what they lack for these frames, whose `rest` they leave.
void add_lacking(Block rest, double allowed, Eigen::MatrixXd& shapes) {
  if (largest_row_error(rest) <= allowed) return;
  Eigen::VectorXd values;
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(rest.cols(), rest.cols());
  gram.selfadjointView<Eigen::Lower>().rankUpdate(rest.transpose());
  const Eigen::MatrixXd mix = leading_eigenvectors(gram, values);
  Eigen::MatrixXd added(rest.rows(), mix.cols());
  Index count = 0;
  while (count < mix.cols() && largest_row_error(rest) > allowed) {
    const Eigen::VectorXd along = rest * mix.col(count);
    rest.noalias() -= along * mix.col(count).transpose();
    added.col(count) = along / std::sqrt(values[count]);
    ++count;
  }
  Eigen::MatrixXd more(shapes.rows(), shapes.cols() + count);
  more << shapes, added.leftCols(count);
  shapes = std::move(more);
}

/// Orthonormal shapes that hold every frame within `allowed` (m), from one part of the frames after
/// the other.
Eigen::MatrixXd spanning_shapes(const std::vector<PointsF>& frames, double allowed) {
  const auto n = static_cast<Index>(frames.size());
  Eigen::MatrixXd shapes(3 * frames.front().rows(), 0);
  Block part;
  for (Index first = 0; first < n; first += kFramesOfAPart) {
    const auto last = std::min(n, first + kFramesOfAPart);
    gather({frames.begin() + first, frames.begin() + last}, 0, frames.front().rows(), part);
    for (int again = 0; again < 2; ++again)  // what rounding leaves along them is taken out too
      part.noalias() -= shapes * (shapes.transpose() * part).eval();
    add_lacking(std::move(part), allowed, shapes);
  }
  return shapes;
}

/// Of many frames: through their courses along few shapes.
Eigen::MatrixXd right_vectors_of_many(const std::vector<PointsF>& frames, double tolerance) {
  const Eigen::MatrixXd shapes = spanning_shapes(frames, kSpanShare * tolerance);
  Eigen::MatrixXd course = Eigen::MatrixXd::Zero(shapes.cols(), static_cast<Index>(frames.size()));
  for_blocks(frames, [&](Index first, Index count, const Block& block) {
    course.noalias() += shapes.middleRows(3 * first, 3 * count).transpose() * block;
  });
  return right_vectors_of_wide(course);
}

/// Of the 3|V| x N matrix X of the frames, orthonormal, N x rank, through the smaller one of X^T X
/// and X X^T, or where both are large through shapes that leave nothing near the tolerance.
Eigen::MatrixXd right_singular_vectors(const std::vector<PointsF>& frames, double tolerance) {
  const auto n = static_cast<Index>(frames.size());
  const Index coordinates = 3 * frames.front().rows();
  if (std::min(n, coordinates) > kFramesAtOnce) return right_vectors_of_many(frames, tolerance);
  if (n <= coordinates) {
    Eigen::VectorXd values;
    Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(n, n);
    for_blocks(frames, [&](Index, Index, const Block& block) {
      gram.selfadjointView<Eigen::Lower>().rankUpdate(block.transpose());
    });
    return leading_eigenvectors(gram, values);
  }
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
