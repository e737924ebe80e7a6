// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/run/finite_run.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/core/assert.hpp"
#include "hyperex/simulate/run/node_rotations.hpp"

namespace hyperex::simulate {
namespace {

/// Iterates of a step with which forces turn.
constexpr int kTurnedIterates = 2;

/// Courses at a time, linear between steps and held after the last.
void courses_at(const fem::Drive& drive, double steps, Eigen::VectorXd& out) {
  const double at = std::clamp(steps, 0.0, static_cast<double>(drive.steps()));
  const auto before = static_cast<Eigen::Index>(at);
  const Eigen::Index after = std::min<Eigen::Index>(before + 1, drive.steps());
  const double share = at - static_cast<double>(before);
  out = (1 - share) * drive.s.col(before) + share * drive.s.col(after);
}

/// The forces of a drive at a time; nothing is allocated after the first.
class Forces {
 public:
  Forces(const FiniteDrive& drive, const fem::Assembler& assembler)
      : drive_(drive),
        rotations_(assembler, drive.turning.force),
        still_(Eigen::VectorXd::Zero(3 * assembler.node_count())),
        turning_(still_) {}

  void at(double time_s) {
    const double steps = time_s / drive_.step_s;
    if (drive_.still.force.rows() > 0) {
      courses_at(drive_.still, steps, courses_);
      still_.noalias() = drive_.still.force * courses_;
    } else {
      still_.setZero();
    }
    if (drive_.rest_force.size() > 0) still_ += drive_.rest_force;
    if (drive_.forces) {
      drive_.forces->at(time_s, nodal_);
      for (std::size_t i = 0; i < drive_.forces->nodes.size(); ++i)
        still_.segment<3>(3 * drive_.forces->nodes[i]) += nodal_.segment<3>(3 * Eigen::Index(i));
    }
    if (turns()) {
      courses_at(drive_.turning, steps, turning_courses_);
      turning_.noalias() = drive_.turning.force * turning_courses_;
    }
  }
  /// The forces at the time of the last at(). Those of drive.turning are rotated with the tissue,
  /// which is displaced by d.
  void turned(const Eigen::VectorXd& d, Eigen::VectorXd& out) {
    out = still_;
    if (!turns()) return;
    rotations_.update(d);
    rotations_.add_turned(turning_, out);
  }

 private:
  bool turns() const { return drive_.turning.shapes() > 0; }
  const FiniteDrive& drive_;
  NodeRotations rotations_;
  Eigen::VectorXd still_, turning_, courses_, turning_courses_, nodal_;
};

/// The prescribed displacements of a drive at a time, in the order of all that is prescribed.
class Prescribed {
 public:
  Prescribed(const FiniteDrive& drive, const std::vector<int>& all, const std::vector<int>& still)
      : drive_(drive), values_(Eigen::VectorXd::Zero(Eigen::Index(all.size()))) {
    const auto place = [&](int unknown) {
      const auto at = std::lower_bound(all.begin(), all.end(), unknown);
      HX_ASSERT(at != all.end() && *at == unknown);
      return static_cast<int>(at - all.begin());
    };
    for (const int unknown : still) still_.push_back(place(unknown));
    if (drive.places)
      for (const int node : drive.places->nodes)
        for (int axis = 0; axis < 3; ++axis) places_.push_back(place(3 * node + axis));
  }
  const Eigen::VectorXd& at(double time_s) {
    courses_at(drive_.still, time_s / drive_.step_s, courses_);
    still_values_.noalias() = drive_.still.prescribed * courses_;
    if (drive_.rest_prescribed.size() > 0) still_values_ += drive_.rest_prescribed;
    for (std::size_t i = 0; i < still_.size(); ++i)
      values_[still_[i]] = still_values_[Eigen::Index(i)];
    if (drive_.places) {
      drive_.places->at(time_s, nodal_);
      for (std::size_t i = 0; i < places_.size(); ++i)
        values_[places_[i]] = nodal_[Eigen::Index(i)];
    }
    return values_;
  }

 private:
  const FiniteDrive& drive_;
  std::vector<int> still_, places_;
  Eigen::VectorXd values_, still_values_, courses_, nodal_;
};

/// Records displacements at given times, by interpolation, while the steps are computed.
class ReadOff {
 public:
  ReadOff(const std::vector<double>& times_s, const fem::FiniteNewton& newton)
      : times_s_(times_s), from_(newton.displacement()), from_v_(newton.velocity()) {
    out_.resize(from_.size(), static_cast<Eigen::Index>(times_s.size()));
    for (; next_ < times_s_.size() && times_s_[next_] <= kSame; ++next_)
      out_.col(Eigen::Index(next_)) = from_;
  }
  /// The state at time_s; Hermite's cubic from the one before.
  void take(double time_s, const Eigen::VectorXd& d, const Eigen::VectorXd& v) {
    const double h = time_s - time_s_;
    for (; next_ < times_s_.size() && times_s_[next_] <= time_s + kSame; ++next_) {
      const double x = std::min(1.0, (times_s_[next_] - time_s_) / h), y = 1 - x;
      out_.col(Eigen::Index(next_)) =
          (1 + 2 * x) * y * y * from_ + x * x * (3 - 2 * x) * d + h * x * y * (y * from_v_ - x * v);
    }
    from_ = d, from_v_ = v, time_s_ = time_s;
  }
  Eigen::MatrixXd& displacement() { return out_; }

 private:
  static constexpr double kSame = 1e-9;
  std::vector<double> times_s_;
  std::size_t next_ = 0;
  double time_s_ = 0;
  Eigen::VectorXd from_, from_v_;
  Eigen::MatrixXd out_;
};

/// Starts at rest: with moved bones in static equilibrium on them.
void begin(fem::FiniteNewton& newton, const FiniteDrive& drive, FiniteSolution& out) {
  newton.start();
  if (drive.rest_force.size() > 0) {
    HX_ASSERT(!drive.places);
    out.factorisations +=
        newton
            .equilibrium(drive.rest_prescribed, drive.rest_force, {},
                         drive.rest_guess.size() > 0 ? &drive.rest_guess : nullptr)
            .factorisations;
    out.solution.neutral = newton.displacement();
  }
}

}  // namespace

FiniteSolution run_finite(fem::FiniteNewton& newton, const fem::Assembler& assembler,
                          const std::vector<int>& still_prescribed, const FiniteDrive& drive,
                          const std::vector<double>& step_ends_s, const std::vector<double>& times,
                          const StepProgress& progress) {
  FiniteSolution out;
  Forces forces(drive, assembler);
  Prescribed prescribed(drive, newton.prescribed(), still_prescribed);
  fem::FiniteNewtonHooks hooks;
  // Forces turn with the first two iterates of a step: the second is all but its end, and later
  // iterations converge as quickly as with forces that keep their direction.
  double turned_for_s = -1;
  int turns = 0;
  Eigen::VectorXd turned;
  hooks.before_iteration = [&](const Eigen::VectorXd& d, double time_s, Eigen::VectorXd& force) {
    if (time_s != turned_for_s) turns = 0;
    turned_for_s = time_s;
    if (turns++ < kTurnedIterates) {
      forces.at(time_s);
      forces.turned(d, turned);
    }
    force = turned;
  };
  Eigen::VectorXd reactions;
  const auto take_reactions = [&] {
    if (!drive.places) return;
    const auto& nodes = out.reactions.nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      reactions.segment<3>(3 * Eigen::Index(i)) = newton.reaction().segment<3>(3 * nodes[i]);
    out.reactions.take(newton.time_s(), reactions);
  };

  begin(newton, drive, out);
  if (drive.places) {
    out.reactions.nodes = drive.places->nodes;
    reactions.setZero(3 * Eigen::Index(out.reactions.nodes.size()));
    out.reactions.take(0, reactions);
  }
  std::vector<double> times_s;
  for (const double t : times) times_s.push_back(t * drive.step_s);
  ReadOff read_off(times_s, newton);
  out.steps = static_cast<int>(step_ends_s.size()) - 1;
  hooks.after_part = [&](double time_s) {
    read_off.take(time_s, newton.displacement(), newton.velocity());
    if (progress) progress(time_s / step_ends_s.back());
  };
  for (int step = 1; step <= out.steps; ++step) {
    const double time_s = step_ends_s[std::size_t(step)];
    const fem::FiniteStepReport report =
        newton.step(time_s - newton.time_s(), prescribed.at(time_s), {}, hooks);
    out.parts += report.parts;
    out.iterations += report.iterations;
    out.factorisations += report.factorisations;
    out.solution.estimated_error = std::max(out.solution.estimated_error, report.error);
    take_reactions();
  }
  out.solution.displacement.swap(read_off.displacement());
  out.solution.free_dofs = newton.free_count();
  return out;
}

}  // namespace hyperex::simulate
