// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/common_points.hpp"

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

}  // namespace hyperex::simulate
