// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/gaze_table.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "hyperex/io/csv.hpp"

namespace hyperex::run {

void write_gaze_csv(const std::filesystem::path& file, const simulate::Performance& performance) {
  std::vector<std::string> names = {"time_s"};
  names.insert(names.end(), expression::kGazeNames.begin(), expression::kGazeNames.end());
  io::write_csv(file, names, static_cast<long>(performance.gaze.size()),
                [&](long row, std::vector<double>& values) {
                  values[0] = performance.frame_time_s[std::size_t(row)];
                  std::ranges::copy(expression::degrees_of(performance.gaze[std::size_t(row)]),
                                    values.begin() + 1);
                });
}

}  // namespace hyperex::run
