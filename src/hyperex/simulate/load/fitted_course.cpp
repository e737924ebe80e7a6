// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/load/fitted_course.hpp"

#include <algorithm>

namespace hyperex::simulate {

Eigen::MatrixXd name_groups(const std::vector<muscles::MuscleLine>& lines,
                            const muscles::MuscleTable& table, std::vector<std::string>& groups) {
  Eigen::MatrixXd members = Eigen::MatrixXd::Zero(0, static_cast<Eigen::Index>(lines.size()));
  for (std::size_t m = 0; m < lines.size(); ++m) {
    const std::string name = table[std::size_t(lines[m].row)].group + (lines[m].left ? "_L" : "_R");
    const auto at = std::find(groups.begin(), groups.end(), name) - groups.begin();
    if (at == static_cast<std::ptrdiff_t>(groups.size())) {
      groups.push_back(name);
      members.conservativeResize(members.rows() + 1, Eigen::NoChange);
      members.bottomRows<1>().setZero();
    }
    members(at, static_cast<Eigen::Index>(m)) = 1;
  }
  return members;
}

void resize(MuscleCourse& course, Eigen::Index muscles, Eigen::Index groups, Eigen::Index samples) {
  course.group_activation.resize(groups, samples);
  course.group_sigma.resize(groups, samples);
  course.group_prior_sigma.resize(groups, samples);
  course.activation.resize(muscles, samples);
  course.sigma.resize(muscles, samples);
  course.prior_sigma.resize(muscles, samples);
  course.jaw_opening_deg.resize(samples);
}

void store_sample(const FitResult& fitted, const Eigen::MatrixXd& members, Eigen::Index sample,
                  MuscleCourse& course) {
  const auto sigmas = [](const Eigen::MatrixXd& covariance) {
    return Eigen::VectorXd(covariance.diagonal().cwiseSqrt());
  };
  course.activation.col(sample) = fitted.activation;
  course.sigma.col(sample) = sigmas(fitted.covariance);
  course.prior_sigma.col(sample) = sigmas(fitted.prior_covariance);
  course.group_activation.col(sample) = members * fitted.activation;
  course.group_sigma.col(sample) = sigmas(members * fitted.covariance * members.transpose());
  course.group_prior_sigma.col(sample) =
      sigmas(members * fitted.prior_covariance * members.transpose());
}

}  // namespace hyperex::simulate
