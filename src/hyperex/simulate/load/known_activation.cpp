// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/load/known_activation.hpp"

#include <cmath>

#include "hyperex/core/within_95.hpp"

namespace hyperex::simulate {
namespace {

double known_share(const Eigen::MatrixXd& sigma, const Eigen::MatrixXd& prior_sigma,
                   Eigen::Index row, Eigen::Index sample) {
  const bool known = prior_sigma.rows() == sigma.rows() && prior_sigma.cols() == sigma.cols();
  if (!known || row < 0 || row >= sigma.rows() || sample < 0 || sample >= sigma.cols())
    return std::nan("");
  return determined_share(sigma(row, sample), prior_sigma(row, sample));
}

std::string prior_words(double share) {
  return share < kLeastDetermined ? kMostlyPriorWords : "";
}

}  // namespace

bool differs_from_zero(double activation, double sigma) {
  return std::abs(activation) > kWithin95 * sigma;
}

double determined_share(double sigma, double prior_sigma) {
  if (!(prior_sigma > 0)) return std::nan("");
  return 1 - std::pow(sigma / prior_sigma, 2);
}

std::string muscle_words(const MuscleCourse& course, Eigen::Index muscle, Eigen::Index sample) {
  return prior_words(known_share(course.sigma, course.prior_sigma, muscle, sample));
}

std::string group_words(const MuscleCourse& course, Eigen::Index group, Eigen::Index sample) {
  return prior_words(group_share(course, group, sample));
}

double group_share(const MuscleCourse& course, Eigen::Index group, Eigen::Index sample) {
  return known_share(course.group_sigma, course.group_prior_sigma, group, sample);
}

}  // namespace hyperex::simulate
