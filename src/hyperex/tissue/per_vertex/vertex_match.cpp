// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/per_vertex/vertex_match.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "hyperex/core/error.hpp"
#include "hyperex/geometry/transform.hpp"

namespace hyperex::tissue {
namespace {

/// Vertices of one place differ by rounding alone: this share of the box's diagonal.
constexpr double kOnePlace = 1e-6;

struct Box {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  void add(const Vec3& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  double diagonal() const { return (high - low).norm(); }
  Vec3 centre() const { return (low + high) / 2; }
};

/// The bounding box of the vertices marked by `used`, or of all vertices if it is empty.
Box box_of(const Points& points, const std::vector<char>& used = {}) {
  Box box;
  for (Eigen::Index v = 0; v < points.rows(); ++v)
    if (used.empty() || used[v]) box.add(points.row(v).transpose());
  return box;
}

/// The turns that carry axes into axes, that which leaves them first.
std::vector<Eigen::Matrix3d> turns() {
  std::vector<Eigen::Matrix3d> found;
  std::array<int, 3> axis{0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
      for (int k = 0; k < 3; ++k) turn(k, axis[k]) = (signs >> k & 1) ? -1 : 1;
      if (turn.determinant() > 0) found.push_back(turn);
    }
  } while (std::next_permutation(axis.begin(), axis.end()));
  return found;
}

/// Points in the order of x, for nearest ones within a short reach.
class Sorted {
 public:
  explicit Sorted(const Points& points) : points_(points), order_(points.rows()) {
    std::iota(order_.begin(), order_.end(), 0);
    std::stable_sort(order_.begin(), order_.end(),
                     [&](int a, int b) { return points(a, 0) < points(b, 0); });
  }

  /// Calls use(row, distance) for each point within `reach` of `p`.
  template <class Use>
  void within(const Vec3& p, double reach, Use use) const {
    auto at = std::lower_bound(order_.begin(), order_.end(), p.x() - reach,
                               [&](int row, double x) { return points_(row, 0) < x; });
    for (; at != order_.end() && points_(*at, 0) <= p.x() + reach; ++at)
      if (const double d = (points_.row(*at).transpose() - p).norm(); d <= reach) use(*at, d);
  }

 private:
  const Points& points_;
  std::vector<int> order_;
};

/// Empty where there are no triangles.
std::vector<char> used_vertices(const TriMesh& mesh) {
  if (mesh.triangles.rows() == 0) return {};
  std::vector<char> used(mesh.points.rows(), 0);
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      if (mesh.triangles(f, k) < mesh.points.rows()) used[mesh.triangles(f, k)] = 1;
  return used;
}

double nearest_distance(const Points& points, const Vec3& p) {
  return std::sqrt((points.rowwise() - p.transpose()).rowwise().squaredNorm().minCoeff());
}

}  // namespace

double VertexMatch::tolerance(const Points& scan) {
  return 1e-4 * box_of(scan).diagonal();
}

VertexMatch::VertexMatch(const std::filesystem::path& file, const TriMesh& own,
                         const TriMesh& scan) {
  const Points& at = own.points;
  if (at.rows() < 3 || !at.allFinite())
    throw InputError(
        file, fmt::format("{} vertices with finite places: expected those of the scan", at.rows()));
  const double reach = tolerance(scan.points);
  if (at.rows() == scan.points.rows() && box_of(at).diagonal() > 0) {
    const Points laid = fit_similarity(at, scan.points).apply(at);
    if ((laid - scan.points).rowwise().norm().maxCoeff() <= reach) {
      same_order_ = true;
      return;
    }
  }
  if (by_place(own, scan)) return;
  // In the words of the likeliest case: the file's own axes, its box laid on the scan's.
  const Box from = box_of(at), to = box_of(scan.points);
  const double scale = from.diagonal() > 0 ? to.diagonal() / from.diagonal() : 1;
  const Points laid =
      ((at.rowwise() - from.centre().transpose()) * scale).rowwise() + to.centre().transpose();
  const Sorted sorted(laid);
  Eigen::Index apart = 0, first = -1;
  for (Eigen::Index v = 0; v < scan.points.rows(); ++v) {
    bool found = false;
    sorted.within(scan.points.row(v), reach, [&](int, double) { found = true; });
    if (!found && apart++ == 0) first = v;
  }
  throw InputError(
      file,
      fmt::format("{} of the scan's {} vertices have none of this file's {} at their place (vertex "
                  "{}, counted from 0, is {:.2g} mm from the nearest after alignment of the "
                  "bounding boxes): expected the scan itself with unmoved vertices; their order, "
                  "unit and axes do not matter",
                  apart, scan.points.rows(), at.rows(), first,
                  first < 0 ? 0 : 1e3 * nearest_distance(laid, scan.points.row(first))));
}

bool VertexMatch::by_place(const TriMesh& own, const TriMesh& scan) {
  const std::vector<char> used = used_vertices(scan), own_used = used_vertices(own);
  const Box to = box_of(scan.points, used);
  const double reach = tolerance(scan.points), one_place = kOnePlace * to.diagonal();
  for (const Eigen::Matrix3d& turn : turns()) {
    const Points turned = own.points * turn.transpose();
    const Box from = box_of(turned, own_used);
    if (!(from.diagonal() > 0)) return false;
    const double scale = to.diagonal() / from.diagonal();
    const Vec3 sides = scale * (from.high - from.low) - (to.high - to.low);
    if (sides.cwiseAbs().maxCoeff() > 2 * reach) continue;
    const Points laid = ((turned.rowwise() - from.centre().transpose()) * scale).rowwise() +
                        to.centre().transpose();
    const Sorted sorted(laid);
    end_.clear();
    row_.clear();
    bool all = true;
    for (Eigen::Index v = 0; v < scan.points.rows() && all; ++v) {
      const Vec3 p = scan.points.row(v).transpose();
      double nearest = std::numeric_limits<double>::infinity();
      sorted.within(p, reach, [&](int, double d) { nearest = std::min(nearest, d); });
      all = std::isfinite(nearest) || (!used.empty() && !used[v]);
      if (std::isfinite(nearest))
        sorted.within(p, std::min(nearest + one_place, reach),
                      [&](int row, double) { row_.push_back(row); });
      end_.push_back(row_.size());
    }
    if (all) return true;
  }
  return false;
}

Eigen::VectorXd VertexMatch::on_scan(const Eigen::VectorXd& of_file, double otherwise) const {
  if (same_order_) return of_file;
  Eigen::VectorXd out(Eigen::Index(end_.size()));
  std::size_t i = 0;
  for (Eigen::Index v = 0; v < out.size(); ++v) {
    double sum = 0;
    int count = 0, places = 0;
    for (; i < end_[v]; ++i, ++places)
      if (const double value = of_file[row_[i]]; !std::isnan(value)) {
        sum += value;
        ++count;
      }
    out[v] = count > 0    ? sum / count
             : places > 0 ? std::numeric_limits<double>::quiet_NaN()
                          : otherwise;
  }
  return out;
}

Eigen::Index VertexMatch::disagreements(const Eigen::VectorXd& of_file) const {
  Eigen::Index found = 0;
  std::size_t i = 0;
  for (const std::size_t end : end_) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (; i < end; ++i) {
      low = std::min(low, of_file[row_[i]]);
      high = std::max(high, of_file[row_[i]]);
    }
    found += high - low > 1e-3 * std::max(std::abs(high), std::abs(low));
  }
  return found;
}

}  // namespace hyperex::tissue
