// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/recording_jitter.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "hyperex/metrics/symmetry.hpp"
#include "hyperex/motion/jitter.hpp"
#include "hyperex/scene/recording_file.hpp"

namespace hyperex::session {
namespace {

/// Smaller estimates may result from rounding and from the motion itself; the resolution of a run
/// is 0.1 mm.
constexpr double kNone_m = 1e-5;

/// The columns of the points that S(t) uses, because they matter most; all points if the recording
/// lacks these.
std::vector<int> judged_columns(const motion::Motion& m) {
  std::vector<int> columns = metrics::symmetry_columns(m);
  if (!columns.empty()) return columns;
  columns.resize(m.names.size());
  std::iota(columns.begin(), columns.end(), 0);
  return columns;
}

/// A recording too short for its fourth differences, at most some 20 frames.
RecordedJitter jitter_of_short(const motion::Motion& m) {
  const double jitter_m = metrics::jitter_at_rest(m);
  if (!std::isfinite(jitter_m))
    return {0, false, "the recording is too short to measure its jitter"};
  return {jitter_m, true,
          fmt::format("jitter of the tracked points in their quietest half second, as the "
                      "recording is short: {:.2f} mm",
                      1e3 * jitter_m)};
}

}  // namespace

RecordedJitter recorded_jitter(const motion::Motion& m) {
  const double jitter_m = motion::jitter_of_motion(m, judged_columns(m));
  if (std::isnan(jitter_m))
    return {0, false, "the recording is too short to measure its jitter", true};
  if (jitter_m < kNone_m)
    return {0, false, "no jitter shows in the recorded points: they are exact, or smoothed"};
  return {jitter_m, true,
          fmt::format(
              "jitter of the recorded points, estimated from their fourth differences in "
              "time: {:.2f} mm; constant errors and smoothing of the recording are not included",
              1e3 * jitter_m)};
}

void settle_jitter(const scene::Scene& scene, Extent extent, const motion::Motion& m, Inputs& in) {
  if (scene.output.jitter_m >= 0) {
    in.jitter_m = scene.output.jitter_m;
    if (in.jitter_m > 0)
      in.notes.push_back(make_note(
          "recording.jitter_stated",
          fmt::format("jitter of the recorded points, as output.jitter_mm states it: {:.2f} mm",
                      1e3 * in.jitter_m)));
    return;
  }
  const bool tracked = !scene.motion.recording.empty();
  if (scene.motion.source.embedded || (tracked && extent != Extent::full)) return;
  RecordedJitter found = recorded_jitter(m);
  if (found.too_short && tracked) found = jitter_of_short(m);
  in.jitter_m = found.jitter_m;
  in.jitter_known = found.known || of_weights(scene);
  if (in.jitter_m > 0)
    in.notes.push_back(
        make_note("recording.jitter", found.how + " (output.jitter_mm sets another)"));
  else
    in.notes.push_back(make_note(
        "recording.no_jitter",
        found.how + (in.jitter_known
                         ? "; the points of a face model are taken as exact (output.jitter_mm sets "
                           "a jitter)"
                         : "; how much of a difference between the sides is noise is not known "
                           "(output.jitter_mm states the jitter, 0 for exact points)")));
}

}  // namespace hyperex::session
