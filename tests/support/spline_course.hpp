// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Smooth courses over time, like an input recorded at some rate: C2 cubic splines whose third
// derivative jumps at the knots. They are computed by B-splines, unlike in the program.
#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <vector>

#include "hyperex/fem/time/drive.hpp"

namespace hyperex::test {

struct SplineCourse {
  double knot_s = 1;
  std::vector<double> weight;  ///< of the B-spline centred on knot k - 1

  /// (s, s', s'') at a time t in [0, end_s()].
  Eigen::Vector3d at(double t) const {
    const double x = t / knot_s;
    const auto k = std::min(static_cast<std::size_t>(x), weight.size() - 4);
    const double u = x - static_cast<double>(k), w = 1 - u;
    const double value[4] = {w * w * w / 6, (3 * u * u * u - 6 * u * u + 4) / 6,
                             (3 * w * w * w - 6 * w * w + 4) / 6, u * u * u / 6};
    const double slope[4] = {-w * w / 2, (9 * u * u - 12 * u) / 6, -(9 * w * w - 12 * w) / 6,
                             u * u / 2};
    const double bend[4] = {w, 3 * u - 2, 3 * w - 2, u};
    Eigen::Vector3d s = Eigen::Vector3d::Zero();
    for (int i = 0; i < 4; ++i)
      s += weight[k + i] * Eigen::Vector3d(value[i], slope[i] / knot_s, bend[i] / knot_s / knot_s);
    return s;
  }
  double end_s() const { return static_cast<double>(weight.size() - 3) * knot_s; }

  /// A course that starts at rest (s = s' = 0; s'' is arbitrary) and then varies at random within
  /// about +-1.
  static SplineCourse random(double knot_s, int knots, unsigned seed) {
    std::mt19937 random(seed);
    SplineCourse course{knot_s, {}};
    for (int k = 0; k < knots + 3; ++k)
      course.weight.push_back(2.0 * random() / static_cast<double>(std::mt19937::max()) - 1);
    course.weight[0] = course.weight[2];
    course.weight[1] = -course.weight[2] / 2;
    return course;
  }
};

/// Every course with its derivatives at steps of `dt_s`.
inline void set_courses(const std::vector<SplineCourse>& courses, double dt_s, int steps,
                        fem::Drive& drive) {
  drive.s.resize(static_cast<Eigen::Index>(courses.size()), steps + 1);
  drive.rate = drive.second = drive.s;
  for (Eigen::Index r = 0; r < drive.s.rows(); ++r)
    for (int k = 0; k <= steps; ++k) {
      const Eigen::Vector3d s = courses[static_cast<std::size_t>(r)].at(k * dt_s);
      drive.s(r, k) = s[0];
      drive.rate(r, k) = s[1];
      drive.second(r, k) = s[2];
    }
}

}  // namespace hyperex::test
