// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/estimate/posterior.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hyperex/muscles/bounded_least_squares.hpp"

namespace hyperex::estimate {
namespace {

constexpr int kMostIterations = 40, kMostHalvings = 6;
/// The search ends where a step would lower the cost by less than this: for a mode, and where some
/// unknowns are held, for a profile, whose cost alone matters.
constexpr double kSmallGain = 1e-3, kSmallProfileGain = 0.01;
/// How often the scale of the model's errors is found anew.
constexpr int kScaleRounds = 3;

std::vector<int> loads_of(const std::vector<Observation>& observations) {
  std::vector<int> out;
  for (const Observation& observation : observations) out.push_back(observation.load);
  return out;
}

}  // namespace

std::vector<Eigen::Index> free_unknowns(const std::vector<char>& fixed) {
  std::vector<Eigen::Index> out;
  for (std::size_t i = 0; i < fixed.size(); ++i)
    if (!fixed[i]) out.push_back(Eigen::Index(i));
  return out;
}

Posterior::Posterior(FaceModel& face, std::vector<Observation> observations,
                     const Assumptions& assumptions)
    : face_(face),
      observations_(std::move(observations)),
      model_(face,
             {.ratios = face.responses.unknowns() - 1,
              .gains = Eigen::Index(face.acts.size()),
              .muscles = Eigen::Index(face.responses.lines().size()),
              .recordings = Eigen::Index(observations_.size()),
              .absolute = face.loads.empty() ? 0 : 1},
             loads_of(observations_)),
      assumptions_(assumptions) {}

Eigen::VectorXd Posterior::start() const {
  const Unknowns& u = model_.unknowns();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(u.all());
  x.segment(u.gain(0), u.gains).setOnes();
  return x;
}

Eigen::MatrixXd Posterior::prior_precision(const Eigen::VectorXd& x) const {
  const Unknowns& u = model_.unknowns();
  const Assumptions& a = assumptions_;
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(u.all(), u.all());
  const auto set = [&](Eigen::Index from, Eigen::Index count, double sigma) {
    out.diagonal().segment(from, count).setConstant(1 / (sigma * sigma));
  };
  set(u.ratio(0), u.ratios, a.log_ratio);
  set(u.gain(0), u.gains, a.gain);
  set(u.young(), u.absolute, a.log_young);
  set(u.tissue(), 1, a.log_tissue);
  for (int way = 0; way < 2; ++way) set(u.lines(way), u.muscles, a.line_m / std::sqrt(2.0));
  const MusclePrior& known = face_.prior;
  const auto pairs = Eigen::Index(known.left.size());
  for (Eigen::Index e = 0; e < u.recordings; ++e) {
    const Eigen::Index first = u.activations(e);
    Eigen::MatrixXd mean = known.sigma.asDiagonal() * known.together * known.sigma.asDiagonal();
    Eigen::MatrixXd difference(pairs, pairs);
    for (Eigen::Index i = 0; i < pairs; ++i)
      for (Eigen::Index j = 0; j < pairs; ++j) {
        const auto effort = [&](Eigen::Index k) {
          return 0.5 * std::abs(x[first + known.left[std::size_t(k)]] +
                                x[first + known.right[std::size_t(k)]]);
        };
        difference(i, j) = a.side * a.side * effort(i) * effort(j);
        if (i == j)
          difference(i, j) += std::pow(a.muscle * effort(i), 2) + std::pow(a.least_difference, 2);
      }
    // With the mean (L + R) / 2 and the difference (L - R) / 2.
    const Eigen::MatrixXd p = mean.inverse() / 4, q = difference.inverse() / 4;
    for (Eigen::Index i = 0; i < pairs; ++i)
      for (Eigen::Index j = 0; j < pairs; ++j) {
        const Eigen::Index li = first + known.left[std::size_t(i)],
                           lj = first + known.left[std::size_t(j)],
                           ri = first + known.right[std::size_t(i)],
                           rj = first + known.right[std::size_t(j)];
        out(li, lj) += p(i, j) + q(i, j);
        out(ri, rj) += p(i, j) + q(i, j);
        out(li, rj) += p(i, j) - q(i, j);
        out(ri, lj) += p(i, j) - q(i, j);
      }
    const double sigma[6] = {known.opening_rad, known.turn_rad,    known.tilt_rad,
                             known.slide_m.x(), known.slide_m.y(), known.slide_m.z()};
    for (int k = 0; k < 6; ++k) set(u.jaw(e) + k, 1, sigma[k]);
    const Observation& seen = observations_[std::size_t(e)];
    set(u.head(e), 3, seen.head_turn_rad);
    set(u.head(e) + 3, 3, seen.head_shift_m);
    set(u.load_turn(e), 6, a.load_turn_rad);
  }
  return out;
}

Eigen::LLT<Eigen::MatrixXd> Posterior::errors(const Observation& observation, double scale) const {
  const Assumptions& a = assumptions_;
  const Eigen::Index points = face_.places.rows();
  Eigen::VectorXd size(points);
  for (Eigen::Index p = 0; p < points; ++p)
    size[p] =
        scale * (a.misfit_m + a.misfit_share * observation.displacement_m.segment<3>(3 * p).norm());
  Eigen::MatrixXd out =
      observation.noise_m * observation.noise_m * Eigen::MatrixXd::Identity(3 * points, 3 * points);
  for (Eigen::Index p = 0; p < points; ++p)
    for (Eigen::Index q = 0; q < points; ++q) {
      const double apart = (face_.places.row(p) - face_.places.row(q)).squaredNorm();
      const double value =
          size[p] * size[q] * std::exp(-apart / (2 * a.misfit_length_m * a.misfit_length_m));
      for (int axis = 0; axis < 3; ++axis) out(3 * p + axis, 3 * q + axis) += value;
    }
  // Points that coincide would make it singular where there is no noise.
  out.diagonal().array() += 1e-12;
  return out.llt();
}

Eigen::MatrixXd Posterior::information(const Mode& mode) const {
  return mode.hessian - prior_precision(mode.x);
}

Eigen::MatrixXd Posterior::information(const Eigen::MatrixXd& derivative,
                                       const Observation& observation, double error_scale) const {
  const Eigen::MatrixXd weighed = errors(observation, error_scale).matrixL().solve(derivative);
  return weighed.transpose() * weighed;
}

double Posterior::cost(const Eigen::VectorXd& x, const Eigen::MatrixXd& precision, double scale) {
  const Eigen::VectorXd off = x - start();
  double out = 0.5 * off.dot(precision * off);
  for (std::size_t e = 0; e < observations_.size(); ++e) {
    const Eigen::VectorXd residual =
        observations_[e].displacement_m - model_.displacement(x, Eigen::Index(e));
    out += 0.5 * errors(observations_[e], scale).matrixL().solve(residual).squaredNorm();
  }
  return out;
}

/// Observed in all recordings.
double Posterior::coordinates() const {
  return double(3 * face_.places.rows()) * double(observations_.size());
}

Eigen::VectorXd Posterior::lower_bounds() const {
  const Unknowns& u = model_.unknowns();
  Eigen::VectorXd lower =
      Eigen::VectorXd::Constant(u.all(), -std::numeric_limits<double>::infinity());
  lower.segment(u.gain(0), u.gains).setZero();
  for (Eigen::Index e = 0; e < u.recordings; ++e)
    for (Eigen::Index m = 0; m < u.muscles; ++m)
      if (!face_.prior.tone[std::size_t(m)]) lower[u.activations(e) + m] = 0;
  return lower;
}

/// Sets the mode's cost, Hessian and residual to those at its x. Returns the gradient.
Eigen::VectorXd Posterior::expand(const Eigen::MatrixXd& precision, Mode& mode) {
  const Eigen::VectorXd off = mode.x - start();
  Eigen::VectorXd gradient = precision * off;
  mode.cost = 0.5 * off.dot(gradient);
  mode.hessian = precision;
  mode.weighed_squares = 0;
  double squares = 0;
  for (std::size_t e = 0; e < observations_.size(); ++e) {
    const auto error = errors(observations_[e], mode.error_scale);
    const Eigen::VectorXd plain =
        observations_[e].displacement_m - model_.displacement(mode.x, Eigen::Index(e));
    const Eigen::VectorXd residual = error.matrixL().solve(plain);
    const Eigen::MatrixXd derivative =
        error.matrixL().solve(model_.derivative(mode.x, Eigen::Index(e)));
    mode.hessian.noalias() += derivative.transpose() * derivative;
    gradient.noalias() -= derivative.transpose() * residual;
    mode.weighed_squares += residual.squaredNorm();
    squares += plain.squaredNorm();
  }
  mode.cost += 0.5 * mode.weighed_squares;
  mode.rms_m = std::sqrt(squares / coordinates());
  return gradient;
}

Mode Posterior::minimum(Eigen::VectorXd x, const std::vector<char>& held, double scale,
                        double enough) {
  const Eigen::VectorXd lower = lower_bounds();
  const std::vector<Eigen::Index> free = free_unknowns(held);
  Mode mode;
  mode.x = std::move(x);
  mode.error_scale = scale;
  for (;; ++mode.iterations) {
    const Eigen::MatrixXd precision = prior_precision(mode.x);
    const Eigen::VectorXd gradient = expand(precision, mode)(free);
    const Eigen::MatrixXd h = mode.hessian(free, free);
    const Eigen::VectorXd here = mode.x(free);
    Eigen::VectorXd next = here;
    muscles::bounded_least_squares(h, h * here - gradient, lower(free), next);
    const Eigen::VectorXd step = next - here;
    // What the step would gain by the quadratic model.
    const double gain = -gradient.dot(step) - 0.5 * step.dot(h * step);
    if (gain < enough || mode.iterations == kMostIterations) break;
    Eigen::VectorXd tried = mode.x;
    bool better = false;
    double share = 1;
    for (int halving = 0; halving < kMostHalvings && !better; ++halving, share /= 2) {
      tried(free) = here + share * step;
      better = cost(tried, precision, scale) < mode.cost;
    }
    if (!better) break;
    mode.x = tried;
  }
  mode.fixed = held;
  for (Eigen::Index i = 0; i < mode.x.size(); ++i)
    if (mode.x[i] <= lower[i]) mode.fixed[std::size_t(i)] = true;
  return mode;
}

Mode Posterior::find(const Eigen::VectorXd& start,
                     const std::vector<std::pair<Eigen::Index, double>>& held, double error_scale) {
  const Unknowns& u = model_.unknowns();
  Eigen::VectorXd x = start;
  std::vector<char> fixed(std::size_t(u.all()), false);
  for (const auto& [index, value] : held) {
    x[index] = value;
    fixed[std::size_t(index)] = true;
  }
  double scale = error_scale > 0 ? error_scale : 1;
  const double enough = held.empty() ? kSmallGain : kSmallProfileGain;
  if (held.empty()) {
    // First in the tissue of the start, which needs no other factor.
    std::vector<char> tissue = fixed;
    std::fill_n(tissue.begin(), u.ratios, true);
    tissue[std::size_t(u.tissue())] = true;
    x = minimum(x, tissue, scale, kSmallProfileGain).x;
  }
  Mode mode = minimum(x, fixed, scale, enough);
  for (int round = 0; error_scale <= 0 && round < kScaleRounds; ++round) {
    // Degrees of freedom: the coordinates less what the unknowns take up.
    const std::vector<Eigen::Index> free = free_unknowns(mode.fixed);
    const Eigen::MatrixXd all = information(mode);
    const Eigen::MatrixXd taken = mode.hessian(free, free).llt().solve(all(free, free));
    const double freedom = std::max(1.0, coordinates() - taken.trace());
    const double next = std::max(1.0, scale * std::sqrt(mode.weighed_squares / freedom));
    if (std::abs(next - scale) < 0.05 * scale) break;
    scale = next;
    mode = minimum(mode.x, fixed, scale, enough);
  }
  return mode;
}

}  // namespace hyperex::estimate
