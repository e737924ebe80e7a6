// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/estimate/intervals.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "hyperex/core/within_95.hpp"

namespace hyperex::estimate {
namespace {

constexpr int kMostProfileSteps = 4;
/// The ends of a profile interval are found to this accuracy of the number of sigmas.
constexpr double kEndAccuracy = 0.1;

double variance(const Mode& mode, Eigen::Index which,
                const std::function<bool(Eigen::Index)>& known) {
  std::vector<Eigen::Index> free = free_unknowns(mode.fixed);
  std::erase_if(free, known);
  const auto at = std::find(free.begin(), free.end(), which) - free.begin();
  const Eigen::MatrixXd h = mode.hessian(free, free);
  if (at == Eigen::Index(free.size())) return 0;
  return h.llt().solve(Eigen::VectorXd::Unit(h.rows(), at))[at];
}

/// The end of the profile interval on one side (-1, +1) of the mode.
double profile_end(Posterior& posterior, const Mode& mode, Eigen::Index which, double sigma,
                   double side) {
  const bool is_gain = posterior.unknowns().is_gain(which);
  double offset = kWithin95 * sigma;
  Eigen::VectorXd from = mode.x;
  for (int step = 0; step < kMostProfileSteps; ++step) {
    const bool at_bound = is_gain && side < 0 && offset >= mode.x[which];
    if (at_bound) offset = mode.x[which];
    const Mode there =
        posterior.find(from, {{which, mode.x[which] + side * offset}}, mode.error_scale);
    const double sigmas = std::sqrt(2 * std::max(1e-12, there.cost - mode.cost));
    if (std::abs(sigmas - kWithin95) < kEndAccuracy || (at_bound && sigmas < kWithin95)) break;
    from = there.x;
    offset *= std::clamp(kWithin95 / sigmas, 0.5, 2.0);
  }
  return mode.x[which] + side * offset;
}

}  // namespace

Eigen::MatrixXd asked_covariance(const Mode& mode, const Unknowns& unknowns) {
  const auto free = free_unknowns(mode.fixed);
  const Eigen::MatrixXd h = mode.hessian(free, free);
  const Eigen::MatrixXd all = h.llt().solve(Eigen::MatrixXd::Identity(h.rows(), h.cols()));
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(unknowns.asked(), unknowns.asked());
  for (std::size_t i = 0; i < free.size(); ++i)
    for (std::size_t j = 0; j < free.size(); ++j)
      if (free[i] < unknowns.asked() && free[j] < unknowns.asked())
        out(free[i], free[j]) = all(Eigen::Index(i), Eigen::Index(j));
  return out;
}

AskedInterval interval_of(Posterior& posterior, const Mode& mode, Eigen::Index which) {
  AskedInterval out;
  out.value = mode.x[which];
  Mode released = mode;  // a gain at its bound varies upwards
  released.fixed[std::size_t(which)] = false;
  out.sigma = std::sqrt(asked_covariance(released, posterior.unknowns())(which, which));
  out.laplace = {out.value - kWithin95 * out.sigma, out.value + kWithin95 * out.sigma};
  out.profile = {profile_end(posterior, mode, which, out.sigma, -1),
                 profile_end(posterior, mode, which, out.sigma, 1)};
  if (posterior.unknowns().is_gain(which)) out.laplace.low = std::max(0.0, out.laplace.low);
  return out;
}

std::vector<ErrorPart> error_parts(const Mode& mode, const Unknowns& u, Eigen::Index which) {
  const auto of_recordings = [&u](Eigen::Index from, Eigen::Index to) {
    return [&u, from, to](Eigen::Index i) {
      if (i < u.shared()) return false;
      const Eigen::Index within = (i - u.shared()) % u.each();
      return from <= within && within < to;
    };
  };
  const double all = variance(mode, which, [](Eigen::Index) { return false; });
  const auto part = [&](const char* words, const std::function<bool(Eigen::Index)>& known) {
    return ErrorPart{words, all > 0 ? 1 - variance(mode, which, known) / all : 0};
  };
  std::vector<ErrorPart> out{
      part("which muscles act, and how alike on both sides", of_recordings(0, u.muscles)),
      part("the jaw's pose", of_recordings(u.muscles, u.muscles + 6)),
      part("the head's pose", of_recordings(u.muscles + 6, u.muscles + 12)),
      part("the direction of the known load", of_recordings(u.muscles + 12, u.each())),
      part("where the muscles lie",
           [&u](Eigen::Index i) { return i >= u.lines(0) && i < u.shared(); }),
      part("how stiff the tissue is relative to its support on the bones",
           [&u](Eigen::Index i) { return i == u.tissue(); }),
      part("the other quantities that are asked for",
           [&u, which](Eigen::Index i) { return i < u.asked() && i != which; }),
  };
  // What is left where all else is known comes from the points themselves.
  out.push_back(
      {"the points' noise and the model's errors there",
       all > 0 ? variance(mode, which, [which](Eigen::Index i) { return i != which; }) / all : 0});
  std::stable_sort(out.begin(), out.end(),
                   [](const ErrorPart& a, const ErrorPart& b) { return a.share > b.share; });
  return out;
}

}  // namespace hyperex::estimate
