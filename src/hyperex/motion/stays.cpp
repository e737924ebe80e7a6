// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/stays.hpp"

#include <algorithm>
#include <cmath>

namespace hyperex::motion {
namespace {

/// Whether the path looks like a stay; sets its step. Comparisons with NaN, what is missing, are
/// false.
bool looks_like_stay(const Path& at, const std::vector<double>& time_s, double least_step,
                     Stay& stay) {
  const auto& [before, after, step] = stay;
  const Eigen::RowVector3d away = at(before + 1) - at(before), back = at(after) - at(after - 1);
  stay.step = std::min(away.norm(), back.norm());
  if (!(step > least_step) || !((away + back).norm() < step / 2)) return false;
  double beside = 0;
  const auto add_step = [&](std::size_t k) {  // fmax() passes over what is missing
    beside = std::fmax(beside, (at(k + 1) - at(k)).norm());
  };
  if (before > 0) add_step(before - 1);
  if (after + 1 < time_s.size()) add_step(after);
  for (std::size_t k = before + 1; k + 1 < after; ++k) add_step(k);
  if (step <= 3 * beside) return false;
  for (std::size_t k = before + 1; k < after; ++k)
    if (!(off_line(at, time_s, stay, k) > step / 2)) return false;
  return true;
}

}  // namespace

bool is_mended(const Stay& stay, const std::vector<double>& time_s) {
  return time_s[stay.after] - time_s[stay.before] <= kLongestMended_s + kStaySlack_s;
}

std::vector<Stay> stays_of(const Path& at, const std::vector<double>& time_s,
                           const StayRule& rule) {
  std::vector<Stay> stays;
  const auto may_jump = [&](std::size_t k) {
    return time_s[k + 1] - time_s[k] <= rule.longest_step_s &&
           (at(k + 1) - at(k)).norm() > rule.least_step;
  };
  for (std::size_t k = 0; k + 2 < time_s.size(); ++k) {
    if (!may_jump(k)) continue;
    for (std::size_t after = k + 2;
         after < time_s.size() && time_s[after] - time_s[k] <= kLongestStay_s + kStaySlack_s;
         ++after) {
      Stay stay{k, after, 0};
      if (!may_jump(after - 1) || !looks_like_stay(at, time_s, rule.least_step, stay) ||
          !rule.accepts(stay))
        continue;
      stays.push_back(stay);
      k = after - 1;  // so that the jump back is not taken for one away
      break;
    }
  }
  return stays;
}

double off_line(const Path& at, const std::vector<double>& time_s, const Stay& stay,
                std::size_t k) {
  const double share =
      (time_s[k] - time_s[stay.before]) / (time_s[stay.after] - time_s[stay.before]);
  return (at(k) - (1 - share) * at(stay.before) - share * at(stay.after)).norm();
}

}  // namespace hyperex::motion
