// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/exaggerate.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

namespace hyperex::motion {

Motion with_point_gains(const Motion& motion, const std::vector<PointGain>& gains) {
  Motion out = motion;
  std::set<std::string> seen;
  for (const PointGain& one : gains) {
    const int row = motion.index_of(one.point);
    if (row < 0) refuse(motion, fmt::format("there is no point {}, which has a gain", one.point));
    if (!seen.insert(one.point).second)
      refuse(motion, fmt::format("point {} has two gains; expected one", one.point));
    if (!(one.gain >= 0) || !std::isfinite(one.gain))
      refuse(motion, fmt::format("the gain of point {} is {:g}; expected a number of 0 or more",
                                 one.point, one.gain));
    const Eigen::RowVector3d rest = motion.positions.front().row(row);
    if (!rest.allFinite())
      refuse(motion,
             fmt::format("point {} has a gain and is not measured in the first sample", one.point));
    for (Points& sample : out.positions)
      sample.row(row) = (rest + one.gain * (sample.row(row) - rest)).eval();
  }
  return out;
}

Motion time_scaled(const Motion& motion, double scale) {
  if (!(scale > 0) || !std::isfinite(scale))
    refuse(motion, fmt::format("the scale of time is {:g}; expected a number above 0", scale));
  Motion out = motion;
  out.smooth_up_to_s *= scale;
  for (double& t : out.time_s) t = motion.time_s.front() + scale * (t - motion.time_s.front());
  return out;
}

}  // namespace hyperex::motion
