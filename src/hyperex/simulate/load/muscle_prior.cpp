// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/load/muscle_prior.hpp"

#include <Eigen/Cholesky>

#include "hyperex/core/error.hpp"

namespace hyperex::simulate {
namespace {

double stated(const muscles::TemplateMuscle& a, const muscles::TemplateMuscle& b) {
  for (const auto& [name, value] : a.together)
    if (name == b.name) return value;
  return 0;
}

double together(const muscles::TemplateMuscle& a, const muscles::TemplateMuscle& b) {
  if (a.name == b.name) return 1;
  const double by_a = stated(a, b);
  return by_a != 0 ? by_a : stated(b, a);
}

Eigen::MatrixXd correlations(const std::vector<muscles::MuscleLine>& lines,
                             const muscles::MuscleTable& table, double between_sides) {
  const auto count = Eigen::Index(lines.size());
  Eigen::MatrixXd out(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < count; ++j) {
      const muscles::MuscleLine &a = lines[std::size_t(i)], &b = lines[std::size_t(j)];
      out(i, j) = together(table[std::size_t(a.row)], table[std::size_t(b.row)]) *
                  (a.left == b.left ? 1 : between_sides);
    }
  if (Eigen::LLT<Eigen::MatrixXd>(out).info() != Eigen::Success)
    throw InputError("muscles",
                     "together: expected correlations that can hold at the same time (a positive "
                     "definite matrix); smaller ones can");
  return out;
}

}  // namespace

FitPriors muscle_prior(const std::vector<muscles::MuscleLine>& lines,
                       const MuscleOptions& options) {
  FitPriors priors;
  priors.activation = options.activation_sigma;
  priors.ring = options.ring_sigma;
  priors.tone = options.tone_sigma;
  priors.slide_m = options.slide_sigma_m;
  priors.correlation = correlations(lines, options.table(), options.side_correlation);
  const auto count = Eigen::Index(lines.size());
  priors.readiness.resize(count);
  priors.yields.resize(count);
  for (Eigen::Index m = 0; m < count; ++m) {
    const muscles::TemplateMuscle& muscle = options.table()[std::size_t(lines[std::size_t(m)].row)];
    priors.readiness[m] = muscle.readiness;
    priors.yields[m] = muscle.yields;
  }
  return priors;
}

}  // namespace hyperex::simulate
