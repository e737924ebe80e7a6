// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/recording_jitter.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "hyperex/metrics/symmetry.hpp"
#include "hyperex/motion/jitter.hpp"

namespace hyperex::scene {
namespace {

/// What rounding and the course of a motion itself may leave; the resolution of a run is 0.1 mm.
constexpr double kNone_m = 1e-5;

void from_tracking(const motion::Motion& m, Inputs& in) {
  const double jitter_m = metrics::jitter_at_rest(m);
  if (std::isfinite(jitter_m)) in.jitter_m = jitter_m;
  in.notes.push_back(
      std::isfinite(jitter_m)
          ? fmt::format("jitter of the tracked points in their quietest half second: {:.2f} mm; "
                        "lasting errors of tracking are not in it",
                        1e3 * jitter_m)
          : "the recording is too short to tell its jitter: S(t) has no noise floor");
}

/// The points that S(t) takes, as they matter most; of a recording without them all points.
std::vector<int> judged_columns(const motion::Motion& m) {
  std::vector<int> columns = metrics::symmetry_columns(m);
  if (!columns.empty()) return columns;
  columns.resize(m.names.size());
  std::iota(columns.begin(), columns.end(), 0);
  return columns;
}

void from_differences(const motion::Motion& m, Inputs& in) {
  const double jitter_m = motion::jitter_of_motion(m, judged_columns(m));
  if (std::isnan(jitter_m)) {
    in.notes.push_back(
        "the recording is too short to tell its jitter, so figures of symmetry are judged by the "
        "mesh alone; output.jitter_mm states it");
  } else if (jitter_m < kNone_m) {
    in.notes.push_back(
        "no jitter shows in the recorded points: they are exact, or smoothed; figures of symmetry "
        "are judged by the mesh alone (output.jitter_mm states a jitter)");
  } else {
    in.jitter_m = jitter_m;
    in.notes.push_back(fmt::format(
        "jitter of the recorded points, estimated from their fourth differences in time: {:.2f} "
        "mm; errors that last and what was smoothed away are not in it (output.jitter_mm states "
        "another)",
        1e3 * jitter_m));
  }
}

}  // namespace

void settle_jitter(const Scene& scene, Look look, const motion::Motion& m, Inputs& in) {
  if (scene.output.jitter_m >= 0) {
    in.jitter_m = scene.output.jitter_m;
    if (in.jitter_m > 0)
      in.notes.push_back(
          fmt::format("jitter of the recorded points, as output.jitter_mm states it: {:.2f} mm",
                      1e3 * in.jitter_m));
  } else if (scene.motion.source.embedded) {
    return;
  } else if (scene.motion.recording.empty()) {
    from_differences(m, in);
  } else if (look == Look::whole) {
    from_tracking(m, in);
  }
}

}  // namespace hyperex::scene
