// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/motion.hpp"

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

std::string named(const Motion& motion) {
  return motion.source.empty() ? "motion" : motion.source;
}

void refuse(const Motion& motion, const std::string& message) {
  throw InputError(named(motion), message);
}

}  // namespace hyperex::motion
