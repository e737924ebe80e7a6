// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/rbf.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace hyperex {
namespace {

struct Data {
  Points centres, values;
};

// Each point joins the first group whose first member is within the distance.
Data merged(const Points& centres, const Points& values, double distance) {
  std::vector<Eigen::Index> first;
  std::vector<int> group(centres.rows()), count;
  for (Eigen::Index i = 0; i < centres.rows(); ++i) {
    size_t g = 0;
    while (g < first.size() && (centres.row(first[g]) - centres.row(i)).norm() > distance) ++g;
    if (g == first.size()) {
      first.push_back(i);
      count.push_back(0);
    }
    group[i] = static_cast<int>(g);
    ++count[g];
  }
  Data data{Points::Zero(first.size(), 3), Points::Zero(first.size(), 3)};
  for (Eigen::Index i = 0; i < centres.rows(); ++i) {
    data.centres.row(group[i]) += centres.row(i) / count[group[i]];
    data.values.row(group[i]) += values.row(i) / count[group[i]];
  }
  return data;
}

void check_centres(const Points& centres, const Points& values, const RbfOptions& options) {
  if (centres.rows() == 0) throw std::invalid_argument("radial basis: no centres");
  if (centres.rows() != values.rows())
    throw std::invalid_argument("radial basis: as many values as centres are needed");
  if (!centres.allFinite() || !values.allFinite())
    throw std::invalid_argument("radial basis: a centre or a value is not finite");
  if (!(options.smoothing >= 0)) throw std::invalid_argument("radial basis: smoothing below zero");
}

}  // namespace

Rbf::Rbf(const Points& centres, const Points& values, const RbfOptions& options) {
  check_centres(centres, values, options);
  const Data data = merged(centres, values, options.merge_distance);
  centres_ = data.centres;
  origin_ = centres_.colwise().mean().transpose();
  const Eigen::Index n = centres_.rows();
  const int terms = options.polynomial == RbfPolynomial::affine ? 4 : 1;
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + terms, n + terms);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < i; ++j)
      system(i, j) = system(j, i) = (centres_.row(i) - centres_.row(j)).norm();
    // On the subspace left by the constraint, the kernel matrix is negative definite, so the ridge
    // is negative.
    system(i, i) = -options.smoothing;
    system(i, n) = system(n, i) = 1;
    for (int axis = 0; axis + 1 < terms; ++axis)
      system(i, n + 1 + axis) = system(n + 1 + axis, i) = centres_(i, axis) - origin_[axis];
  }
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n + terms, 3);
  right.topRows(n) = data.values;
  // The affine columns are linearly dependent if the centres lie in a plane or on a line, or
  // coincide.
  const Eigen::MatrixXd solution =
      terms == 1 ? Eigen::MatrixXd(system.partialPivLu().solve(right))
                 : Eigen::MatrixXd(system.completeOrthogonalDecomposition().solve(right));
  weights_ = solution.topRows(n);
  polynomial_.setZero();
  polynomial_.topRows(terms) = solution.bottomRows(terms);
}

Vec3 Rbf::at(const Vec3& x) const {
  Eigen::RowVector3d sum = polynomial_.row(0);
  sum += (x - origin_).transpose() * polynomial_.bottomRows<3>();
  for (Eigen::Index i = 0; i < centres_.rows(); ++i)
    sum += (centres_.row(i) - x.transpose()).norm() * weights_.row(i);
  return sum.transpose();
}

Points Rbf::at_all(const Points& x) const {
  Points values(x.rows(), 3);
  tbb::parallel_for(Eigen::Index{0}, x.rows(), [&](Eigen::Index row) {
    values.row(row) = at(Vec3(x.row(row).transpose())).transpose();
  });
  return values;
}

Eigen::MatrixXd rbf_weights(const Points& centres, Eigen::Index moving, const Points& places) {
  Eigen::MatrixXd all(places.rows(), moving);
  // Three centres at a time, with a unit value on one axis each.
  for (Eigen::Index first = 0; first < moving; first += 3) {
    const Eigen::Index count = std::min<Eigen::Index>(3, moving - first);
    Points unit = Points::Zero(centres.rows(), 3);
    for (Eigen::Index k = 0; k < count; ++k) unit(first + k, k) = 1;
    all.middleCols(first, count) = Rbf(centres, unit).at_all(places).leftCols(count);
  }
  return all;
}

}  // namespace hyperex
