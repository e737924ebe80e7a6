// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/inputs.hpp"

#include <fmt/format.h>

#include <optional>

#include "hyperex/anatomy/landmark_doubts.hpp"
#include "hyperex/core/run_together.hpp"
#include "hyperex/motion/embedded_motion.hpp"
#include "hyperex/scene/recording_file.hpp"
#include "hyperex/session/check_names.hpp"
#include "hyperex/session/driven_points.hpp"
#include "hyperex/session/idle_keys.hpp"
#include "hyperex/session/one_sided.hpp"
#include "hyperex/session/plausible.hpp"
#include "hyperex/session/problems.hpp"
#include "hyperex/session/read_bones.hpp"
#include "hyperex/session/read_recording.hpp"
#include "hyperex/session/read_scan.hpp"
#include "hyperex/session/recording_names.hpp"
#include "hyperex/session/teeth.hpp"
#include "hyperex/simulate/drive/lid_aperture.hpp"

namespace hyperex::session {
namespace {

/// Scan and recording are read at the same time; each collects notes and problems of its own.
struct Part {
  Inputs in;
  Problems problems;
};

struct Files {
  Part scan, completion, recording;  ///< `completion`: of the landmarks
  io::Landmarks given;
  std::optional<motion::StabilisedMotion> steady;
  bool scan_read = false;
};

void read_scan_files(const scene::Scene& scene, bool with_variants, Files& files) {
  Part& scan = files.scan;
  scan.problems.attempt([&] {
    read_scan(scene, scan.in);
    files.scan_read = true;
  });
  if (files.scan_read) {
    note_turned_triangles(scene, scan.in);
    scan.problems.attempt([&] { note_tissue_files(scene, scan.in, with_variants); });
  }
  scan.problems.attempt([&] { files.given = given_landmarks(scene); });
  if (files.scan_read && !files.given.empty())
    files.completion.problems.attempt(
        [&] { complete_landmarks(scene, files.given, scan.in.scan, files.completion.in); });
}

bool has_own_landmarks(const scene::Scene& scene) {
  return !scene.scan.landmarks.empty() || !scene.given.landmarks.empty();
}

void read_recording_files(const scene::Scene& scene, Extent extent, Files& files) {
  Part& recording = files.recording;
  recording.problems.attempt([&] {
    check_rig(scene);
    if (scene.motion.source.embedded) return;
    const motion::Motion m = read_motion(scene, extent, recording.in);
    files.steady = steady_motion(scene, m, extent, recording.in);
    // Before landmarks are looked for, which takes long.
    if (!scene.scan.source.embedded && !has_own_landmarks(scene))
      check_landmark_names(files.steady->motion);
  });
}

/// Combines what was read. Errors that would make the search for landmarks useless, which takes
/// long, are thrown at once.
Inputs joined(const scene::Scene& scene, bool search, Files& files, Problems& problems) {
  Inputs in = std::move(files.scan.in);
  const Inputs &recording = files.recording.in, &completion = files.completion.in;
  append(in.notes, recording.notes);
  in.head_shift_uncertainty_mm = recording.head_shift_uncertainty_mm;
  in.head_turn_uncertainty_deg = recording.head_turn_uncertainty_deg;
  in.head_uncertainty_known = recording.head_uncertainty_known;
  in.pose_variance = recording.pose_variance;
  in.lasts_s = recording.lasts_s;
  in.lead_s = recording.lead_s;
  in.gaze = recording.gaze;
  problems.add(files.scan.problems);
  problems.add(files.recording.problems);
  const bool to_find =
      files.given.empty() && scene.scan.landmarks.empty() && !scene.scan.source.embedded;
  if (to_find && search) {
    problems.throw_if_any();
    files.given = find_landmarks(in.scan, "the scene names no landmarks", in.notes, scene.kept);
    files.completion.problems.attempt(
        [&] { complete_landmarks(scene, files.given, in.scan, files.completion.in); });
  }
  in.landmarks = completion.landmarks;
  in.placed = completion.placed;
  append(in.notes, completion.notes);
  problems.add(files.completion.problems);
  return in;
}

/// Without landmarks nothing can be aligned: what can be said all the same.
void check_unaligned(const scene::Scene& scene,
                     const std::optional<motion::StabilisedMotion>& steady, Inputs& in) {
  in.notes.push_back(make_note(
      "landmarks.not_searched",
      "the scene names no landmarks, so a check and a run look for them on the scan, as hyperex "
      "landmarks does; not checked here: whether they are found, how the recording fits them, the "
      "names of landmarks, and the mesh"));
  if (steady) check_without_landmarks(scene, steady->motion, in);
  note_missing_support(scene, in);
}

/// Points of a camera's recording or of a face model are no points that a user could correct. A
/// point at a doubtful landmark is not named again.
void note_misfit(const scene::Scene& scene, const io::Landmarks& given,
                 const motion::Motion& steady, Inputs& in) {
  const bool of_a_model = of_weights(scene) || !scene.motion.candide.empty();
  Misfit fit{in.motion.rms_mm, in.motion.scan_from_motion.scale, in.motion.common.size()};
  if (!of_a_model && scene.motion.recording.empty()) {
    MisplacedPoints misplaced = misplaced_points(steady, in.landmarks);
    if (!misplaced.points.empty()) {
      fit = misplaced.others;
      if (has_own_landmarks(scene))
        for (const std::string& name : anatomy::doubtful_landmarks(given, in.scan.mesh))
          std::erase_if(misplaced.points, [&](const auto& point) { return point.name == name; });
    }
    add(in.notes, misplaced_warning(misplaced));
  }
  add(in.notes, misfit_warning(fit, steady.unit_note,
                               of_a_model                       ? PointsOf::model
                               : scene.motion.recording.empty() ? PointsOf::person
                                                                : PointsOf::camera));
  // A model has no millimetres of its own, and parts of a face each have their scale.
  if (!of_a_model && scene.alignment.method != simulate::AlignmentMethod::normalised)
    add(in.notes, rescaled_note(in.motion.scan_from_motion.scale));
}

void align_recording(const scene::Scene& scene, const io::Landmarks& given,
                     const motion::Motion& steady, Inputs& in) {
  const FaceAtRest at_rest{in.landmarks, "the scan"};
  check_sides(steady, at_rest);
  check_pairs(steady, at_rest);
  add(in.notes, sides_warning(steady, at_rest));
  in.motion = simulate::align(steady, in.landmarks, scene.alignment.method);
  if (of_weights(scene)) simulate::match_lid_apertures(in.motion, steady);
  in.jitter_m *= in.motion.scan_from_motion.scale;
  in.notes.push_back(make_note(
      "recording.aligned",
      fmt::format("aligned by {} common points, scale {:.3f}, {:.1f} mm rms apart before the "
                  "smooth correction",
                  in.motion.common.size(), in.motion.scan_from_motion.scale, in.motion.rms_mm)));
  if (has_own_landmarks(scene)) append(in.notes, anatomy::landmark_doubts(given, in.scan.mesh));
  add(in.notes, idle_law_warning(scene));
  note_misfit(scene, given, steady, in);
  add(in.notes, start_warning(steady, at_rest, of_weights(scene)));
  add(in.notes, exchanged_warning(steady, at_rest));
  add(in.notes, one_sided_warning(in.motion.motion, in.landmarks));
}

}  // namespace

Inputs read_inputs(const scene::Scene& scene, Extent of, bool with_variants) {
  const Extent extent = of == Extent::full ? Extent::full : Extent::quick;  // of the recording
  Files files;
  run_together({[&] { read_scan_files(scene, with_variants, files); },
                [&] { read_recording_files(scene, extent, files); }});
  Problems problems;
  Inputs in = joined(scene, of != Extent::quick, files, problems);
  if (scene.motion.source.embedded && !in.landmarks.empty())
    problems.attempt([&] {
      auto opening = motion::embedded_mouth_opening(in.landmarks);
      opening.source = "embedded motion";
      files.steady = steady_motion(scene, opening, extent, in);
    });
  if (files.steady)
    problems.attempt([&] { scale_motion(scene, extent, files.steady->motion, in); });
  if (files.scan_read)
    problems.attempt([&] { in.teeth = read_teeth(scene, in.scan.unit, in.landmarks, in.notes); });
  if (files.scan_read)
    problems.attempt([&] { in.bones = read_bones(scene, in.scan, in.landmarks, in.notes); });
  problems.throw_if_any();
  if (files.given.empty()) {
    check_unaligned(scene, files.steady, in);
    const auto check_known = [&](const scene::Scene& one, const std::string& owner) {
      if (files.steady)
        problems.attempt([&] { check_point_names(one, files.steady->motion, owner); });
      problems.attempt([&] { check_regions(one, owner); });
    };
    check_known(scene, "");
    problems.throw_if_any();
    for (const scene::Variant& variant : scene.variants)
      check_known(variant.scene, variant.owner());
    problems.throw_if_any();
    return in;
  }
  align_recording(scene, files.given, files.steady->motion, in);
  note_unknown_landmarks(scene, files.given, in);
  note_missing_support(scene, in);
  in.driven = driven_points(scene, in.motion.motion);
  note_left_out_points(scene, in.motion.motion, in.notes);
  problems.attempt([&] { check_names(scene, in); });
  problems.attempt([&] { check_element_size(scene, in); });
  problems.throw_if_any();
  if (with_variants) check_names_of_variants(scene, in);
  return in;
}

void check_names_of_variants(const scene::Scene& scene, const Inputs& inputs) {
  Problems problems;
  for (const scene::Variant& variant : scene.variants)
    problems.attempt([&] {
      check_names(variant.scene, inputs_of_variant(variant.scene, inputs), variant.owner());
    });
  problems.throw_if_any();
}

Inputs inputs_of_variant(const scene::Scene& variant, const Inputs& inputs) {
  Inputs in = inputs;
  in.driven = driven_points(variant, in.motion.motion);
  return in;
}

}  // namespace hyperex::session
