// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/motion.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hyperex/core/assert.hpp"
#include "hyperex/core/error.hpp"

namespace hyperex::motion {

int Motion::index_of(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : int(found - names.begin());
}

Points Motion::at(double t) const {
  HX_ASSERT(!time_s.empty() && time_s.size() == positions.size());
  if (t <= time_s.front()) return positions.front();
  if (t >= time_s.back()) return positions.back();
  const std::size_t next = std::upper_bound(time_s.begin(), time_s.end(), t) - time_s.begin();
  const double share = (t - time_s[next - 1]) / (time_s[next] - time_s[next - 1]);
  return (1 - share) * positions[next - 1] + share * positions[next];
}

Motion until(Motion motion, double end_s, const std::string& option) {
  const auto end = std::upper_bound(motion.time_s.begin(), motion.time_s.end(), end_s);
  const auto kept = std::size_t(end - motion.time_s.begin());
  if (kept < 2)
    throw InputError(InputProblem{
        motion.source, 0, option, fmt::format("{:g}", end_s),
        fmt::format("at least the second sample's time, {:g} s",
                    motion.time_s[std::min<std::size_t>(1, motion.time_s.size() - 1)])});
  motion.time_s.resize(kept);
  motion.positions.resize(kept);
  if (!motion.lines.empty()) motion.lines.resize(kept);
  if (!motion.head_pose.empty()) motion.head_pose.resize(kept);
  return motion;
}

std::string named(const Motion& motion) {
  return motion.source.empty() ? "motion" : motion.source;
}

void refuse(const Motion& motion, const std::string& message) {
  throw InputError(named(motion), message);
}

}  // namespace hyperex::motion
