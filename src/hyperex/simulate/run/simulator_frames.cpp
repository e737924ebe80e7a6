// SPDX-License-Identifier: GPL-3.0-or-later
// The stored frames of a run, and its report.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "hyperex/fem/form/inverted.hpp"
#include "hyperex/motion/jitter.hpp"
#include "hyperex/simulate/run/points_off.hpp"
#include "hyperex/simulate/run/simulator_impl.hpp"

namespace hyperex::simulate {

std::vector<double> Simulator::Impl::in_steps(const std::vector<FrameTime>& frame_times) const {
  std::vector<double> out;
  for (const FrameTime& at : frame_times)
    out.push_back(std::clamp(at.time_s / options.time.step_s, 0.0, static_cast<double>(steps())));
  return out;
}

void Simulator::Impl::store(const FrameTime& at, const Points& nodes, const PointCurve& points,
                            SimulationResult& result) const {
  const PointsF skin = stages.readout->skin(stages.measured.value(), stages.points->rim, nodes,
                                            points.at(at.time_s));
  if (at.is_still()) {
    result.still_displacement_m[at.index()] = skin;
    return;
  }
  Performance& p = result.performance;
  p.skin_displacement_m[at.index()] = skin;
  if (!p.node_displacement_m.empty())
    p.node_displacement_m[at.index()] = in_single_precision(nodes);
}

void Simulator::Impl::place_jaw(const PointCurve& points, SimulationResult& result) const {
  std::vector<double> times_s = result.performance.frame_time_s;
  for (const double t : options.time.still_times_s) times_s.push_back(std::min(t, end_s()));
  auto jaw = jaw_now_from_rest(times_s, points);
  const auto stills = jaw.begin() + std::ptrdiff_t(result.performance.frame_time_s.size());
  result.still_jaw_now_from_rest.assign(stills, jaw.end());
  jaw.erase(stills, jaw.end());
  result.performance.jaw_now_from_rest = std::move(jaw);
}

void Simulator::Impl::describe_tissue(Performance& p) {
  p.nodes = mesh->volume.nodes;
  p.tets = mesh->volume.tets;
  p.model = options.model;
  p.material = material();
  ensure_added_volume();
  p.growth = stages.added_volume->growth;
  const std::vector<int> held = stages.boundary->held_nodes();
  p.held_points_rest.resize(held.size(), 3);
  for (std::size_t i = 0; i < held.size(); ++i)
    p.held_points_rest.row(i) = mesh->volume.nodes.row(held[i]);
  if (progress.skin_alone()) return;
  std::vector<int> inverted(p.node_displacement_m.size());
  progress.for_frames(inverted.size(), [&](std::size_t f) {
    const auto marks = fem::inverted_tets(p.nodes, p.tets, p.node_displacement_m[f].cast<double>());
    inverted[f] = static_cast<int>(std::count(marks.begin(), marks.end(), 1));
  });
  const auto most = std::max_element(inverted.begin(), inverted.end());
  report.inverted_tets = *most;
  report.inverted_frame = *most > 0 ? int(most - inverted.begin()) : -1;
}

void Simulator::Impl::describe_skin(const PointCurve& points, Performance& p) {
  const Readout& readout = stages.readout.value();
  const DrivenPoints& driven = stages.points.value();
  p.skin_rest = mesh->skin;
  p.scan_vertices = mesh->scan_vertices;
  p.appended = mesh->appended;
  p.source_triangle = mesh->source_triangle;
  p.lip_cut_rest = mesh->lip_cut;
  p.landmarks = readout.landmark_tracks(p.frame_time_s, p.skin_displacement_m);
  p.driven_names = driven.names;
  p.driven_points_rest = driven.rest;
  if (stages.load.has_value()) {
    const MuscleCourse recorded = muscles_until(stages.load->muscles, end_s());
    p.muscles = changed_muscles(recorded, options.muscles);
    if (std::string text = hardly_used_text(recorded, options.muscles); !text.empty())
      warn("muscles.gain_hardly_used", "muscles.gain", std::move(text));
  }
  p.peak_frame = peak_frame(p.frame_time_s, options.time.peak_time_s, driven.rows, points);
  if (progress.skin_alone()) return;
  const Readout::Lips lips = readout.lips(
      p.landmarks, p.skin_displacement_m,
      [this](std::size_t count, const auto& frame) { progress.for_frames(count, frame); });
  report.lip_overlap_mm = lips.overlap_mm;
  report.lip_overlap_frame = lips.overlap_frame;
  report.lip_gap_mm = lips.gap_mm;
  // Surgery moves them away from where they were recorded.
  if (p.neutral_displacement_m.rows() == 0)
    note_driven_off(driven.off_m(p, points), points, p.frame_time_s);
}

void Simulator::Impl::note_driven_off(const std::vector<double>& off_m, const PointCurve& points,
                                      const std::vector<double>& frame_time_s) {
  const DrivenPoints& driven = stages.points.value();
  for (const double one_m : off_m)
    report.driven_off_mm = std::max(report.driven_off_mm, 1e3 * one_m);
  const std::string text = points_off_text(driven.names, off_m, kDrivenWithin_m);
  if (text.empty()) return;
  const double jitter_m =
      options.drive.gain * motion::jitter_of_motion(motion->motion, driven.rows);
  if (is_within_jitter(1e-3 * report.driven_off_mm, jitter_m)) {
    report.notes.push_back(
        make_note("drive.points_off_by_jitter", text + "; " + jitter_text(jitter_m)));
    return;
  }
  const FarthestPoint farthest =
      farthest_point(*mesh, driven, points, frame_time_s, options.time.step_s, off_m);
  const bool touched = report.contact.frames > 0;
  const std::string established = reason_of(farthest, options, touched),
                    why = "; " + (established.empty() ? likely_reason(touched) : established);
  if (is_asked_for(farthest, options))
    report.notes.push_back(make_note("drive.points_off_by_gain", text + why));
  else
    warn("drive.points_off", "drive.points", text + why);
}

void Simulator::Impl::warn(const char* id, const char* key, std::string text) {
  report.notes.push_back(make_warning(id, std::move(text), key));
}

}  // namespace hyperex::simulate
