// SPDX-License-Identifier: GPL-3.0-or-later
// A motion that comes in sample after sample.
#include <fmt/format.h>

#include <stdexcept>

#include "hyperex/core/error.hpp"
#include "hyperex/motion/wild_samples.hpp"
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
  if (options.model.strain == Strain::finite)
    throw InputError("stream", "a stream has no finite strain: expected model.strain = linear");
  if (options.contact.teeth || options.contact.eyes)
    throw InputError("stream",
                     "a stream keeps only the lips apart: expected contact.teeth = false and "
                     "contact.eyes = false");
  stages.stream.drop();
  stream_interval_s = interval_s;
  ensure_stream();
}

void Simulator::Impl::ensure_stream() {
  ensure_skin();
  ensure_boundary();
  ensure_pattern();
  stages.stream.ensure(
      [&] {
        fem::System system;
        fill(system);
        Stream stream(std::move(system), *stages.values->boundary, *stream_interval_s,
                      known_order());
        keep_order(stream.order());
        return stream;
      },
      [&](Stream& stream) {
        fem::System system;
        fill(system);
        stream.refill(std::move(system), *stages.values->boundary);
      });
}

PointsF Simulator::Impl::step(const Points& displacement_m) {
  if (!stream_interval_s) throw std::logic_error("Simulator::step before start_stream");
  if (displacement_m.rows() != motion->rest.rows())
    throw InputError("stream", fmt::format("{} rows: expected {} points", displacement_m.rows(),
                                           motion->rest.rows()));
  for (Eigen::Index row = 0; row < displacement_m.rows(); ++row)
    if (!displacement_m.row(row).allFinite())
      throw InputError("stream", fmt::format("point {} of {} is not finite ({}): expected three "
                                             "numbers, metres",
                                             row + 1, displacement_m.rows(),
                                             motion->motion.names[std::size_t(row)]));
  // Displacements are small beside the points' distances from the origin, save by chance.
  if ((displacement_m - motion->rest).norm() < 0.1 * motion->rest.norm())
    throw InputError("stream",
                     "these are the points' places: expected displacements since rest, which are "
                     "the places less motion.rest_m");
  if (Eigen::Index row = 0; displacement_m.rowwise().norm().maxCoeff(&row) > motion::kFarthest_m)
    throw InputError(
        "stream",
        fmt::format("point {} is displaced by {:.4g} mm: expected at most {:g}; displacements are "
                    "in metres",
                    motion->motion.names[std::size_t(row)], 1e3 * displacement_m.row(row).norm(),
                    1e3 * motion::kFarthest_m));
  ensure_stream();
  const Points points = options.drive.gain * displacement_m;
  const auto skin_of = [&](const Eigen::Ref<const Points>& nodes) {
    return stages.readout->skin(stages.measured.value(), stages.points->rim, nodes, points);
  };
  const Eigen::Map<const Points> nodes = stages.stream->step(points);
  PointsF skin = skin_of(nodes);
  const LipSurfaces& lips = *stages.readout->lip_surfaces();
  if (!options.contact.lips || lips.empty() || lips.depth(skin) < MouthContact::kFelt_m)
    return skin;
  ensure_obstacle_places();
  ensure_contact_model();
  return skin_of(with_lips_apart(nodes, skin));
}

}  // namespace hyperex::simulate
