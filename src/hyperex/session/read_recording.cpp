// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/read_recording.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "hyperex/core/add_rest.hpp"
#include "hyperex/expression/weight_doubts.hpp"
#include "hyperex/expression/wild_weights.hpp"
#include "hyperex/face/point_words.hpp"
#include "hyperex/metrics/pose_floor.hpp"
#include "hyperex/motion/exaggerate.hpp"
#include "hyperex/motion/fill_gaps.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "hyperex/motion/rest.hpp"
#include "hyperex/motion/still_points.hpp"
#include "hyperex/motion/try_stabilise.hpp"
#include "hyperex/scene/keys.hpp"
#include "hyperex/scene/recording_file.hpp"
#include "hyperex/session/check_alone.hpp"
#include "hyperex/session/check_names.hpp"
#include "hyperex/session/cleaned_recording.hpp"
#include "hyperex/session/keyframes.hpp"
#include "hyperex/session/plausible.hpp"
#include "hyperex/session/recording_jitter.hpp"
#include "hyperex/session/recording_names.hpp"
#include "hyperex/session/track_recording.hpp"
#include "hyperex/session/unknown_names.hpp"

namespace hyperex::session {
namespace {

/// Weights at rest are known, all 0: whether the recording begins elsewhere is judged by them.
std::optional<Note> start_of_weights(const scene::MotionOptions& options,
                                     const expression::BlendShapes& shapes) {
  const auto rest = expression::rest_in_weights(shapes);
  if (!rest || !options.rest_s.empty()) return std::nullopt;
  return make_warning(
      "recording.starts_in_expression",
      fmt::format("the recording seems to start in an expression: {} is {:.2g} at the start and "
                  "{:.2g} from {:.2f} s to {:.2f} s, where the weights are least; displacements "
                  "are taken from the first sample, so say motion.rest_s = [{:.2f}, {:.2f}]",
                  rest->shape, rest->weight_at_start, rest->weight_then, rest->from_s, rest->to_s,
                  rest->from_s, rest->to_s));
}

/// The last second of the recording, from its first sample, that the run may show: it may be half
/// a second less, where the run leads the face from rest.
double last_shown_s(const scene::Scene& scene) {
  return scene.time.end_s > 0 ? scene.motion.start_s + scene.time.end_s / scene.motion.time_scale
                              : std::numeric_limits<double>::infinity();
}

void warn_of_weights(const scene::Scene& scene, const expression::BlendShapes& shapes,
                     const expression::FaceModel& model, Inputs& in) {
  const scene::MotionOptions& options = scene.motion;
  for (const std::string& column : shapes.misspelt)
    in.notes.push_back(make_warning("recording.column_misspelt", "motion: " + column));
  if (const expression::MissingSides missing = expression::missing_sides(shapes);
      !missing.text.empty())
    in.notes.push_back(
        missing.doubtful
            ? make_warning("recording.side_missing", "motion: " + missing.text)
            : make_note("recording.expressions", "motion: " + missing.text, "motion.arkit"));
  const std::string lost =
      options.arkit.empty()
          ? ""
          : expression::lost_shapes(shapes, model, options.start_s, last_shown_s(scene));
  if (!lost.empty())
    in.notes.push_back(
        make_warning("recording.shapes_lost",
                     fmt::format("motion: not reproduced, as the {} face has no such shapes: {}",
                                 model.name, lost)));
  add(in.notes, start_of_weights(options, shapes));
}

/// The points of a face model that recorded expressions move.
motion::Motion read_expressions(const scene::Scene& scene, Inputs& in) {
  const scene::MotionOptions& options = scene.motion;
  const expression::MendedShapes mended = expression::without_wild_weights(
      options.arkit.empty() ? expression::read_openface(options.openface)
                            : expression::read_arkit(options.arkit));
  const expression::BlendShapes& shapes = mended.shapes;
  std::vector<std::string> notes = shapes.notes;
  std::optional<expression::FaceModel> own;
  const expression::FaceModel& model = face_model(scene, own);
  motion::Motion m = expression::motion_of(shapes, model, notes);
  const char* key = options.arkit.empty() ? "motion.openface" : "motion.arkit";
  for (const auto& note : notes)
    in.notes.push_back(make_note("recording.expressions", "motion: " + note, key));
  for (const auto& [id, sentence] :
       {std::pair{"recording.wild_weights", wild_weights_sentence(mended)},
        {"recording.weight_jumps", doubtful_weights_sentence(mended)}})
    if (!sentence.empty()) in.notes.push_back(make_warning(id, sentence, key));
  warn_of_weights(scene, shapes, model, in);
  in.gaze = expression::gaze_of(shapes);
  return m;
}

/// `gaze.not_ahead_at_rest`: lids move from the scan's own by what the recording adds to its rest,
/// and eyes turn by the whole gaze. `rest_s`: when the recording shows rest.
std::optional<Note> gaze_at_rest_note(const expression::GazeTrack& gaze, double rest_s) {
  constexpr double least_deg = 5;
  const auto degrees = expression::degrees_of(gaze.at(rest_s));
  const double up_deg = 0.5 * (degrees[1] + degrees[3]);
  if (!(std::abs(up_deg) >= least_deg)) return std::nullopt;
  return make_note(
      "gaze.not_ahead_at_rest",
      fmt::format("the eyes look {:.0f} degrees {} where the recording is taken for rest, and lids "
                  "count from the scan's own there: they do not follow this part of the gaze; name "
                  "a stretch with the eyes ahead in motion.rest_s, if there is one",
                  std::abs(up_deg), up_deg < 0 ? "down" : "up"));
}

/// Rest is where the scene says; `m` has its head pose taken out. Where the face is led from rest
/// into the recording, so are the eyes.
void settle_rest(const scene::Scene& scene, motion::Motion& m, Inputs& in) {
  const auto stretch = rest_stretch(scene.motion);
  const double start_s = scene.motion.start_s;
  if (in.gaze) {
    const double middle_s = stretch ? 0.5 * (stretch->from_s + stretch->to_s) : 0;
    add(in.notes, gaze_at_rest_note(*in.gaze, m.time_s.front() + middle_s));
  }
  if (!stretch && start_s == 0) return;
  // By default the recording's first sample shows rest.
  auto rested = motion::with_rest(m, stretch.value_or(motion::RestStretch{}), start_s);
  m = std::move(rested.motion);
  in.lead_s = rested.lead_s;
  if (rested.lead_s == 0) return;
  if (in.gaze)
    in.gaze = expression::led_in(*in.gaze, m.time_s.front() + rested.lead_s, rested.lead_s);
  in.notes.push_back(make_note(
      "recording.lead_in",
      fmt::format(
          "the face is not at rest at {}: the run leads it from rest into the recording, "
          "and so begins {:g} s earlier",
          start_s > 0 ? fmt::format("time.start_s = {:g}", start_s) : "the start of the recording",
          rested.lead_s * scene.motion.time_scale)));
}

/// A wrong name is reported by its key.
void check_point_gains(const scene::Scene& scene, const motion::Motion& m) {
  std::vector<InputProblem> problems;
  const auto& gains = scene.motion.point_gains;
  for (std::size_t i = 0; i < gains.size(); ++i) {
    const std::string key = fmt::format("motion.point_gain[{}].point", i);
    if (m.index_of(gains[i].point) < 0)
      problems.push_back(scene::problem_at(
          scene, key,
          "the name of a point in the recording" + did_you_mean(gains[i].point, m.names)));
    for (std::size_t j = 0; j < i; ++j)
      if (gains[j].point == gains[i].point) {
        problems.push_back(scene::problem_at(scene, key, "each point once"));
        break;
      }
  }
  if (!problems.empty()) throw InputError(problems);
}

/// Stated points that move against each other do not all move with the skull alone.
std::optional<Note> rigid_points_warning(const scene::Scene& scene, const motion::Motion& m) {
  constexpr double most_m = 1.5e-3;  // skin over bone gives by up to 1 mm, and readings jitter
  constexpr std::size_t most_named = 8;
  const auto moving = motion::unsteady_points(m, scene.motion.rigid_points, most_m);
  if (moving.empty()) return std::nullopt;
  std::vector<std::string> named;
  for (const motion::UnsteadyPoint& point : moving)
    if (named.size() < most_named)
      named.push_back(
          face::name_in_words(point.name, fmt::format("{:.1f} mm", 1e3 * point.change_m)));
  add_rest(named, moving.size());
  return make_warning(
      "head.points_not_rigid",
      fmt::format("points of motion.rigid_points do not keep still against each other, as points "
                  "of the skull do: {}; name points in their place that do not move with the "
                  "expression, or none",
                  fmt::join(named, ", ")));
}

void note_head(const scene::Scene& scene, const motion::StabilisedMotion& steady, Inputs& in) {
  const auto greatest = [](const std::vector<double>& v) { return *std::ranges::max_element(v); };
  in.head_shift_uncertainty_mm = 1e3 * greatest(steady.shift_uncertainty_m);
  in.head_turn_uncertainty_deg = greatest(steady.turn_uncertainty_rad) * 180 / std::numbers::pi;
  constexpr double worth_a_note_mm = 1, unknown_mm = 3, seen = 0.005;  // mm, degrees
  // Points that the program moves are exact, and so are those of which the scene says so.
  in.head_uncertainty_known = of_weights(scene) || scene.motion.source.embedded ||
                              scene.output.jitter_m == 0 || in.head_shift_uncertainty_mm > seen ||
                              in.head_turn_uncertainty_deg > seen;
  if (in.head_shift_uncertainty_mm > unknown_mm)
    in.notes.push_back(make_warning(
        "head.pose_unknown",
        fmt::format(
            "the head's pose is not known: its error may reach {:.1f} mm and {:.1f} degrees "
            "(95 %), which count as expression; name {} in motion.rigid_points that do not "
            "move with the expression",
            in.head_shift_uncertainty_mm, in.head_turn_uncertainty_deg,
            scene.motion.rigid_points.empty() ? "points" : "other points")));
  else if (in.head_shift_uncertainty_mm > worth_a_note_mm)
    in.notes.push_back(make_note(
        "head.pose_uncertain",
        fmt::format("the head's pose is uncertain by up to {:.1f} mm and {:.1f} degrees (95 %), as "
                    "{}",
                    in.head_shift_uncertainty_mm, in.head_turn_uncertainty_deg,
                    scene.motion.rigid_points.empty()
                        ? "the points around it move with the expression; motion.rigid_points "
                          "names points fixed to the skull where there are any"
                        : "the points of motion.rigid_points jitter or move against each other; "
                          "more of them, or farther apart, hold it better")));
}

/// Points of the skull beside the landmarks of the face, where the scene names none. Those of a
/// camera's recording are all of the face.
std::optional<Note> unused_points_note(const scene::Scene& scene,
                                       const motion::StabilisedMotion& steady) {
  if (!scene.motion.recording.empty() || of_weights(scene)) return std::nullopt;
  const std::vector<std::string> still = motion::still_points_beside_landmarks(steady);
  if (still.empty()) return std::nullopt;
  return make_note("head.still_points_unused", motion::unused_still_points_sentence(still) +
                                                   "; name them in motion.rigid_points");
}

/// A note on the recording's file, under the key that names it.
std::optional<Note> about_its_file(const scene::Scene& scene, std::optional<Note> doubt) {
  for (const auto& [key, file] : {std::pair{"motion.arkit", &scene.motion.arkit},
                                  {"motion.openface", &scene.motion.openface},
                                  {"motion.recording", &scene.motion.recording}})
    if (doubt && !file->empty()) doubt->key = key;
  return doubt;
}

/// A quick reading of a camera's recording has its first face alone.
bool is_read_whole(const scene::Scene& scene, Extent extent) {
  return scene.motion.recording.empty() || extent == Extent::full;
}

}  // namespace

void check_rig(const scene::Scene& scene) {
  if (scene.motion.rig.empty()) return;
  if (scene.motion.arkit.empty() && scene.motion.openface.empty())
    throw InputError(scene::problem_at(scene, "motion.rig",
                                       "none, as there is neither motion.arkit nor "
                                       "motion.openface: only weights move a rig"));
  if (!scene.motion.candide.empty())
    throw InputError(
        scene::problem_at(scene, "motion.rig", "none, as motion.candide names the face model"));
}

motion::Motion read_motion(const scene::Scene& scene, Extent extent, Inputs& in) {
  if (scene.motion.mirrored && scene.motion.recording.empty())
    throw InputError(
        scene::problem_at(scene, "motion.mirrored",
                          "false, as there is no motion.recording: only a camera's pictures "
                          "can be turned back"));
  if (scene.given.motion) return *scene.given.motion;
  if (!scene.motion.recording.empty()) return track_recording(scene, extent, in);
  if (scene.motion.source.file.empty()) return read_expressions(scene, in);
  auto m = motion::read_motion(scene.motion.source.file, scene.motion.unit);
  if (!m.unit_note.empty())
    in.notes.push_back(make_note("recording.unit", "motion: " + m.unit_note));
  return m;
}

motion::StabilisedMotion steady_motion(const scene::Scene& scene, const motion::Motion& m,
                                       Extent extent, Inputs& in) {
  const bool whole = is_read_whole(scene, extent);
  const Readings readings =
      of_weights(scene) && !scene.given.motion ? Readings::of_weights : Readings::measured;
  if (!scene.motion.source.embedded && whole) {
    in.notes.push_back(make_note("recording.timing", timing_sentence(m)));
    for (const std::optional<Note>& said :
         {timing_warning(m, readings), coarse_warning(m, readings),
          short_warning(m.time_s, readings), keyframes_note(m, readings)})
      add(in.notes, about_its_file(scene, said));
  }
  const CleanedRecording cleaned = cleaned_recording(m, readings);
  append(in.notes, cleaned.warnings);
  motion::GapOptions gaps;
  gaps.max_gap_s = scene.motion.max_gap_s;
  const motion::FilledMotion filled = motion::fill_gaps(cleaned.motion, gaps);
  if (!filled.gaps.empty())
    in.notes.push_back(make_note(
        "recording.gaps_filled",
        fmt::format("{} gaps of the recording were interpolated, the first of {} at {:.3f} s",
                    filled.gaps.size(), filled.gaps.front().point, filled.gaps.front().from_s)));
  motion::StabiliseOptions options;
  options.rigid_points = scene.motion.rigid_points;
  // Expressions move a face model, whose head stays where it is.
  const bool still_head = of_weights(scene);
  if (!still_head) {
    check_rigid_points(scene, filled.motion);
    check_head_points(filled.motion, options.rigid_points);
  }
  auto steady = still_head ? motion::with_still_head(filled.motion)
                           : motion::stabilise(filled.motion, options);
  steady.motion.skull_points = options.rigid_points;
  add(in.notes, check_steady(steady.motion, readings));
  note_head(scene, steady, in);
  add(in.notes, unused_points_note(scene, steady));
  if (!still_head) add(in.notes, rigid_points_warning(scene, filled.motion));
  if (whole) {
    in.pose_variance =
        metrics::pose_variances(steady.motion, steady.poses, scene.output.lowpass_hz);
    settle_rest(scene, steady.motion, in);
    add(in.notes, stillness_warning(steady.motion, in.gaze.has_value()));
    add(in.notes, about_its_file(scene, end_warning(steady.motion)));
  }
  return steady;
}

void scale_motion(const scene::Scene& scene, Extent extent, motion::Motion& m, Inputs& in) {
  check_point_gains(scene, m);
  m = motion::with_point_gains(m, scene.motion.point_gains);
  settle_jitter(scene, extent, m, in);
  m = motion::time_scaled(m, scene.motion.time_scale);
  if (in.gaze)
    for (double& t : in.gaze->time_s) t = scene.motion.time_scale * (t - m.time_s.front());
  if (is_read_whole(scene, extent)) {
    check_length(scene, m);
    in.lasts_s = m.time_s.back() - m.time_s.front();
  } else if (in.lasts_s > 0) {  // of the whole recording, as it is
    in.lead_s = scene.motion.start_s > 0 ? motion::rest_lead_s : 0;
    in.lasts_s =
        scene.motion.time_scale * std::max(0.0, in.lasts_s - scene.motion.start_s + in.lead_s);
  }
  add(in.notes, beyond_recording_warning(scene, in.lasts_s));
  add(in.notes, end_of_run_note(scene, in.lead_s));
}

void check_without_landmarks(const scene::Scene& scene, const motion::Motion& m, Inputs& in) {
  const FaceAtRest average = average_face();
  const bool whole = scene.motion.recording.empty();  // of a camera's only the first face was read
  check_sides(m, average);
  if (whole) check_pairs(m, average);
  add(in.notes, sides_warning(m, average));
  if (whole) {
    add(in.notes, start_warning(m, average, of_weights(scene)));
    add(in.notes, exchanged_warning(m, average));
    if (!of_weights(scene)) {
      add(in.notes, size_warning(m));
      add(in.notes, point_off_warning(m));
    }
  }
  in.notes.push_back(
      whole ? make_note(
                  "recording.checked_by_average_face",
                  fmt::format("whether left and right are exchanged{} was checked against an "
                              "average face, as the scan's landmarks are not known",
                              of_weights(scene) ? "" : " and whether the recording starts at rest"))
            : make_note("recording.start_unchecked",
                        "not checked: whether the recording starts at rest; a run checks that"));
}

}  // namespace hyperex::session
