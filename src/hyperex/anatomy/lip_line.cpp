// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/lip_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "hyperex/core/assert.hpp"

namespace hyperex::anatomy {

namespace {

constexpr double kPixel = 0.0004;
constexpr double kReach = 0.008;          // of the path about the guess
constexpr double kCreaseArm = 0.0015;     // of the second difference
constexpr double kSmoothing = 0.0006;     // standard deviation of the Gaussian over the heights
constexpr double kLeastCrease = 0.00015;  // several times a scanner's noise after smoothing
// Costs of a step by one pixel up or down, and of a distance of one pixel from the guess, in metres
// of crease depth.
constexpr double kStepCost = 0.00004, kDistanceCost = 0.00001;

/// Heights over the frontal plane: rows along v (up), columns along u (to the subject's left).
struct HeightMap {
  double u0 = 0, v0 = 0;
  Eigen::MatrixXd height;  // minus infinity where the scan has nothing
};

void draw_triangle(const Points& corners, HeightMap& map) {
  const Vec3 a = corners.row(0), b = corners.row(1), c = corners.row(2);
  const double area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  if (std::abs(area) < 1e-16) return;
  const auto range = [](double low, double high, double origin, Eigen::Index count) {
    return std::pair{std::max(0L, long(std::ceil((low - origin) / kPixel))),
                     std::min(long(count) - 1, long(std::floor((high - origin) / kPixel)))};
  };
  const auto [u_first, u_last] =
      range(corners.col(0).minCoeff(), corners.col(0).maxCoeff(), map.u0, map.height.cols());
  const auto [v_first, v_last] =
      range(corners.col(1).minCoeff(), corners.col(1).maxCoeff(), map.v0, map.height.rows());
  for (long row = v_first; row <= v_last; ++row)
    for (long column = u_first; column <= u_last; ++column) {
      const double u = map.u0 + double(column) * kPixel, v = map.v0 + double(row) * kPixel;
      const double wb = ((u - a.x()) * (c.y() - a.y()) - (v - a.y()) * (c.x() - a.x())) / area;
      const double wc = ((b.x() - a.x()) * (v - a.y()) - (b.y() - a.y()) * (u - a.x())) / area;
      if (wb < -1e-9 || wc < -1e-9 || wb + wc > 1 + 1e-9) continue;
      double& height = map.height(row, column);
      height = std::max(height, a.z() + wb * (b.z() - a.z()) + wc * (c.z() - a.z()));
    }
}

HeightMap height_map(const Points& points, const Triangles& triangles, const Points& guess) {
  const double margin = kReach + kCreaseArm + 4 * kSmoothing;
  HeightMap map;
  map.u0 = guess.col(0).minCoeff();
  map.v0 = guess.col(1).minCoeff() - margin;
  const auto count = [](double length) { return Eigen::Index(std::ceil(length / kPixel)) + 1; };
  map.height.setConstant(count(guess.col(1).maxCoeff() + margin - map.v0),
                         count(guess.col(0).maxCoeff() - map.u0),
                         -std::numeric_limits<double>::infinity());
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    Points corners(3, 3);
    for (int c = 0; c < 3; ++c) corners.row(c) = points.row(triangles(f, c));
    draw_triangle(corners, map);
  }
  return map;
}

/// Pixels without surface (between lips a little apart) become as deep as the lowest around them.
void close_holes(Eigen::MatrixXd& height) {
  for (Eigen::Index c = 0; c < height.cols(); ++c)
    for (Eigen::Index r = 0; r < height.rows(); ++r) {
      if (std::isfinite(height(r, c))) continue;
      Eigen::Index last = r;
      while (last + 1 < height.rows() && !std::isfinite(height(last + 1, c))) ++last;
      const double below =
          r > 0 ? height(r - 1, c) : height(std::min(last + 1, height.rows() - 1), c);
      const double above = last + 1 < height.rows() ? height(last + 1, c) : below;
      const double deep = std::min(below, above) - kCreaseArm;
      for (; r <= last; ++r) height(r, c) = deep;
    }
}

Eigen::MatrixXd smoothed_height(const Eigen::MatrixXd& height) {
  const int reach = int(std::ceil(3 * kSmoothing / kPixel));
  Eigen::VectorXd kernel(2 * reach + 1);
  for (int i = -reach; i <= reach; ++i)
    kernel(i + reach) = std::exp(-0.5 * std::pow(i * kPixel / kSmoothing, 2));
  kernel /= kernel.sum();
  const auto along = [&](const Eigen::MatrixXd& from) {
    Eigen::MatrixXd to = Eigen::MatrixXd::Zero(from.rows(), from.cols());
    for (int i = -reach; i <= reach; ++i)
      for (Eigen::Index r = 0; r < from.rows(); ++r)
        to.row(r) +=
            kernel(i + reach) * from.row(std::clamp<Eigen::Index>(r + i, 0, from.rows() - 1));
    return to;
  };
  return along(along(height).transpose()).transpose();
}

/// v of a polyline at u (its first crossing); the nearer end's outside.
double v_at(const Points& line, double u) {
  for (Eigen::Index i = 0; i + 1 < line.rows(); ++i) {
    const double a = line(i, 0), b = line(i + 1, 0);
    if (u >= a && u <= b && b > a)
      return line(i, 1) + (u - a) / (b - a) * (line(i + 1, 1) - line(i, 1));
  }
  return u < line(0, 0) ? line(0, 1) : line(line.rows() - 1, 1);
}

/// The row of each column on the path of least cost that begins and ends at the guess.
std::vector<int> best_path(const Eigen::MatrixXd& crease, const std::vector<double>& guess_row) {
  const int rows = int(crease.rows()), columns = int(crease.cols());
  const double far = std::numeric_limits<double>::infinity();
  Eigen::MatrixXd cost = Eigen::MatrixXd::Constant(rows, columns, far);
  Eigen::MatrixXi from = Eigen::MatrixXi::Zero(rows, columns);
  constexpr int kSteepest = 2;  // pixels up or down a column
  for (int c = 0; c < columns; ++c) {
    const double to_end = std::min(c, columns - 1 - c);
    const double reach = std::min(kReach / kPixel, 1 + to_end);
    for (int r = 0; r < rows; ++r) {
      const double away = std::abs(r - guess_row[std::size_t(c)]);
      if (away > reach) continue;
      double before = c == 0 ? 0 : far;
      for (int step = -kSteepest; c > 0 && step <= kSteepest; ++step) {
        const int row = r + step;
        if (row < 0 || row >= rows) continue;
        const double sum = cost(row, c - 1) + kStepCost * step * step;
        if (sum < before) {
          before = sum;
          from(r, c) = row;
        }
      }
      cost(r, c) = before - crease(r, c) + kDistanceCost * away;
    }
  }
  std::vector<int> path(std::size_t(columns), 0);
  Eigen::Index last = 0;
  if (!std::isfinite(cost.col(columns - 1).minCoeff(&last))) return {};
  path.back() = int(last);
  for (int c = columns - 1; c > 0; --c) path[std::size_t(c - 1)] = from(path[std::size_t(c)], c);
  return path;
}

}  // namespace

std::optional<LipLine> find_lip_line(const TriMesh& scan, const Points& guess,
                                     const Eigen::Matrix3d& scan_from_face) {
  HX_ASSERT(guess.rows() >= 2);
  const Points points = scan.points * scan_from_face, line = guess * scan_from_face;
  HeightMap map = height_map(points, scan.triangles, line);
  if (map.height.cols() < 20) return {};
  for (Eigen::Index c = 0; c < map.height.cols(); ++c)
    if (!(map.height.col(c).maxCoeff() > -std::numeric_limits<double>::infinity())) return {};
  const Eigen::MatrixXd foremost = map.height;
  close_holes(map.height);
  map.height = smoothed_height(map.height);
  const Eigen::Index arm = Eigen::Index(std::lround(kCreaseArm / kPixel)), rows = map.height.rows();
  Eigen::MatrixXd crease = Eigen::MatrixXd::Zero(rows, map.height.cols());
  for (Eigen::Index r = arm; r + arm < rows; ++r)
    crease.row(r) = 0.5 * (map.height.row(r + arm) + map.height.row(r - arm)) - map.height.row(r);

  std::vector<double> guess_row;
  for (Eigen::Index c = 0; c < crease.cols(); ++c)
    guess_row.push_back((v_at(line, map.u0 + double(c) * kPixel) - map.v0) / kPixel);
  const std::vector<int> path = best_path(crease, guess_row);
  if (path.empty()) return {};
  LipLine found;
  found.points.resize(Eigen::Index(path.size()), 3);
  for (Eigen::Index c = 0; c < found.points.rows(); ++c) {
    const int r = path[std::size_t(c)];
    const double height = std::isfinite(foremost(r, c)) ? foremost(r, c) : map.height(r, c);
    found.points.row(c) << map.u0 + double(c) * kPixel, map.v0 + r * kPixel, height;
    found.crease_m += crease(r, c) / double(path.size());
  }
  if (found.crease_m < kLeastCrease) return {};
  found.points = found.points * scan_from_face.transpose();
  return found;
}

}  // namespace hyperex::anatomy
