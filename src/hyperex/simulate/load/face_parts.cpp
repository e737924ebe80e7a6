// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/load/face_parts.hpp"

namespace hyperex::simulate {
namespace {

constexpr double kOfNoMuscle_m = 2e-4;
constexpr double kLeastShare = 0.05;

/// 0: mouth and cheeks, 1: eye, 2: brow.
Eigen::Index height(const std::string& group) {
  return group.starts_with("brow ") ? 2 : group.starts_with("eye ") ? 1 : 0;
}

}  // namespace

FaceParts::FaceParts(const std::vector<muscles::MuscleLine>& lines,
                     const muscles::MuscleTable& table, Eigen::VectorXd sigma)
    : sigma_(std::move(sigma)) {
  for (const muscles::MuscleLine& line : lines)
    part_.push_back(2 * height(table[std::size_t(line.row)].group) + (line.left ? 1 : 0));
}

Eigen::MatrixXd FaceParts::variances(const Eigen::MatrixXd& response) const {
  Eigen::MatrixXd out(response.rows() / 3, response.cols());
  for (Eigen::Index m = 0; m < out.cols(); ++m)
    for (Eigen::Index i = 0; i < out.rows(); ++i)
      out(i, m) = sigma_[m] * sigma_[m] * response.col(m).segment<3>(3 * i).squaredNorm();
  return out;
}

Eigen::MatrixXd FaceParts::shares(const Eigen::MatrixXd& response) const {
  const Eigen::MatrixXd variance = variances(response);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(variance.rows(), kCount + 1);
  out.rightCols<1>().setConstant(kOfNoMuscle_m * kOfNoMuscle_m);
  for (Eigen::Index m = 0; m < variance.cols(); ++m)
    out.col(part_[std::size_t(m)]) += variance.col(m);
  return out.rowwise().sum().cwiseInverse().asDiagonal() * out;
}

std::vector<std::vector<int>> FaceParts::makers(const Eigen::MatrixXd& response) const {
  const Eigen::MatrixXd variance = variances(response);
  const Eigen::VectorXd all = variance.rowwise().sum().array() + kOfNoMuscle_m * kOfNoMuscle_m;
  const Eigen::VectorXd each = variance.transpose() * all.cwiseInverse();
  Eigen::VectorXd of_part = Eigen::VectorXd::Zero(kCount);
  for (Eigen::Index m = 0; m < each.size(); ++m) of_part[part_[std::size_t(m)]] += each[m];
  std::vector<std::vector<int>> out(kCount + 1);
  for (Eigen::Index m = 0; m < each.size(); ++m) {
    const Eigen::Index part = part_[std::size_t(m)];
    if (each[m] > 0 && each[m] >= kLeastShare * of_part[part])
      out[std::size_t(part)].push_back(int(m));
  }
  return out;
}

}  // namespace hyperex::simulate
