// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <algorithm>
#include <vector>

namespace hyperex::simulate {

/// Three numbers per node over time, linear between samples and constant after the last.
struct NodalCourse {
  std::vector<int> nodes;
  std::vector<double> time_s;          ///< rising
  std::vector<Eigen::VectorXd> value;  ///< per sample, 3 |nodes|

  void take(double at_s, const Eigen::VectorXd& v) {
    time_s.push_back(at_s);
    value.push_back(v);
  }
  /// Needs at least one sample.
  void at(double t_s, Eigen::VectorXd& out) const {
    const auto after = std::upper_bound(time_s.begin(), time_s.end(), t_s) - time_s.begin();
    const auto to = std::min(std::size_t(after), time_s.size() - 1);
    const auto from = after > 0 ? std::size_t(after - 1) : 0;
    const double way = time_s[to] - time_s[from];
    const double share = way > 0 ? std::clamp((t_s - time_s[from]) / way, 0.0, 1.0) : 0;
    out = (1 - share) * value[from] + share * value[to];
  }
};

}  // namespace hyperex::simulate
