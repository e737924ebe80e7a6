// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/reduced/reduced_model.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/core/symmetric_modes.hpp"
#include "hyperex/fem/material/entry.hpp"
#include "hyperex/fem/reduced/basis.hpp"
#include "hyperex/fem/reduced/reduced_newmark.hpp"

namespace hyperex::fem {
namespace {

/// Number of instants at which the motion is evaluated. They are denser at the start, where a jump
/// of the acceleration would cause oscillations.
constexpr int kInstants = 32;
/// Directions of a residual weaker than this share of the strongest are not solved for.
constexpr double kLeastDirection = 1e-5;

std::vector<int> instants(int steps) {
  std::vector<int> at;
  for (int step = 1; step < steps / kInstants; step *= 4) at.push_back(step);
  for (int i = 1; i <= kInstants; ++i)
    at.push_back(static_cast<int>(std::lround(static_cast<double>(steps) * i / kInstants)));
  at.erase(std::remove(at.begin(), at.end(), 0), at.end());
  at.erase(std::unique(at.begin(), at.end()), at.end());
  return at;
}

Eigen::MatrixXd columns(const Eigen::MatrixXd& m, const std::vector<int>& at) {
  return m(Eigen::all, at);
}

/// Rows of the free unknowns.
Eigen::MatrixXd rows_of_free_nodes(const Eigen::MatrixXd& all, const Partition& partition) {
  Eigen::MatrixXd part(partition.free.size(), all.cols());
  for (Eigen::Index c = 0; c < all.cols(); ++c)
    for (std::size_t i = 0; i < partition.free.size(); ++i) part(i, c) = all(partition.free[i], c);
  return part;
}

Eigen::MatrixXd with_zeros(const Eigen::MatrixXd& part, const std::vector<int>& rows,
                           Eigen::Index all_rows) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(all_rows, part.cols());
  for (Eigen::Index c = 0; c < part.cols(); ++c)
    for (std::size_t i = 0; i < rows.size(); ++i) all(rows[i], c) = part(i, c);
  return all;
}

double greatest_node_motion(const Eigen::MatrixXd& d) {
  double most = 0;
  for (Eigen::Index c = 0; c < d.cols(); ++c)
    for (Eigen::Index n = 0; n < d.rows(); n += 3)
      most = std::max(most, d.col(c).segment<3>(n).squaredNorm());
  return std::sqrt(most);
}

/// The forces of a drive on the free unknowns: static s + viscous s' + inertial s''.
struct DriveForces {
  Eigen::MatrixXd shapes;                      // D, all unknowns
  Eigen::MatrixXd static_, viscous, inertial;  // F - K D, -C D, -M D

  DriveForces(const System& system, const Partition& partition, const Drive& drive)
      : shapes(with_zeros(drive.prescribed, partition.prescribed, partition.unknowns())),
        static_(-symmetric_product(system.stiffness, shapes)),
        viscous(-symmetric_product(system.damping, shapes)),
        inertial(-symmetric_product(system.mass, shapes)) {
    if (drive.force.rows() > 0) static_ += drive.force;
  }
};

/// Grows the basis step by step and integrates the reduced motion after each growth.
class Growth {
 public:
  Growth(const System& system, PartitionedFactor& factor, const Drive& drive,
         const ReducedOptions& options)
      : factor_(factor),
        drive_(drive),
        options_(options),
        forces_(system, factor.partition(), drive),
        flexibility_(system.stiffness.diagonal().cwiseInverse()),
        basis_(system),
        at_(instants(drive.steps())) {
    flexibility_(factor.prescribed()).setZero();
  }

  void begin() {
    const Eigen::VectorXd greatest = drive_.s.rowwise().lpNorm<Eigen::Infinity>();
    Eigen::MatrixXd w = solved(forces_.static_ * greatest.asDiagonal());
    basis_.grow(std::move(w), 0);
    integrate();
  }

  /// Grows the basis once. Returns the estimate of the remaining error (m).
  double grow() {
    const ReducedMotion before = motion_;
    const int size = basis_.size();
    const double least = 0.02 * options_.tolerance * greatest_;
    const Compressed left = compressed(residual());
    const Basis::Grown grown = basis_.grow(solved(left.columns), left.mix, least);
    if (grown.taken == 0) return grown.skipped;
    integrate();
    Eigen::MatrixXd change = motion_.d;
    change.topRows(size) -= before.d;
    const std::vector<int> at = with_peaks(change);
    Eigen::MatrixXd moved =
        Eigen::MatrixXd::Zero(forces_.shapes.rows(), static_cast<Eigen::Index>(at.size()));
    add_product(basis_.vectors(), columns(change, at), 1, moved);
    changes_.push_back(greatest_node_motion(moved));
    return yet_to_come() + grown.skipped;
  }

  double greatest() const { return greatest_; }
  int size() const { return basis_.size(); }

  Response response() const {
    Response r;
    r.basis_size = basis_.size();
    r.greatest_displacement_m = greatest_;
    const Eigen::Index shapes = drive_.shapes();
    r.shapes.resize(forces_.shapes.rows(), basis_.size() + shapes);
    r.shapes << basis_.vectors(), forces_.shapes;
    r.course.resize(basis_.size() + shapes, drive_.s.cols());
    r.course << motion_.d, drive_.s;
    return r;
  }

 private:
  Eigen::MatrixXd solved(const Eigen::MatrixXd& force) {
    Eigen::MatrixXd x = rows_of_free_nodes(force, factor_.partition());
    factor_.solve(x);
    return with_zeros(x, factor_.free(), force.rows());
  }

  void integrate() {
    const auto& v = basis_.vectors();
    Eigen::MatrixXd force = inner_products(v, forces_.static_) * drive_.s;
    force += inner_products(v, forces_.viscous) * drive_.rate;
    force += inner_products(v, forces_.inertial) * drive_.second;
    motion_ = integrate_reduced(basis_.stiffness(), basis_.damping(), basis_.mass(), force,
                                options_.time);
    Eigen::MatrixXd d = forces_.shapes * columns(drive_.s, at_);
    add_product(v, columns(motion_.d, at_), 1, d);
    greatest_ = greatest_node_motion(d);
  }

  /// The instants, and those steps at which the change stores most energy. In a K-orthonormal
  /// basis, this energy is a sum of squares, which is known at all steps.
  std::vector<int> with_peaks(const Eigen::MatrixXd& change) const {
    const Eigen::VectorXd energy = change.colwise().squaredNorm();
    std::vector<int> at = at_, peaks;
    for (Eigen::Index t = 1; t < energy.size(); ++t)
      if (energy[t] > energy[t - 1] && (t + 1 == energy.size() || energy[t] >= energy[t + 1]))
        peaks.push_back(static_cast<int>(t));
    const std::size_t kept = std::min<std::size_t>(peaks.size(), kInstants / 2);
    std::partial_sort(
        peaks.begin(), peaks.begin() + static_cast<std::ptrdiff_t>(kept), peaks.end(),
        [&](int a, int b) { return energy[a] != energy[b] ? energy[a] > energy[b] : a < b; });
    at.insert(at.end(), peaks.begin(), peaks.begin() + static_cast<std::ptrdiff_t>(kept));
    return at;
  }

  /// Estimated sum of all further changes (m), if each is q times the one before, with q the mean
  /// ratio over the last three growths: c (q + q^2 + ...), but at least c. c is the last change, or
  /// the value that q predicts for it if that is greater.
  double yet_to_come() const {
    const std::size_t n = changes_.size(), from = n > 4 ? n - 4 : 0;
    if (changes_.back() <= 0) return 0;
    if (n < 2) return 10 * changes_.back();  // a single growth shows no trend
    const double mean =
        std::pow(changes_.back() / changes_[from], 1.0 / static_cast<double>(n - 1 - from));
    const double last = std::max(changes_.back(), mean * changes_[n - 2]);
    const double q = std::min(mean, 0.95);
    return last * std::max(1.0, q / (1 - q));
  }

  /// A matrix with few independent columns, in the form `columns` * `mix`.
  struct Compressed {
    Eigen::MatrixXd columns, mix;
  };
  /// The residuals at different instants of one motion are similar. Their directions are ranked by
  /// the energy they would have if each unknown were a spring with its own diagonal stiffness. What
  /// is omitted here remains in the residual of the next growth.
  Compressed compressed(const Eigen::MatrixXd& r) const {
    const Eigen::MatrixXd scaled = flexibility_.asDiagonal() * r;
    const SymmetricModes modes = symmetric_modes(inner_products(r, scaled));
    const double least = kLeastDirection * kLeastDirection * modes.values.maxCoeff();
    Eigen::Index from = 0;
    while (from + 1 < r.cols() && !(modes.values[from] > least)) ++from;
    const Eigen::MatrixXd kept = modes.vectors.rightCols(r.cols() - from);
    Compressed out{Eigen::MatrixXd::Zero(r.rows(), kept.cols()), kept.transpose()};
    add_product(r, kept, 1, out.columns);
    return out;
  }

  /// The residual of the equation of motion at the instants.
  Eigen::MatrixXd residual() const {
    Eigen::MatrixXd r =
        Eigen::MatrixXd::Zero(forces_.shapes.rows(), static_cast<Eigen::Index>(at_.size()));
    add_product(forces_.static_, columns(drive_.s, at_), 1, r);
    add_product(forces_.viscous, columns(drive_.rate, at_), 1, r);
    add_product(forces_.inertial, columns(drive_.second, at_), 1, r);
    add_product(basis_.k_vectors(), columns(motion_.d, at_), -1, r);
    add_product(basis_.c_vectors(), columns(motion_.v, at_), -1, r);
    add_product(basis_.m_vectors(), columns(motion_.a, at_), -1, r);
    return r;
  }

  PartitionedFactor& factor_;
  const Drive& drive_;
  const ReducedOptions& options_;
  DriveForces forces_;
  Eigen::VectorXd flexibility_;  // inverse diagonal stiffness of each unknown; 0: prescribed
  Basis basis_;
  std::vector<int> at_;
  ReducedMotion motion_;
  std::vector<double> changes_;  // greatest change of a node's motion in each growth (m)
  double greatest_ = 0;
};

/// Checks that `a` has the given size and finite numbers only.
void check_course(std::string_view what, const Eigen::MatrixXd& a, Eigen::Index rows,
                  Eigen::Index columns) {
  require(a.rows() == rows && a.cols() == columns, "Drive::{} is {} x {}: expected {} x {}", what,
          a.rows(), a.cols(), rows, columns);
  if (a.allFinite()) return;
  for (Eigen::Index c = 0; c < columns; ++c)
    for (Eigen::Index r = 0; r < rows; ++r)
      require(std::isfinite(a(r, c)), "Drive::{} has {} at ({}, {}): expected finite numbers", what,
              a(r, c), r, c);
}

/// `moving`: the rates of the drive are used and therefore checked, too.
void check_drive(const Drive& drive, const Partition& partition, bool moving) {
  const Eigen::Index shapes = drive.shapes();
  check_course("prescribed", drive.prescribed, Eigen::Index(partition.prescribed.size()), shapes);
  if (drive.force.rows() > 0) check_course("force", drive.force, partition.unknowns(), shapes);
  const Eigen::Index times = drive.s.cols();
  check_course("s", drive.s, shapes, times);
  require(times >= (moving ? 2 : 1), "Drive::s has {} instants: expected at least {}", times,
          moving ? 2 : 1);
  if (!moving) return;
  check_course("rate", drive.rate, shapes, times);
  check_course("second", drive.second, shapes, times);
}

/// The columns at the given times in steps, interpolated linearly.
Eigen::MatrixXd columns_at(const Eigen::MatrixXd& course,
                           const std::vector<double>& times_in_steps) {
  Eigen::MatrixXd at(course.rows(), static_cast<Eigen::Index>(times_in_steps.size()));
  for (std::size_t i = 0; i < times_in_steps.size(); ++i) {
    require(std::isfinite(times_in_steps[i]), "time {} is {}: expected a finite number (steps)", i,
            times_in_steps[i]);
    const double t = std::clamp(times_in_steps[i], 0.0, static_cast<double>(course.cols() - 1));
    const auto before = std::min(static_cast<Eigen::Index>(t), course.cols() - 1);
    const auto after = std::min(before + 1, course.cols() - 1);
    const double share = t - static_cast<double>(before);
    at.col(i) = (1 - share) * course.col(before) + share * course.col(after);
  }
  return at;
}

}  // namespace

Eigen::MatrixXd Response::displacement(const std::vector<double>& times_in_steps) const {
  const Eigen::MatrixXd at = columns_at(course, times_in_steps);
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(shapes.rows(), at.cols());
  add_product(shapes, at, 1, d);
  return d;
}

Response sum_of(const Response& a, const Response& b, double factor) {
  require(a.shapes.rows() == b.shapes.rows() && a.course.cols() == b.course.cols(),
          "sum_of(): responses of {} and {} unknowns, {} and {} instants: expected as many each",
          a.shapes.rows(), b.shapes.rows(), a.course.cols(), b.course.cols());
  Response out;
  out.shapes.resize(a.shapes.rows(), a.shapes.cols() + b.shapes.cols());
  out.shapes << a.shapes, b.shapes;
  out.course.resize(a.course.rows() + b.course.rows(), a.course.cols());
  out.course << a.course, factor * b.course;
  out.basis_size = a.basis_size + b.basis_size;
  const std::vector<int> at = instants(static_cast<int>(out.course.cols()) - 1);
  out.greatest_displacement_m =
      greatest_node_motion(out.displacement(std::vector<double>(at.begin(), at.end())));
  const double error = a.estimated_error * a.greatest_displacement_m +
                       std::abs(factor) * b.estimated_error * b.greatest_displacement_m;
  if (error > 0) out.estimated_error = error / out.greatest_displacement_m;
  out.converged = a.converged && b.converged;
  out.passes = a.passes + b.passes;
  return out;
}

ReducedModel::ReducedModel(System system, std::vector<int> prescribed,
                           std::shared_ptr<const NodeOrder> order)
    : system_(std::move(system)),
      factor_(system_.stiffness, std::move(prescribed), "reduced model", std::move(order)) {}

void ReducedModel::refill(System system) {
  check_system(system);
  system_ = std::move(system);
  factor_.refactor(system_.stiffness);
}

Eigen::MatrixXd ReducedModel::at_rest(const Drive& drive,
                                      const std::vector<double>& times_in_steps) {
  check_drive(drive, factor_.partition(), false);
  const Eigen::MatrixXd s = columns_at(drive.s, times_in_steps);
  Eigen::MatrixXd d = with_zeros(drive.prescribed * s, factor_.prescribed(), system_.mass.rows());
  Eigen::MatrixXd force = -symmetric_product(system_.stiffness, d);
  if (drive.force.rows() > 0) force.noalias() += drive.force * s;
  Eigen::MatrixXd x = rows_of_free_nodes(force, factor_.partition());
  factor_.solve(x);
  d += with_zeros(x, factor_.free(), d.rows());
  return d;
}

Eigen::MatrixXd ReducedModel::at_rest(const Eigen::MatrixXd& force) {
  check_rows("the force", force.rows(), factor_.partition().unknowns());
  Eigen::MatrixXd x = rows_of_free_nodes(force, factor_.partition());
  factor_.solve(x);
  return with_zeros(x, factor_.free(), force.rows());
}

Response ReducedModel::run(const Drive& drive, const ReducedOptions& options) {
  check_drive(drive, factor_.partition(), true);
  check_positive("ReducedOptions::tolerance", options.tolerance);
  check_positive("ReducedOptions::most_vectors", options.most_vectors);
  check_positive("NewmarkOptions::dt_s", options.time.dt_s, " (s)");
  Growth growth(system_, factor_, drive, options);
  growth.begin();
  double error = 0;
  int passes = 0;
  bool converged = false;
  while (!converged && growth.size() < options.most_vectors) {
    if (options.between_growths) options.between_growths();
    error = growth.grow();
    ++passes;
    converged = error <= std::max(options.tolerance * growth.greatest(), options.allowed_m);
  }
  Response response = growth.response();
  response.estimated_error = growth.greatest() > 0 ? error / growth.greatest() : 0;
  response.converged = converged;
  response.passes = passes;
  return response;
}

}  // namespace hyperex::fem
