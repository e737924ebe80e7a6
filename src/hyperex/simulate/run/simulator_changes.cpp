// SPDX-License-Identifier: GPL-3.0-or-later
// Setting options, and their effect on the stages.
#include <utility>

#include "hyperex/core/error.hpp"
#include "hyperex/fem/solve/node_order.hpp"
#include "hyperex/simulate/run/simulator_impl.hpp"

namespace hyperex::simulate {

Simulator::Impl::Impl(const Impl& other)
    : mesh(other.mesh),
      landmarks(other.landmarks),
      motion(other.motion),
      obstacles(other.obstacles),
      options(other.options) {
  stages.share(other.stages);
}

void SimulatorStages::options_changed(const SimulationOptions& before,
                                      const SimulationOptions& now) {
  for (Stage* stage : own_stages())
    if (auto* source = dynamic_cast<OptionSource*>(stage); source && !source->equal(before, now))
      source->change();
}

void Simulator::Impl::set(SimulationOptions next) {
  check(next);
  const bool load_of_small_strain =
      stages.load.held() && stages.load.has_value() && !stages.load->patch_forces;
  if (load_of_small_strain && next.model.strain == Strain::finite &&
      options.model.strain == Strain::linear)
    throw InputError("model.strain",
                     "the held forces were found at small strain: expected finite in the run that "
                     "found them, too");
  const SimulationOptions before = std::exchange(options, std::move(next));
  stages.options_changed(before, options);
}

void Simulator::Impl::set(AlignedMotion next) {
  motion = std::make_shared<const AlignedMotion>(std::move(next));
  stages.motion.change();
}

void Simulator::Impl::set(std::shared_ptr<const std::vector<Obstacle>> next) {
  if (next == obstacles) return;
  obstacles = std::move(next);
  stages.obstacles.change();
}

void Simulator::Impl::use_order(std::shared_ptr<const EliminationOrder> order) {
  const auto all = static_cast<std::size_t>(3 * mesh->volume.nodes.rows());
  if (!order || !order->nodes || order->prescribed.size() + order->nodes->unknowns.size() != all)
    return;
  stages.prescribed.set(order->prescribed);
  stages.order.replace(std::move(order));
}

void Simulator::Impl::take_factor(Impl& spent) {
  const auto &own = stages.order.pointer(), &other = spent.stages.order.pointer();
  const bool same_order = own && other && own->prescribed == other->prescribed &&
                          own->nodes->unknowns == other->nodes->unknowns;
  if (!same_order || stages.pattern.pointer() != spent.stages.pattern.pointer()) return;
  stages.factor.take(spent.stages.factor);
}

}  // namespace hyperex::simulate
