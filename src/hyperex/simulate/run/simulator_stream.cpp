// SPDX-License-Identifier: GPL-3.0-or-later
// A motion that comes in sample after sample.
#include <fmt/format.h>

#include <stdexcept>

#include "hyperex/core/error.hpp"
#include "hyperex/simulate/run/simulator_impl.hpp"

namespace hyperex::simulate {

void Simulator::Impl::start_stream(double interval_s) {
  if (!(interval_s > 0))
    throw InputError("stream",
                     fmt::format("interval_s = {:g}: expected more than 0 s", interval_s));
  if (options.region.measured == Measured::all)
    throw InputError("stream", "the whole skin is measured: there is nothing to simulate");
  if (by_forces())
    throw InputError("stream", "forces need the whole motion: expected drive.by = displacement");
  if (options.model.strain == Strain::finite || options.contact.lips)
    throw InputError("stream",
                     "a stream knows neither finite strain nor contact: expected model.strain = "
                     "linear and contact.lips = false");
  stream.reset();
  renew_stream(interval_s);
}

void Simulator::Impl::renew_stream(double interval_s) {
  need_region();
  need_boundary();
  need_assembler();
  fem::System system;
  fill(system);
  if (stream && stream_fits) {
    stream->refill(std::move(system), *boundary);
  } else {
    stream.emplace(std::move(system), *boundary, interval_s, options.solver.linear, known_order());
    keep_order(stream->order());
  }
  stream_current = stream_fits = true;
}

PointsF Simulator::Impl::step(const Points& displacement_m) {
  if (!stream) throw std::logic_error("Simulator::step before start_stream");
  if (displacement_m.rows() != motion->rest.rows() || !displacement_m.allFinite())
    throw InputError("stream", fmt::format("{} rows: expected {} points, all finite",
                                           displacement_m.rows(), motion->rest.rows()));
  if (!stream_current) renew_stream(stream->interval_s());
  const Points points = options.drive.gain * displacement_m;
  return readout->skin(*region, driven_points->rim, stream->step(points), points);
}

}  // namespace hyperex::simulate
