// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <vector>

#include "hyperex/muscles/muscle_lines.hpp"
#include "hyperex/muscles/muscle_template.hpp"

namespace hyperex::simulate {

/// Which muscles make the motion that a fit leaves unexplained. The muscles are divided into those
/// of the mouth and cheeks, of the eye and of the brow, on the right and on the left. Each place's
/// motion is divided among these parts by the variance that their muscles are expected to
/// give it:
///   share(x, part) = sum_{m in part} s_m^2 |r_m(x)|^2 / (sum_m s_m^2 |r_m(x)|^2 + e^2)
/// with s_m the standard deviation (1 sigma) of the activation before a point is observed, r_m the
/// displacement at activation 1, and e = 0.2 mm: what no muscle can move belongs to none.
class FaceParts {
 public:
  static constexpr Eigen::Index kCount = 6;

  /// `sigma`: one per line.
  FaceParts(const std::vector<muscles::MuscleLine>& lines, const muscles::MuscleTable& table,
            Eigen::VectorXd sigma);

  /// For `response` (3 n x |lines|, m, at n places): n x (kCount + 1), not negative, rows of sum 1.
  /// The last column is the share of no muscle.
  Eigen::MatrixXd shares(const Eigen::MatrixXd& response) const;

  /// For each part the lines (rising) that have 5 % or more of the variance of its lines, summed
  /// over these places relative to the variance of all lines. Of a part that moves none of the
  /// places, and of no muscle (the last one): none. Length kCount + 1.
  std::vector<std::vector<int>> makers(const Eigen::MatrixXd& response) const;

 private:
  /// s_m^2 |r_m(x)|^2: n x |lines|.
  Eigen::MatrixXd variances(const Eigen::MatrixXd& response) const;
  std::vector<Eigen::Index> part_;  ///< of each line
  Eigen::VectorXd sigma_;
};

}  // namespace hyperex::simulate
