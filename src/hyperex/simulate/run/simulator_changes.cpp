// SPDX-License-Identifier: GPL-3.0-or-later
// What is left of the stages when something is set.
#include <utility>

#include "hyperex/simulate/run/simulator_impl.hpp"

namespace hyperex::simulate {

namespace {

bool same_but_gain(DriveOptions a, const DriveOptions& b) {
  a.gain = b.gain;
  return a == b;
}

bool same_but_gains(const MuscleOptions& a, const MuscleOptions& b) {
  return as_recorded(a) == as_recorded(b);
}

}  // namespace

void Simulator::Impl::drop_contact() {
  contact.reset();
  contact_factor.reset();
}

void Simulator::Impl::drop_values() {
  reduced_current = full_current = false;
  response.reset();
  recorded_response.reset();
  added.reset();
  drop_contact();
  stream_current = false;
}

void Simulator::Impl::drop_factors() {
  reduced.reset();
  reduced_values.reset();
  full.reset();
  stream_fits = false;
  drop_values();
}

void Simulator::Impl::drop_input() {
  input.reset();
  response.reset();
  recorded_response.reset();
  added.reset();
}

void Simulator::Impl::drop_load() {
  if (load_held || !by_forces()) return;
  load_lost = load_lost || load;
  load.reset();
  drop_input();
}

void Simulator::Impl::drop_boundary() {
  boundary.reset();
  drop_load();
  drop_input();
  drop_values();  // the springs' stiffness; the factors go where other nodes are prescribed
}

void Simulator::Impl::drop_driven() {
  driven.reset();
  driven_points.reset();
  drop_contact();
  load.reset();
  load_lost = false;  // another question: other forces are no surprise
  drop_boundary();
}

void Simulator::Impl::drop_region() {
  region.reset();
  drop_driven();
}

void Simulator::Impl::set(SimulationOptions next) {
  check(next);
  if (load_held && load && !load->patch_forces && next.model.strain == Strain::finite &&
      options.model.strain == Strain::linear)
    throw InputError("model.strain",
                     "the forces that are held were found at small strain: expected finite in the "
                     "run that they are of, too");
  const SimulationOptions before = std::move(options);
  options = std::move(next);
  if (options.region != before.region) drop_region();
  if (!same_but_gain(before.drive, options.drive)) drop_driven();
  if (options.drive.gain != before.drive.gain) {
    load.reset();
    load_lost = false;
    drop_input();
  }
  if (!same_but_gains(before.muscles, options.muscles)) drop_driven();
  if (before.muscles != options.muscles) {  // their gains, which leave the response as recorded
    input.reset();
    response.reset();
  }
  if (options.support != before.support) drop_boundary();
  if (options.model.element != before.model.element) {
    assembler.reset();
    order.reset();
    drop_factors();
  }
  if (options.model != before.model || options.tissue != before.tissue) {
    drop_values();
    drop_load();
  }
  if (options.model.strain != before.model.strain) drop_input();
  if (options.contact != before.contact) {
    touchable.reset();
    drop_contact();
  }
  if (options.solver.linear != before.solver.linear) drop_factors();
  if (options.solver.newmark_beta != before.solver.newmark_beta ||
      options.solver.newmark_gamma != before.solver.newmark_gamma ||
      options.time.step_s != before.time.step_s)
    full.reset();
  if (options.solver != before.solver) drop_input();
  if (options.time.step_s != before.time.step_s || options.time.end_s != before.time.end_s) {
    if (options.drive.by == DriveBy::reactions) load.reset();  // at steps
    drop_input();
  }
}

void Simulator::Impl::set(AlignedMotion next) {
  motion = std::make_shared<const AlignedMotion>(std::move(next));
  drop_region();
}

}  // namespace hyperex::simulate
