// SPDX-License-Identifier: GPL-3.0-or-later
// Contact: correction of frames that were simulated without it.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "hyperex/core/stopwatch.hpp"
#include "hyperex/simulate/run/finite_contact.hpp"
#include "hyperex/simulate/run/simulator_impl.hpp"

namespace hyperex::simulate {
namespace {

constexpr int kMostHalvings = 3;

/// Rows of the free unknowns, of forces on some nodes.
Eigen::MatrixXd on_free(const fem::PartitionedFactor& factor, Eigen::Index unknowns,
                        const std::vector<int>& nodes, const Eigen::MatrixXd& force) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(unknowns, force.cols());
  for (std::size_t n = 0; n < nodes.size(); ++n)
    all.middleRows<3>(3 * Eigen::Index(nodes[n])) = force.middleRows<3>(3 * Eigen::Index(n));
  return all(factor.free(), Eigen::all);
}

}  // namespace

double Simulator::Impl::correct_linear(const ContactFrames& frames,
                                       const std::vector<std::size_t>& touching,
                                       Solution& solution) {
  const MouthContact& contact = stages.contact_model->contact;
  std::vector<MouthContact::Correction> corrections(touching.size());
  progress.for_frames(touching.size(), [&](std::size_t i) {
    const std::size_t frame = touching[i];
    corrections[i] = contact.correct(
        {frames.skin(frame), frames.at_sides(frame), frames.jaw(frame), frames.upper_teeth()});
  });
  Eigen::MatrixXd force(3 * Eigen::Index(contact.nodes().size()), Eigen::Index(touching.size()));
  double residual_m = 0;
  for (std::size_t i = 0; i < touching.size(); ++i) {
    force.col(Eigen::Index(i)) = corrections[i].force;
    residual_m = std::max(residual_m, corrections[i].residual_m);
  }
  fem::PartitionedFactor& factor = *stages.contact_model->factor;
  Eigen::MatrixXd moved = on_free(factor, solution.displacement.rows(), contact.nodes(), force);
  factor.solve(moved);
  for (std::size_t i = 0; i < touching.size(); ++i)
    solution.displacement.col(Eigen::Index(touching[i]))(factor.free()) +=
        moved.col(Eigen::Index(i));
  return residual_m;
}

Points Simulator::Impl::with_lips_apart(const Eigen::Map<const Points>& nodes,
                                        const PointsF& skin) {
  const MouthContact& contact = stages.contact_model->contact;
  const MouthContact::Correction correction =
      contact.correct({skin, {}, Eigen::Isometry3d::Identity()});
  fem::PartitionedFactor& factor = *stages.contact_model->factor;
  Eigen::MatrixXd moved = on_free(factor, nodes.size(), contact.nodes(), correction.force);
  factor.solve(moved);
  Points apart = nodes;
  apart.reshaped<Eigen::RowMajor>()(factor.free()) += moved.col(0);
  return apart;
}

double Simulator::Impl::correct_finite(const ContactFrames& frames,
                                       const std::vector<std::size_t>& touching,
                                       const PointCurve& points, Solution& solution) {
  const Boundary& boundary = stages.boundary.value();
  fem::SparseMatrix springs = stages.pattern->stiffness_pattern();
  boundary.add_springs(springs);
  std::vector<int> prescribed = boundary.prescribed();
  if (!by_forces()) {
    add_patch_springs(*mesh, boundary.driven_nodes(), options.contact.patch_pa_per_m, springs);
    prescribed = boundary.released().prescribed();
  }
  springs.prune(0.0);
  fem::FiniteNewtonOptions how;
  how.tolerance = options.solver.finite_tolerance;
  how.most_halvings = kMostHalvings;
  FiniteCorrection tissue(grown_pattern(), material(), options.model.law, std::move(springs),
                          std::move(prescribed), how, by_forces() ? known_order() : nullptr);
  FiniteContact contact(stages.contact_model->contact, tissue, frames,
                        [&](std::size_t i, const Points& nodes) {
                          return stages.readout->skin(stages.measured.value(), stages.points->rim,
                                                      nodes, points.at(frames.time_of(i).time_s));
                        });
  progress.begin_part(kBeforeFiniteContact, 1);
  for (std::size_t i = 0; i < touching.size(); ++i) {
    progress.throw_if_cancelled();
    contact.correct(touching[i], solution.displacement.col(Eigen::Index(touching[i])));
    progress.report(0.9 * double(i + 1) / double(touching.size()));
  }
  report.iterations += tissue.iterations();
  report.factorisations += tissue.factorisations();
  if (contact.given_up() > 0)
    warn("contact.no_equilibrium", "",
         fmt::format("in {} frames no equilibrium with contact was found at finite strain: "
                     "surfaces there still pass through each other, by {:.2f} mm or more",
                     contact.given_up(), 1e3 * contact.hopeless_m()));
  return contact.residual_m();
}

void Simulator::Impl::resolve_contact(const std::vector<FrameTime>& frame_times,
                                      const PointCurve& points, Solution& solution,
                                      SimulationResult& result) {
  Stopwatch watch;
  SimulationReport::Contact& summary = report.contact;
  summary = {};
  ensure_obstacle_places();
  ContactFrames frames(options.contact.lips ? stages.readout->lip_surfaces().get() : nullptr,
                       stages.places.value(), frame_times, solution, result,
                       stages.moved_bones->upper_teeth);
  std::vector<std::size_t> all(frame_times.size());
  std::iota(all.begin(), all.end(), std::size_t(0));
  frames.measure(all, progress);
  const ContactDepths before = frames.greatest();
  summary.overlap_mm = 1e3 * before.lips;
  summary.teeth_mm = 1e3 * before.teeth;
  summary.eyes_mm = 1e3 * before.eyes;
  const std::vector<std::size_t> touching = frames.touching();
  if (!touching.empty()) {
    stages.near.set(frames.near_places(touching));
    progress.throw_if_cancelled();
    ensure_contact_model();
    progress.throw_if_cancelled();
    for (const std::size_t i : touching) summary.frames += !frame_times[i].is_still();
    summary.residual_mm = 1e3 * (options.model.strain == Strain::finite
                                     ? correct_finite(frames, touching, points, solution)
                                     : correct_linear(frames, touching, solution));
    progress.for_frames(touching.size(), [&](std::size_t i) {
      store(frame_times[touching[i]], frames.nodes(touching[i]), points, result);
    });
    frames.measure(touching, progress);
  }
  const ContactDepths after = frames.greatest();
  summary.left_mm = 1e3 * after.lips;
  summary.teeth_left_mm = 1e3 * after.teeth;
  summary.eyes_left_mm = 1e3 * after.eyes;
  summary.seconds = watch.lap();
}

}  // namespace hyperex::simulate
