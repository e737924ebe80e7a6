// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/visits/visit_dates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace hyperex::visits {
namespace {

/// Whether `text` begins with digits where `form` has a 0, and with form's own characters
/// elsewhere.
bool begins_like(std::string_view text, std::string_view form) {
  if (text.size() < form.size()) return false;
  for (std::size_t i = 0; i < form.size(); ++i)
    if (form[i] == '0' ? text[i] < '0' || text[i] > '9' : text[i] != form[i]) return false;
  return true;
}

bool is_day(std::string_view date) {
  const auto two = [&](std::size_t at) { return 10 * (date[at] - '0') + date[at + 1] - '0'; };
  return two(5) >= 1 && two(5) <= 12 && two(8) >= 1 && two(8) <= 31;
}

}  // namespace

std::string date_of(const std::string& label) {
  constexpr std::string_view day = "0000-00-00", time = "T00:00";
  if (!begins_like(label, day) || !is_day(label)) return "";
  const bool timed = begins_like(std::string_view(label).substr(day.size()), time);
  return label.substr(0, day.size() + (timed ? time.size() : 0));
}

std::string sort_by_date(std::vector<VisitEntry>& visits) {
  if (visits.size() < 2) return "";
  for (const VisitEntry& visit : visits)
    if (date_of(visit.label).empty())
      return fmt::format(
          "the visits are in the order of the file, as \"{}\" is no date such as 2026-03-01",
          visit.label);
  const auto earlier = [](const VisitEntry& a, const VisitEntry& b) {
    return date_of(a.label) < date_of(b.label);
  };
  if (std::ranges::is_sorted(visits, earlier)) return "";
  std::ranges::stable_sort(visits, earlier);
  return fmt::format(
      "the visits were sorted by date, as the file has another order: the first is {}",
      visits.front().label);
}

}  // namespace hyperex::visits
