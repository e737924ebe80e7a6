// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/schwarz.hpp"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <span>

#include "hyperex/fem/solve/node_order.hpp"

namespace hyperex::fem {
namespace {

/// As in Cholesky: less is rounding, and the coarse motion has no stiffness.
constexpr double kLeastPivot = 1e-12;

using Places = tbb::enumerable_thread_specific<std::vector<int>>;

template <typename F>
void for_each_one(int count, F f) {
  tbb::parallel_for(tbb::blocked_range<int>(0, count, 1), [&](const auto& range) {
    for (int i = range.begin(); i < range.end(); ++i) f(i);
  });
}

/// The rows of three of `nodes`.
void scatter(const Columns& from, std::span<const int> nodes, Eigen::MatrixXd& to) {
  const Eigen::Index columns = from.cols();
  to.resize(3 * static_cast<Eigen::Index>(nodes.size()), columns);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const double* in = from.data() + (3 * static_cast<Eigen::Index>(nodes[i]) + axis) * columns;
      double* out = to.data() + 3 * i + axis;
      for (Eigen::Index c = 0; c < columns; ++c) out[c * to.rows()] = in[c];
    }
}

}  // namespace

Schwarz::Schwarz(const NodeBlocks& a, const Points& points, int subdomain_nodes,
                 const std::string& purpose)
    : subdomains_(overlapping_subdomains(a, points, subdomain_nodes)) {
  Lists entries;  // node of each entry, to be turned round
  entries.item = subdomains_.nodes.item;
  entries.start.resize(entries.item.size() + 1);
  for (std::size_t k = 0; k <= entries.item.size(); ++k) entries.start[k] = static_cast<int>(k);
  homes_ = transposed(entries, a.node_count());
  std::vector<int> place(a.node_count(), -1);
  local_.reserve(subdomain_count());
  int first = 0;
  for (int s = 0; s < subdomain_count(); ++s) {
    subdomain_of_.insert(subdomain_of_.end(), subdomains_.nodes[s].size(), s);
    const SparseMatrix lower = lower_of(a, s, place);
    std::vector<int> node_of(lower.cols());
    for (std::size_t c = 0; c < node_of.size(); ++c) node_of[c] = static_cast<int>(c / 3);
    // One after the other: METIS draws from a stream of random numbers that threads would share.
    local_.push_back({Cholesky(lower, purpose, order_by_nodes(lower, node_of).unknowns),
                      rigid_motions(a, points, s),
                      {},
                      {},
                      {},
                      first});
    first += static_cast<int>(local_.back().rigid.cols());
  }
  coarse_.resize(first, first);
}

/// `place`: -1 everywhere, before and after.
SparseMatrix Schwarz::lower_of(const NodeBlocks& a, int s, std::vector<int>& place) const {
  const auto nodes = subdomains_.nodes[s];
  const int count = static_cast<int>(nodes.size());
  for (int i = 0; i < count; ++i) place[nodes[i]] = i;
  SparseMatrix lower(3 * count, 3 * count);
  std::vector<int> inner;
  std::vector<double> value;
  for (int i = 0; i < count; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = a.row_start(nodes[i]); k < a.row_start(nodes[i] + 1); ++k) {
        const int other = place[a.columns()[k]];
        if (other < i) continue;
        for (int row = other == i ? axis : 0; row < 3; ++row) {
          inner.push_back(3 * other + row);
          value.push_back(a.block(k)[3 * axis + row]);  // symmetric
        }
      }
      lower.outerIndexPtr()[3 * i + axis + 1] = static_cast<int>(inner.size());
    }
  lower.resizeNonZeros(static_cast<Eigen::Index>(inner.size()));
  std::copy(inner.begin(), inner.end(), lower.innerIndexPtr());
  std::copy(value.begin(), value.end(), lower.valuePtr());
  for (const int n : nodes) place[n] = -1;
  return lower;
}

/// The rigid motions of a subdomain, weighted; an orthonormal choice of those that move it.
Eigen::MatrixXd Schwarz::rigid_motions(const NodeBlocks& a, const Points& points, int s) const {
  const auto nodes = subdomains_.nodes[s];
  const int from = subdomains_.nodes.start[s];
  const auto count = static_cast<Eigen::Index>(nodes.size());
  Vec3 centre = Vec3::Zero();
  for (const int n : nodes) centre += points.row(n).transpose() / static_cast<double>(count);
  double radius = 1e-300;
  for (const int n : nodes) radius = std::max(radius, (points.row(n).transpose() - centre).norm());
  Eigen::MatrixXd motions(3 * count, 6);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Vec3 x = (points.row(nodes[i]).transpose() - centre) / radius;
    Eigen::Matrix<double, 3, 6> block;
    block << 1, 0, 0, 0, x.z(), -x.y(),  //
        0, 1, 0, -x.z(), 0, x.x(),       //
        0, 0, 1, x.y(), -x.x(), 0;
    for (int axis = 0; axis < 3; ++axis)
      if (a.unknown()[3 * nodes[i] + axis] < 0) block.row(axis).setZero();
    motions.middleRows<3>(3 * i) = subdomains_.weight[from + i] * block;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> gram(motions.transpose() * motions);
  const double strongest = gram.eigenvalues()[5];
  int kept = 0;
  while (kept < 6 && gram.eigenvalues()[5 - kept] > 1e-8 * strongest) ++kept;
  return motions * gram.eigenvectors().rightCols(kept) *
         gram.eigenvalues().tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
}

/// A F_i, on all nodes that a node of subdomain i is coupled to.
void Schwarz::pull(const NodeBlocks& a, int s, std::vector<int>& place) {
  Local& local = local_[s];
  const auto nodes = subdomains_.nodes[s];
  for (std::size_t i = 0; i < nodes.size(); ++i) place[nodes[i]] = static_cast<int>(i);
  if (local.around.empty()) {
    for (const int n : nodes)
      for (int k = a.row_start(n); k < a.row_start(n + 1); ++k)
        local.around.push_back(a.columns()[k]);
    std::sort(local.around.begin(), local.around.end());
    local.around.erase(std::unique(local.around.begin(), local.around.end()), local.around.end());
  }
  local.pulled.setZero(3 * static_cast<Eigen::Index>(local.around.size()), local.rigid.cols());
  for (std::size_t i = 0; i < local.around.size(); ++i)
    for (int k = a.row_start(local.around[i]); k < a.row_start(local.around[i] + 1); ++k) {
      const int other = place[a.columns()[k]];
      if (other < 0) continue;
      const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> block(a.block(k));
      local.pulled.middleRows<3>(3 * static_cast<Eigen::Index>(i)).noalias() +=
          block * local.rigid.middleRows<3>(3 * other);
    }
  for (const int n : nodes) place[n] = -1;
}

int Schwarz::factorize(const NodeBlocks& a) {
  Places places(std::vector<int>(a.node_count(), -1));
  std::vector<int> lost(subdomain_count(), -1);
  for_each_one(subdomain_count(), [&](int s) {
    std::vector<int>& place = places.local();
    lost[s] = local_[s].cholesky.factorize(lower_of(a, s, place));
    pull(a, s, place);
  });
  for (int s = 0; s < subdomain_count(); ++s)
    if (lost[s] >= 0) return 3 * subdomains_.nodes[s][lost[s] / 3] + lost[s] % 3;
  return factorize_coarse(a);
}

int Schwarz::factorize_coarse(const NodeBlocks& a) {
  coarse_.setZero();
  Places places(std::vector<int>(a.node_count(), -1));
  for_each_one(subdomain_count(), [&](int s) {
    const Local& local = local_[s];
    std::vector<int>& place = places.local();
    for (std::size_t i = 0; i < local.around.size(); ++i)
      place[local.around[i]] = static_cast<int>(i);
    // Column block s of A_0: F_j^T (A F_s) of all j that meet it.
    for (int j = 0; j < subdomain_count(); ++j) {
      const auto nodes = subdomains_.nodes[j];
      const Eigen::MatrixXd& rigid = local_[j].rigid;
      Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(rigid.cols(), local.rigid.cols());
      for (std::size_t i = 0; i < nodes.size(); ++i)
        if (const int at = place[nodes[i]]; at >= 0)
          for (int axis = 0; axis < 3; ++axis)
            sum += rigid.row(3 * static_cast<Eigen::Index>(i) + axis)
                       .transpose()
                       .lazyProduct(local.pulled.row(3 * static_cast<Eigen::Index>(at) + axis));
      coarse_.block(local_[j].first, local.first, sum.rows(), sum.cols()) = sum;
    }
    for (const int n : local.around) place[n] = -1;
  });
  const Eigen::VectorXd diagonal = coarse_.diagonal();
  Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(coarse_);
  for (int s = 0; s < subdomain_count(); ++s)
    for (Eigen::Index k = local_[s].first; k < local_[s].first + local_[s].rigid.cols(); ++k)
      if (const double pivot = coarse_(k, k);
          llt.info() != Eigen::Success || !(pivot * pivot > kLeastPivot * diagonal[k]))
        return 3 * subdomains_.nodes[s][0];
  return -1;
}

/// z := or += the sum of what the subdomains hold in `x`.
void Schwarz::gather(Columns& z, bool add) const {
  const Eigen::Index columns = z.cols();
  tbb::parallel_for(tbb::blocked_range<int>(0, homes_.size(), 256), [&](const auto& range) {
    for (int n = range.begin(); n < range.end(); ++n)
      for (int axis = 0; axis < 3; ++axis) {
        double* const out = z.data() + (3 * static_cast<Eigen::Index>(n) + axis) * columns;
        if (!add) std::fill(out, out + columns, 0.0);
        for (const int entry : homes_[n]) {
          const int s = subdomain_of_[entry];
          const Eigen::MatrixXd& x = local_[s].x;
          const double* in = x.data() + 3 * (entry - subdomains_.nodes.start[s]) + axis;
          for (Eigen::Index c = 0; c < columns; ++c) out[c] += in[c * x.rows()];
        }
      }
  });
}

Eigen::MatrixXd Schwarz::coarse_solve(Eigen::MatrixXd c) const {
  coarse_.triangularView<Eigen::Lower>().solveInPlace(c);
  coarse_.transpose().triangularView<Eigen::Upper>().solveInPlace(c);
  return c;
}

/// z += F A_0^-1 c
void Schwarz::add_coarse(const Eigen::MatrixXd& c, Columns& z) {
  const Eigen::MatrixXd share = coarse_solve(c);
  for_each_one(subdomain_count(), [&](int s) {
    Local& local = local_[s];
    local.x.noalias() = local.rigid * share.middleRows(local.first, local.rigid.cols());
  });
  gather(z, true);
}

void Schwarz::start(const Columns& r, Columns& z) {
  Eigen::MatrixXd c(coarse_size(), r.cols());
  for_each_one(subdomain_count(), [&](int s) {
    Local& local = local_[s];
    scatter(r, subdomains_.nodes[s], local.x);
    c.middleRows(local.first, local.rigid.cols()).noalias() = local.rigid.transpose() * local.x;
  });
  z.setZero(r.rows(), r.cols());
  add_coarse(c, z);
}

void Schwarz::apply(const Columns& r, Columns& z) {
  Eigen::MatrixXd c(coarse_size(), r.cols());
  for_each_one(subdomain_count(), [&](int s) {
    Local& local = local_[s];
    scatter(r, subdomains_.nodes[s], local.x);
    c.middleRows(local.first, local.rigid.cols()).noalias() = local.rigid.transpose() * local.x;
    local.cholesky.solve(local.x);
  });
  z.resize(r.rows(), r.cols());
  gather(z, false);
  for_each_one(subdomain_count(), [&](int s) {
    Local& local = local_[s];
    scatter(z, local.around, local.x);
    c.middleRows(local.first, local.rigid.cols()).noalias() -= local.pulled.transpose() * local.x;
  });
  add_coarse(c, z);
}

double Schwarz::factor_entries() const {
  double entries = 0;
  for (const Local& local : local_) entries += local.cholesky.entries();
  return entries;
}

}  // namespace hyperex::fem
