// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/landmark_motion.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "hyperex/core/carried_file.hpp"
#include "hyperex/io/number.hpp"

namespace hyperex::motion {

HX_CARRIED_FILE(landmark_motion_csv, HYPEREX_LANDMARK_MOTION_CSV)

namespace {

constexpr double kMillimetre = 1e-3;
constexpr std::size_t kTexts = 3, kNumbersBeforeModes = 6;
constexpr double kCorrelationLength_m = 0.04, kShared = 0.9;
// The modes come from expressions that most people make with both sides. The share of their
// variance that both sides have in common; the rest is each side's own, as in a palsy.
constexpr double kSidesAlike = 0.3;
// Half the width of the middle of the face, where a side's own motion fades out.
constexpr double kMiddle_m = 0.01;

// The file is part of the program: an error in it is an error of the build.
void require(bool sound) {
  if (!sound) throw std::logic_error("the table of moving landmarks in this program is damaged");
}

double metres(std::string_view cell) {
  const auto number = io::parse_number(cell);
  require(number.has_value());
  return kMillimetre * *number;
}

/// The number of modes of a part. Each has three columns, whose names begin with `part`.
Eigen::Index modes_named(const std::vector<std::string_view>& header, std::string_view part) {
  Eigen::Index columns = 0;
  for (const auto name : header) columns += name.size() > part.size() && name.starts_with(part);
  require(columns > 0 && columns % 3 == 0);
  return columns / 3;
}

void add_row(const std::vector<std::string_view>& cells, Eigen::Index row, LandmarkMotion& table) {
  table.names.emplace_back(cells[0]);
  table.aliases.emplace_back(cells[1]);
  table.upper.push_back(cells[2] == "upper");
  std::size_t at = kTexts;
  for (Eigen::Index axis = 0; axis < 3; ++axis) table.rest_m(row, axis) = metres(cells[at++]);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    table.sd_m(row, axis) = metres(cells[at++]);
    require(table.sd_m(row, axis) > 0);
  }
  for (Eigen::MatrixXd* modes : {&table.upper_modes_m, &table.lower_modes_m})
    for (Eigen::Index mode = 0; mode < modes->cols(); ++mode)
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        (*modes)(3 * row + axis, mode) = metres(cells[at++]);
}

LandmarkMotion parsed() {
  const std::string_view text = landmark_motion_csv();
  std::vector<std::vector<std::string_view>> lines;
  io::Lines all(text);
  for (std::string_view line; all.next(line);)
    if (!line.empty() && line.front() != '#') lines.push_back(io::split(line, ','));
  require(lines.size() > 3);
  LandmarkMotion table;
  const Eigen::Index landmarks = Eigen::Index(lines.size()) - 1;
  table.rest_m.resize(landmarks, 3);
  table.sd_m.resize(landmarks, 3);
  table.upper_modes_m.resize(3 * landmarks, modes_named(lines[0], "upper"));
  table.lower_modes_m.resize(3 * landmarks, modes_named(lines[0], "lower"));
  const auto cells = kTexts + kNumbersBeforeModes +
                     3 * std::size_t(table.upper_modes_m.cols() + table.lower_modes_m.cols());
  for (Eigen::Index row = 0; row < landmarks; ++row) {
    require(lines[std::size_t(row) + 1].size() == cells);
    add_row(lines[std::size_t(row) + 1], row, table);
  }
  return table;
}

/// Covariance between two landmarks of the motion that the modes do not describe.
Eigen::Matrix3d beyond_modes(const LandmarkMotion& table, int a, int b) {
  const double distance_m = (table.rest_m.row(a) - table.rest_m.row(b)).norm();
  const double alike =
      kShared * std::exp(-distance_m / kCorrelationLength_m) + (a == b ? 1 - kShared : 0);
  return (alike * table.sd_m.row(a).array() * table.sd_m.row(b).array()).matrix().asDiagonal();
}

/// 1 on the subject's left, 0 on the right.
double share_of_left(const LandmarkMotion& table, int row) {
  return std::clamp(0.5 + table.rest_m(row, 0) / (2 * kMiddle_m), 0.0, 1.0);
}

/// The covariance of the motion by modes: of the whole face, and of each side alone. The variance
/// of each landmark is that of the whole modes.
Eigen::MatrixXd by_modes(const LandmarkMotion& table, const std::vector<int>& rows,
                         const Eigen::MatrixXd& all_modes) {
  Eigen::MatrixXd modes(3 * Eigen::Index(rows.size()), all_modes.cols());
  Eigen::MatrixXd left = modes, right = modes;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Eigen::MatrixXd own = all_modes.middleRows(3 * rows[i], 3);
    const double share = share_of_left(table, rows[i]);
    modes.middleRows(3 * Eigen::Index(i), 3) = own;
    left.middleRows(3 * Eigen::Index(i), 3) = std::sqrt(share) * own;
    right.middleRows(3 * Eigen::Index(i), 3) = std::sqrt(1 - share) * own;
  }
  return kSidesAlike * modes * modes.transpose() +
         (1 - kSidesAlike) * (left * left.transpose() + right * right.transpose());
}

Eigen::MatrixXd part_prior(const LandmarkMotion& table, const std::vector<int>& rows, bool upper) {
  Eigen::MatrixXd covariance =
      by_modes(table, rows, upper ? table.upper_modes_m : table.lower_modes_m);
  const Eigen::Index count = Eigen::Index(rows.size());
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < count; ++j) {
      const int a = rows[std::size_t(i)], b = rows[std::size_t(j)];
      if (table.upper[std::size_t(a)] == upper && table.upper[std::size_t(b)] == upper)
        covariance.block<3, 3>(3 * i, 3 * j) += beyond_modes(table, a, b);
    }
  return covariance;
}

}  // namespace

const LandmarkMotion& landmark_motion() {
  static const LandmarkMotion table = parsed();
  return table;
}

ExpressionPrior expression_prior(const std::vector<int>& rows, const Eigen::Matrix3d& turn,
                                 double scale) {
  const auto carried = [&](Eigen::MatrixXd covariance) {
    for (Eigen::Index i = 0; i < covariance.rows(); i += 3)
      for (Eigen::Index j = 0; j < covariance.cols(); j += 3) {
        const Eigen::Matrix3d block = covariance.block<3, 3>(i, j);
        covariance.block<3, 3>(i, j) = scale * scale * (turn * block * turn.transpose());
      }
    return covariance;
  };
  return {carried(part_prior(landmark_motion(), rows, true)),
          carried(part_prior(landmark_motion(), rows, false))};
}

}  // namespace hyperex::motion
