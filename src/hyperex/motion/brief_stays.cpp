// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/brief_stays.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "hyperex/core/lower_case.hpp"
#include "hyperex/face/same_place.hpp"
#include "hyperex/motion/point_steps.hpp"
#include "hyperex/motion/wild_samples.hpp"

namespace hyperex::motion {
namespace {

/// The point with which this one exchanges its place; -1 where there is none.
Eigen::Index exchanged_with(const std::vector<Points>& at, const BriefStay& brief) {
  const auto& [before, after, step_m] = brief.stay;
  const auto takes_place = [&, before = before, after = after, near_m = step_m / 3](
                               Eigen::Index a, Eigen::Index b) {
    return (at[before + 1].row(a) - at[before].row(b)).norm() < near_m &&
           (at[after].row(b) - at[after - 1].row(a)).norm() < near_m;
  };
  for (const Eigen::Index q : points_beside(at[before], brief.point))
    if (takes_place(brief.point, q) && takes_place(q, brief.point)) return q;
  return -1;
}

/// Whether points beside this one, `but` excepted, jump with it.
bool is_joined_by_others(const std::vector<Points>& at, const BriefStay& brief, Eigen::Index but) {
  const Stay& stay = brief.stay;
  return std::ranges::any_of(points_beside(at[stay.before], brief.point), [&](Eigen::Index q) {
    return q != but && std::fmax(way_m(at, stay.before, stay.before + 1, q),
                                 way_m(at, stay.after - 1, stay.after, q)) >= stay.step / 3;
  });
}

}  // namespace

bool is_of_lid(const std::string& name) {
  if (const auto k = face::ibug_number_of_place(name))
    return *k >= 36 && *k <= 47 && *k % 3 != 0;  // 36, 39, 42 and 45 are the corners
  const std::string lower = lower_case(name);
  const auto has = [&](const char* part) { return lower.find(part) != std::string::npos; };
  return has("lid") || (has("eye") && !has("brow"));
}

Path path_of(const std::vector<Points>& at, Eigen::Index point) {
  return [&at, point](std::size_t k) -> Eigen::RowVector3d { return at[k].row(point); };
}

std::vector<BriefStay> brief_stays(const std::vector<Points>& at, const std::vector<double>& time_s,
                                   const std::vector<std::string>& names) {
  std::vector<BriefStay> found;
  for (std::size_t n = 0; n < names.size(); ++n) {
    const auto p = Eigen::Index(n);
    const bool lid = is_of_lid(names[n]);
    std::optional<double> usual_m;  // found when needed, as it takes long
    const auto accepts = [&](const Stay& stay) {
      const Eigen::Index other = exchanged_with(at, {p, stay});
      if (other < 0 && (lid || stay.after == stay.before + 2)) return false;
      if (is_joined_by_others(at, {p, stay}, other)) return false;
      if (!usual_m) usual_m = usual_bend_m(at, p);
      return stay.step > 8 * *usual_m;
    };
    for (const Stay& stay : stays_of(path_of(at, p), time_s, {kStayJump_m, kSlowStep_s, accepts}))
      found.push_back({p, stay});
  }
  return found;
}

}  // namespace hyperex::motion
