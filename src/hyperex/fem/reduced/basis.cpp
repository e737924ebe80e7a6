// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/reduced/basis.hpp"

#include <algorithm>

#include "hyperex/core/assert.hpp"
#include "hyperex/core/symmetric_modes.hpp"

namespace hyperex::fem {
namespace {
/// The least number of directions added each time the basis grows. They are added even if each
/// contributes only a hundredth of the tolerance; smaller contributions may be rounding. The error
/// is estimated from how much the last growth changed the motion. When the basis converges slowly,
/// one or two directions change it by less than the remaining error, and the estimate would be too
/// small.
constexpr Eigen::Index kAtLeast = 6;
}  // namespace

Basis::Grown Basis::grow(Eigen::MatrixXd w, double least) {
  const Eigen::Index shapes = w.cols();
  return grow(std::move(w), Eigen::MatrixXd::Identity(shapes, shapes), least);
}

Basis::Grown Basis::grow(Eigen::MatrixXd w, const Eigen::MatrixXd& mix, double least) {
  HX_ASSERT(mix.rows() == w.cols());
  if (w.cols() == 0) return {};  // no eigenvalues exist
  // Gram-Schmidt loses digits if a column lies nearly in the basis; a second pass is sufficient.
  for (int pass = 0; pass < 2 && size_ > 0; ++pass)
    add_product(vectors(), inner_products(k_vectors(), w), -1, w);
  const Eigen::MatrixXd kw = symmetric_product(system_.stiffness, w);
  Eigen::MatrixXd gram = inner_products(w, kw);
  gram = (gram + gram.transpose()).eval() / 2;
  const SymmetricModes modes = symmetric_modes(gram);
  const Eigen::Index n = w.cols();
  const double strongest = modes.values[n - 1];
  Eigen::MatrixXd directions = Eigen::MatrixXd::Zero(w.rows(), n);
  add_product(w, modes.vectors, 1, directions);
  // Shape j = sum_i u_i sqrt(lambda_i) S_ij with u_i = w Q_i / sqrt(lambda_i) and S = Q^T mix.
  const Eigen::MatrixXd shares = modes.vectors.transpose() * mix;
  Eigen::MatrixXd pick(n, 0);
  Grown grown;
  for (Eigen::Index i = n - 1; i >= 0; --i) {
    const double lambda = modes.values[i];
    // Smaller squared values are rounding errors, and so are the directions.
    if (!(lambda > 1e-13 * strongest) || !(lambda > 0)) break;
    const double moves =
        directions.col(i).cwiseAbs().maxCoeff() * shares.row(i).cwiseAbs().maxCoeff();
    if (moves < (pick.cols() < kAtLeast ? 0.01 * least : least)) {
      grown.skipped += moves;
      continue;
    }
    pick.conservativeResize(Eigen::NoChange, pick.cols() + 1);
    pick.col(pick.cols() - 1) = modes.vectors.col(i) / std::sqrt(lambda);
  }
  grown.taken = static_cast<int>(pick.cols());
  if (grown.taken == 0) return grown;
  Eigen::MatrixXd more = Eigen::MatrixXd::Zero(w.rows(), pick.cols());
  Eigen::MatrixXd k_more = more;
  add_product(w, pick, 1, more);
  add_product(kw, pick, 1, k_more);
  append(more, k_more);
  return grown;
}

void Basis::append(const Eigen::MatrixXd& more, const Eigen::MatrixXd& k_more) {
  const Eigen::Index rows = more.rows(), old = size_, size = old + more.cols();
  if (size > vectors_.cols()) {
    const Eigen::Index capacity = std::max(size, 2 * vectors_.cols());
    for (Eigen::MatrixXd* part : {&vectors_, &k_, &c_, &m_})
      part->conservativeResize(rows, capacity);
  }
  vectors_.middleCols(old, more.cols()) = more;
  k_.middleCols(old, more.cols()) = k_more;
  c_.middleCols(old, more.cols()) = symmetric_product(system_.damping, more);
  m_.middleCols(old, more.cols()) = symmetric_product(system_.mass, more);
  size_ = static_cast<int>(size);
  const auto project = [&](const Eigen::MatrixXd& applied, Eigen::MatrixXd& projected) {
    const Eigen::MatrixXd columns = inner_products(vectors(), applied.middleCols(old, more.cols()));
    projected.conservativeResize(size, size);
    projected.rightCols(more.cols()) = columns;
    projected.bottomLeftCorner(more.cols(), old) = columns.topRows(old).transpose();
  };
  project(k_, stiffness_);
  project(c_, damping_);
  project(m_, mass_);
}

}  // namespace hyperex::fem
