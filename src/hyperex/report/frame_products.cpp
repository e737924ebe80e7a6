// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/frame_products.hpp"

#include <cblas.h>

#include <cmath>

#include "hyperex/core/one_thread.hpp"
#include "hyperex/core/symmetric_modes.hpp"

namespace hyperex::report {

using Eigen::Index;

void gather(const std::vector<PointsF>& frames, Index first, Index count, Eigen::MatrixXd& block) {
  block.resize(3 * count, static_cast<Index>(frames.size()));
  for (Index f = 0; f < block.cols(); ++f)
    block.col(f) =
        Eigen::Map<const Eigen::VectorXf>(frames[std::size_t(f)].data() + 3 * first, 3 * count)
            .cast<double>();
}

Eigen::MatrixXd frame_products(const std::vector<PointsF>& frames) {
  keep_blas_to_one_thread();
  const auto n = static_cast<Index>(frames.size());
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(n, n);
  for_blocks(frames, [&](Index, Index, const Eigen::MatrixXd& block) {
    cblas_dsyrk(CblasColMajor, CblasLower, CblasTrans, int(n), int(block.rows()), 1, block.data(),
                int(block.rows()), 1, products.data(), int(n));
  });
  return products;
}

Eigen::MatrixXd leading_eigenvectors(const Eigen::MatrixXd& gram, Eigen::VectorXd& values) {
  values.resize(0);
  if (gram.rows() == 0) return gram;  // of a face that does not move
  const SymmetricModes eigen = symmetric_modes(gram);
  values = eigen.values.reverse();
  const Index rank = (values.array() > 1e-15 * values[0]).count() * (values[0] > 0);
  values.conservativeResize(rank);
  return eigen.vectors.rowwise().reverse().leftCols(rank);
}

double largest_row_error(const Eigen::MatrixXd& residual) {
  const Eigen::Map<const Eigen::Matrix<double, 3, Eigen::Dynamic>> vertices(residual.data(), 3,
                                                                            residual.size() / 3);
  return vertices.size() == 0 ? 0. : std::sqrt(vertices.colwise().squaredNorm().maxCoeff());
}

namespace {

constexpr Index kFramesOfAPart = 128;

/// Adds to the orthonormal `shapes` what they lack for these frames, whose `rest` they leave.
void add_lacking(Eigen::MatrixXd rest, double allowed, Eigen::MatrixXd& shapes) {
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
  Eigen::MatrixXd part;
  for (Index first = 0; first < n; first += kFramesOfAPart) {
    const auto last = std::min(n, first + kFramesOfAPart);
    gather({frames.begin() + first, frames.begin() + last}, 0, frames.front().rows(), part);
    for (int again = 0; again < 2; ++again)  // what rounding leaves along them is taken out too
      part.noalias() -= shapes * (shapes.transpose() * part).eval();
    add_lacking(std::move(part), allowed, shapes);
  }
  return shapes;
}

}  // namespace

Eigen::MatrixXd courses_along_few_shapes(const std::vector<PointsF>& frames, double allowed_m) {
  const Eigen::MatrixXd shapes = spanning_shapes(frames, allowed_m);
  Eigen::MatrixXd courses = Eigen::MatrixXd::Zero(shapes.cols(), Index(frames.size()));
  for_blocks(frames, [&](Index first, Index count, const Eigen::MatrixXd& block) {
    courses.noalias() += shapes.middleRows(3 * first, 3 * count).transpose() * block;
  });
  return courses;
}

Eigen::MatrixXd frame_coordinates(const std::vector<PointsF>& frames, double allowed_m) {
  const auto n = Index(frames.size());
  if (n == 0) return {};
  const Index coordinates = 3 * frames.front().rows();
  if (std::min(n, coordinates) > kFramesAtOnce)
    return courses_along_few_shapes(frames, allowed_m).transpose();
  if (n > coordinates) {
    Eigen::MatrixXd all;
    gather(frames, 0, frames.front().rows(), all);
    return all.transpose();
  }
  Eigen::VectorXd squares;
  const Eigen::MatrixXd vectors = leading_eigenvectors(frame_products(frames), squares);
  return vectors * squares.cwiseSqrt().asDiagonal();
}

}  // namespace hyperex::report
