// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/load/held_load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hyperex/core/error.hpp"
#include "hyperex/fem/solve/static_solve.hpp"
#include "hyperex/motion/resample.hpp"
#include "hyperex/muscles/muscle_names.hpp"
#include "hyperex/muscles/muscle_template.hpp"
#include "hyperex/simulate/drive/input_shapes.hpp"

namespace hyperex::simulate {
namespace {

constexpr Eigen::Index kJawRows = 12;

/// The counterpart's index.
int counterpart(const std::vector<std::string>& muscles, std::size_t m) {
  const auto it = std::find(muscles.begin(), muscles.end(), muscles::other_side(muscles[m]));
  return static_cast<int>(it == muscles.end() ? m : it - muscles.begin());
}

/// Whether a gain on the whole branch of this muscle, on its side, would change others that keep
/// their strength. `factor`: one per muscle.
bool more_on_branch(const std::vector<std::string>& names, const Eigen::VectorXd& factor,
                    Eigen::Index muscle, const muscles::MuscleTable& table) {
  const std::string& own = names[std::size_t(muscle)];
  const std::string side = own.substr(own.size() - 2);
  const muscles::TemplateMuscle* row = muscles::find_muscle(own.substr(0, own.size() - 2), table);
  if (!row || row->branch.empty()) return false;
  for (Eigen::Index m = 0; m < factor.size(); ++m)
    if (factor[m] == 1 &&
        muscles::names_for(names[std::size_t(m)], table).contains(row->branch + side))
      return true;
  return false;
}

/// The course of the load, perhaps changed, at times.
Eigen::MatrixXd at_times(const HeldLoad& load, const Eigen::MatrixXd& course,
                         const std::vector<double>& times_s) {
  const std::vector<double>& time_s = load.time_s;
  const auto count = static_cast<Eigen::Index>(times_s.size());
  Eigen::MatrixXd out(course.rows(), count);
  if (time_s.size() < 2) return course.col(0).replicate(1, count);
  const Eigen::MatrixXd slope =
      motion::bounded_slopes(time_s, course.transpose(), load.smooth_up_to_s).transpose();
  const auto last = static_cast<Eigen::Index>(time_s.size()) - 1;
  for (Eigen::Index k = 0; k < count; ++k) {
    const double t = times_s[std::size_t(k)];
    const auto next = std::upper_bound(time_s.begin() + 1, time_s.begin() + last, t);
    const Eigen::Index i = next - time_s.begin() - 1;
    const double h = time_s[std::size_t(i) + 1] - time_s[std::size_t(i)];
    const double x = std::clamp((t - time_s[std::size_t(i)]) / h, 0.0, 1.0);
    const double y = 1 - x;
    out.col(k) = (1 + 2 * x) * y * y * course.col(i) + x * x * (3 - 2 * x) * course.col(i + 1) +
                 h * x * y * (y * slope.col(i) - x * slope.col(i + 1));
  }
  return out;
}

/// At `count` times, `dt_s` apart, from 0.
Eigen::MatrixXd at_steps(const HeldLoad& load, const Eigen::MatrixXd& course, double dt_s,
                         Eigen::Index count) {
  std::vector<double> times_s;
  for (Eigen::Index k = 0; k < count; ++k) times_s.push_back(static_cast<double>(k) * dt_s);
  return at_times(load, course, times_s);
}

}  // namespace

Eigen::VectorXd muscle_gains(const std::vector<std::string>& muscles,
                             const std::vector<MuscleGain>& gains,
                             const muscles::MuscleTable& table) {
  Eigen::VectorXd factor = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(muscles.size()));
  for (const MuscleGain& gain : gains) {
    bool found = false;
    for (std::size_t m = 0; m < muscles.size(); ++m) {
      if (!muscles::names_for(muscles[m], table).contains(gain.muscle)) continue;
      factor[static_cast<Eigen::Index>(m)] *= gain.gain;
      found = true;
    }
    if (found) continue;
    throw InputError("muscles.gain", fmt::format("{} is no muscle; expected {}", gain.muscle,
                                                 muscles::gain_expected(gain.muscle, table)));
  }
  return factor;
}

double common_change(const Eigen::VectorXd& change, const std::vector<int>& muscles) {
  if (muscles.empty()) return 0;
  double common = change[muscles.front()];
  for (const int m : muscles) {
    if (common * change[m] <= 0) return 0;
    if (std::abs(change[m]) < std::abs(common)) common = change[m];
  }
  return common;
}

MuscleCourse muscles_until(MuscleCourse muscles, double end_s) {
  constexpr double slack_s = 1e-9;  // of times that are written as decimals
  std::vector<double>& time_s = muscles.time_s;
  const auto after = std::upper_bound(time_s.begin(), time_s.end(), end_s + slack_s);
  if (after == time_s.begin() || after == time_s.end()) return muscles;
  const Eigen::Index kept = after - time_s.begin();
  const double before_s = *(after - 1), share = (end_s - before_s) / (*after - before_s);
  const Eigen::Index added = end_s - before_s > slack_s ? 1 : 0;
  for (Eigen::MatrixXd* course :
       {&muscles.activation, &muscles.sigma, &muscles.prior_sigma, &muscles.group_activation,
        &muscles.group_sigma, &muscles.group_prior_sigma}) {
    if (course->cols() <= kept) continue;  // not known
    if (added > 0)
      course->col(kept) = (1 - share) * course->col(kept - 1) + share * course->col(kept);
    course->conservativeResize(Eigen::NoChange, kept + added);
  }
  Eigen::VectorXd& opening = muscles.jaw_opening_deg;
  if (opening.size() > kept) {
    if (added > 0) opening[kept] = (1 - share) * opening[kept - 1] + share * opening[kept];
    opening.conservativeResize(kept + added);
  }
  time_s.resize(std::size_t(kept));
  if (added > 0) time_s.push_back(end_s);
  return muscles;
}

double greatest_opening_deg(const HeldLoad& load, double end_s) {
  const Eigen::VectorXd opening = muscles_until(load.muscles, end_s).jaw_opening_deg;
  return opening.size() > 0 ? opening.maxCoeff() : load.greatest_opening_deg;
}

MuscleCourse changed_muscles(const MuscleCourse& muscles, const MuscleOptions& options) {
  MuscleCourse out = muscles;
  if (muscles.names.empty() || (!options.mirrored && options.gains.empty())) return out;
  const Eigen::VectorXd factor = muscle_gains(muscles.names, options.gains, options.table());
  for (Eigen::MatrixXd* course : {&out.activation, &out.sigma, &out.prior_sigma}) {
    if (course->rows() == 0) continue;
    const Eigen::MatrixXd recorded = *course;
    for (std::size_t m = 0; m < muscles.names.size(); ++m) {
      const auto own = static_cast<Eigen::Index>(m);
      const Eigen::Index from = options.mirrored ? counterpart(muscles.names, m) : own;
      course->row(own) = factor[own] * recorded.row(from);
    }
  }
  out.groups.clear();
  for (Eigen::MatrixXd* course : {&out.group_activation, &out.group_sigma, &out.group_prior_sigma})
    course->resize(0, 0);
  return out;
}

std::string hardly_used_text(const MuscleCourse& recorded, const MuscleOptions& options) {
  if (recorded.names.empty() || recorded.activation.cols() == 0) return {};
  const Eigen::VectorXd factor = muscle_gains(recorded.names, options.gains, options.table());
  Eigen::Index most = -1, when = 0;
  for (Eigen::Index m = 0; m < factor.size(); ++m) {
    if (factor[m] == 1) continue;
    Eigen::Index at = 0;
    const double greatest = recorded.activation.row(m).cwiseAbs().maxCoeff(&at);
    if (greatest > recorded.sigma(m, at)) return {};
    if (most < 0 || greatest > std::abs(recorded.activation(most, when))) most = m, when = at;
  }
  if (most < 0) return {};
  return fmt::format(
      "in this recording {} is active by at most {:.2f} +- {:.2f} (1 sigma), less than its "
      "uncertainty, so that the effect of its strength is hardly known; a recording that uses it "
      "more, such as a broad smile,{} shows more",
      recorded.names[std::size_t(most)], recorded.activation(most, when),
      recorded.sigma(most, when),
      more_on_branch(recorded.names, factor, most, options.table())
          ? " or a gain on the whole branch of the nerve"
          : "");
}

Eigen::MatrixXd group_sums(const MuscleCourse& muscles, const std::vector<std::string>& groups,
                           const muscles::MuscleTable& table) {
  Eigen::MatrixXd sums =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(groups.size()), muscles.activation.cols());
  for (std::size_t m = 0; m < muscles.names.size(); ++m) {
    const std::string& name = muscles.names[m];
    const std::string side = name.substr(name.size() - 2);
    const muscles::TemplateMuscle* muscle =
        muscles::find_muscle(name.substr(0, name.size() - 2), table);
    if (!muscle) continue;
    const auto group = std::find(groups.begin(), groups.end(), muscle->group + side);
    if (group != groups.end())
      sums.row(group - groups.begin()) += muscles.activation.row(static_cast<Eigen::Index>(m));
  }
  return sums;
}

Eigen::MatrixXd course_at(const HeldLoad& load, Eigen::Index first_row, Eigen::Index rows,
                          const std::vector<double>& times_s) {
  return at_times(load, load.course.middleRows(first_row, rows), times_s);
}

Eigen::Index jaw_row(const HeldLoad& load) {
  return (load.wide_bands ? 2 : 1) * Eigen::Index(load.muscles.names.size());
}

namespace {

/// Index of the first column after those of the muscles and the jaw.
Eigen::Index unexplained_row(const HeldLoad& load) {
  return jaw_row(load) + kJawRows;
}

/// By how much the unexplained motion of each part changes with the muscles.
Eigen::VectorXd changes_of_parts(const HeldLoad& load, const Eigen::VectorXd& change) {
  Eigen::VectorXd out(Eigen::Index(load.part_makers.size()));
  for (std::size_t part = 0; part < load.part_makers.size(); ++part)
    out[Eigen::Index(part)] = common_change(change, load.part_makers[part]);
  return out;
}

/// The course after mirroring and gains.
Eigen::MatrixXd changed_course(const HeldLoad& load, const MuscleOptions& options) {
  Eigen::MatrixXd course = load.course;
  const auto& names = load.muscles.names;
  if (names.empty()) return course;
  const Eigen::VectorXd factor = muscle_gains(names, options.gains, options.table());
  const auto count = static_cast<Eigen::Index>(names.size());
  for (Eigen::Index m = 0; m < (load.wide_bands ? 2 : 1) * count; ++m) {
    const Eigen::Index own = m % count;
    const int from = options.mirrored ? counterpart(names, std::size_t(own)) : int(own);
    course.row(m) = factor[own] * load.course.row(m - own + from);
  }
  const Eigen::VectorXd change = factor.array() - 1;
  const Eigen::VectorXd of_part = changes_of_parts(load, change);
  for (std::size_t i = 0; i < load.parts.size(); ++i)
    course.row(unexplained_row(load) + Eigen::Index(i)) *= 1 + of_part[load.parts[i]];
  return course;
}

}  // namespace

Eigen::VectorXd force_at(const HeldLoad& load, const MuscleOptions& options, double time_s) {
  const Eigen::VectorXd now = at_times(load, changed_course(load, options), {time_s});
  Eigen::VectorXd out = Eigen::VectorXd::Zero(load.force.rows());
  for (Eigen::Index k = 0; k < now.size(); ++k)  // most muscles are at rest
    if (now[k] != 0) out += now[k] * load.force.col(k);
  return out;
}

std::shared_ptr<const NodalCourse> patch_forces_with(const HeldLoad& load,
                                                     const MuscleOptions& options) {
  if (!load.patch_forces || load.part_makers.empty() || options.gains.empty())
    return load.patch_forces;
  const Eigen::VectorXd change =
      muscle_gains(load.muscles.names, options.gains, options.table()).array() - 1;
  const Eigen::VectorXd factor = (load.patch_shares * changes_of_parts(load, change)).array() + 1;
  auto out = std::make_shared<NodalCourse>(*load.patch_forces);
  for (Eigen::VectorXd& value : out->value)
    for (Eigen::Index i = 0; i < factor.size(); ++i) value.segment<3>(3 * i) *= factor[i];
  return out;
}

fem::Drive drive_of(const HeldLoad& load, const MuscleOptions& options, double dt_s, int steps,
                    double tolerance, Eigen::Index prescribed) {
  Eigen::MatrixXd course = changed_course(load, options);
  // Scales each row to the size of the force that it represents.
  const Eigen::VectorXd size = load.force.colwise().norm().transpose().cwiseMax(1e-12);
  course = size.asDiagonal() * course;
  return compressed_drive(at_steps(load, course, dt_s, steps + 1 + kBeyond), dt_s, steps, tolerance,
                          prescribed, load.force.rows(),
                          [&](const Eigen::VectorXd& direction, Eigen::Ref<Eigen::VectorXd> values,
                              Eigen::Ref<Eigen::VectorXd> force) {
                            values.setZero();
                            force.noalias() = load.force * direction.cwiseQuotient(size);
                          });
}

HeldLoad added_by_gains(const HeldLoad& load, const Eigen::VectorXd& change) {
  std::vector<Eigen::Index> changed;
  std::vector<double> by;
  const auto add = [&](Eigen::Index column, double times) {
    if (times == 0) return;
    changed.push_back(column);
    by.push_back(times);
  };
  for (Eigen::Index m = 0; m < (load.wide_bands ? 2 : 1) * change.size(); ++m)
    add(m, change[m % change.size()]);
  const Eigen::VectorXd of_part = changes_of_parts(load, change);
  for (std::size_t i = 0; i < load.parts.size(); ++i)
    add(unexplained_row(load) + Eigen::Index(i), of_part[load.parts[i]]);
  HeldLoad out;
  out.time_s = load.time_s;
  out.smooth_up_to_s = load.smooth_up_to_s;
  out.force = load.force(Eigen::all, changed);
  out.course = load.course(changed, Eigen::all);
  for (std::size_t i = 0; i < changed.size(); ++i) out.course.row(Eigen::Index(i)) *= by[i];
  return out;
}

std::vector<char> turning_columns(const HeldLoad& load, const muscles::MuscleTable& table) {
  std::vector<char> out(std::size_t(load.force.cols()), 0);
  const std::size_t count = load.muscles.names.size();
  for (std::size_t m = 0; m < (load.wide_bands ? 2 : 1) * count; ++m) {
    const std::string& name = load.muscles.names[m % count];
    const auto* muscle = muscles::find_muscle(name.substr(0, name.size() - 2), table);
    out[m] = muscle && muscle->cheek;
  }
  return out;
}

HeldLoad with_columns(const HeldLoad& load, const std::vector<char>& wanted) {
  HeldLoad out = load;
  for (std::size_t c = 0; c < wanted.size(); ++c)
    if (!wanted[c]) out.course.row(Eigen::Index(c)).setZero();
  return out;
}

HeldLoad reactions_of(const fem::Drive& drive, const fem::SparseMatrix& stiffness,
                      const std::vector<int>& prescribed, double dt_s) {
  HeldLoad load;
  const fem::StaticSolver solver(stiffness, prescribed);
  load.force.resize(stiffness.rows(), drive.shapes());
  for (Eigen::Index k = 0; k < drive.shapes(); ++k) {
    const Eigen::VectorXd force =
        drive.force.rows() > 0 ? Eigen::VectorXd(drive.force.col(k)) : Eigen::VectorXd();
    load.force.col(k) = stiffness * solver.solve(drive.prescribed.col(k), force);
  }
  load.course = drive.s;
  for (int step = 0; step <= drive.steps(); ++step) load.time_s.push_back(step * dt_s);
  return load;
}

}  // namespace hyperex::simulate
