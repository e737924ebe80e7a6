// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/common_points.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hyperex/core/add_rest.hpp"
#include "hyperex/face/words_to_point.hpp"

namespace hyperex::simulate {

CommonPoints common_points(const motion::Motion& m, const io::Landmarks& landmarks) {
  CommonPoints pairs;
  std::vector<int> rows;
  for (std::size_t i = 0; i < m.names.size(); ++i)
    if (landmarks.count(m.names[i])) {
      pairs.names.push_back(m.names[i]);
      rows.push_back(static_cast<int>(i));
    }
  pairs.motion.resize(rows.size(), 3);
  pairs.scan.resize(rows.size(), 3);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    pairs.motion.row(i) = m.positions.front().row(rows[i]);
    pairs.scan.row(i) = landmarks.at(pairs.names[i]).transpose();
  }
  return pairs;
}

InputError too_few_common(const motion::Motion& m, const std::vector<std::string>& shared) {
  constexpr std::size_t most_named = 10, most_meant = 5;
  std::vector<std::string> named, meant;
  for (const std::string& name : m.names) {
    if (named.size() < most_named) named.push_back(name);
    const std::string landmark = face::name_of_words(name);
    if (!landmark.empty() && landmark != name && meant.size() < most_meant)
      meant.push_back(landmark + " by " + name);
  }
  add_rest(named, m.names.size());
  return {motion::named(m),
          fmt::format(
              "shares {} point names with the scan's landmarks; expected at least three, not on "
              "one line (e.g. ibug68_36, ibug68_45, ibug68_30; docs/landmarks.md lists them); its "
              "points are {}{}",
              shared.size(), fmt::join(named, ", "),
              meant.empty() ? "" : fmt::format("; did you mean {}?", fmt::join(meant, ", ")))};
}

}  // namespace hyperex::simulate
