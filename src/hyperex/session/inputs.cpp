// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/anatomy/landmark_doubts.hpp"
#include "hyperex/anatomy/landmarks.hpp"
#include "hyperex/capture/mirrored.hpp"
#include "hyperex/capture/open_source.hpp"
#include "hyperex/core/run_together.hpp"
#include "hyperex/expression/blend_shapes.hpp"
#include "hyperex/motion/embedded_motion.hpp"
#include "hyperex/motion/exaggerate.hpp"
#include "hyperex/motion/fill_gaps.hpp"
#include "hyperex/motion/option_error.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "hyperex/motion/rest.hpp"
#include "hyperex/motion/stabilise.hpp"
#include "hyperex/scene/keys.hpp"
#include "hyperex/session/driven_points.hpp"
#include "hyperex/session/kept.hpp"
#include "hyperex/session/plausible.hpp"
#include "hyperex/session/recording_jitter.hpp"
#include "hyperex/session/teeth.hpp"
#include "hyperex/session/unknown_names.hpp"
#include "hyperex/tissue/field/tissue_field.hpp"
#include "hyperex/tissue/mesh/skin_depth.hpp"
#include "hyperex/tracking/output/tracking_outputs.hpp"

namespace hyperex::session {
namespace {

/// Runs steps that may throw InputError and keeps what they say, so that problems of independent
/// inputs are told together.
class Problems {
 public:
  template <class Step>
  void attempt(Step step) {
    try {
      step();
    } catch (const motion::OptionError& e) {
      add(e.sentence("motion." + e.option()));
    } catch (const InputError& e) {
      add(e.what());
    }
  }
  void add(const Problems& more) {
    if (!more.text_.empty()) text_ += (text_.empty() ? "" : "\n") + more.text_;
  }
  void throw_if_any() const {
    if (!text_.empty()) throw InputError(text_);
  }

 private:
  void add(const std::string& sentences) { text_ += (text_.empty() ? "" : "\n") + sentences; }

  std::string text_;
};

void read_scan(const scene::Scene& scene, Inputs& in) {
  if (scene.scan.source.embedded) {
    in.scan.file = "embedded face";
    in.scan.mesh = anatomy::embedded_face().mesh;
    return;
  }
  in.scan = io::read_scan(scene.scan.source.file, scene.scan.unit);
  if (in.scan.unit_guessed)
    in.notes.push_back(
        fmt::format("the scan's unit is {}; state it with scan.unit", io::unit_note(in.scan)));
}

void complete(const scene::Scene& scene, const io::Landmarks& given, const io::Scan& scan,
              Inputs& in) {
  const std::string source = scene.scan.source.embedded     ? "embedded face"
                             : scene.scan.landmarks.empty() ? scan.file.string()
                                                            : scene.scan.landmarks.string();
  auto completed = completed_landmarks(given, scan, source, scene.kept);
  in.landmarks = std::move(completed.landmarks);
  in.placed = std::move(completed.placed);
  if (!in.placed.empty())
    in.notes.push_back(
        fmt::format("{} of {} landmarks were not given and were placed by fitting the canonical "
                    "face to the {} given ones and the scan",
                    in.placed.size(), in.landmarks.size(), given.size()));
}

const expression::FaceModel& face_model(const scene::MotionOptions& options,
                                        std::optional<expression::FaceModel>& own) {
  if (options.candide.empty()) return expression::canonical_model();
  return own.emplace(expression::candide_model(options.candide.string()));
}

/// The points of a face model that recorded expressions move.
motion::Motion read_expressions(const scene::MotionOptions& options, Inputs& in) {
  const expression::BlendShapes shapes = options.arkit.empty()
                                             ? expression::read_openface(options.openface)
                                             : expression::read_arkit(options.arkit);
  std::vector<std::string> notes = shapes.notes;
  std::optional<expression::FaceModel> own;
  motion::Motion m = expression::motion_of(shapes, face_model(options, own), notes);
  for (const auto& note : notes) in.notes.push_back("motion: " + note);
  return m;
}

constexpr const char* kNoFace = "no face was found in any of the frames";

/// The first frame with a face, of which alone the person's shape is estimated: names and places
/// of points as tracking the whole recording would give them, roughly.
tracking::Tracking track_first_face(const std::string& recording, capture::FrameSource& source,
                                    const expression::FaceModel& model) {
  tracking::TrackerOptions options;
  options.neutral_frames = 1;
  tracking::FaceTracker tracker(model, source.intrinsics(), options);
  tracking::Tracking tracking;
  while (tracking.frames.empty()) {
    const auto frame = source.next();
    if (!frame) throw InputError(recording, kNoFace);
    for (auto& one : tracker.feed(*frame))
      if (one.valid) tracking.frames.push_back(std::move(one));
  }
  tracking.neutral = tracker.neutral();
  return tracking;
}

std::unique_ptr<capture::FrameSource> open_recording(const scene::MotionOptions& options) {
  auto source = capture::open_source(options.recording.string());
  if (options.mirrored) source = std::make_unique<capture::Mirrored>(std::move(source));
  return source;
}

/// The stretch that motion.rest_s says; one time stands for the sample there.
std::optional<motion::RestStretch> rest_stretch(const scene::MotionOptions& options) {
  if (options.rest_s.empty()) return std::nullopt;
  return motion::RestStretch{options.rest_s.front(), options.rest_s.back()};
}

tracking::Tracking track_whole(const scene::MotionOptions& options, capture::FrameSource& source,
                               const expression::FaceModel& model) {
  const auto stretch = rest_stretch(options);
  if (!stretch) return tracking::track(source, model);
  // Of a single time its surroundings: one frame alone tells a person's shape badly.
  const double around_s = stretch->from_s == stretch->to_s ? 0.25 : 0;
  const auto again = open_recording(options);
  return tracking::track(source, model, {}, {},
                         {again.get(), stretch->from_s - around_s, stretch->to_s + around_s});
}

tracking::Tracking tracked(const scene::MotionOptions& options, capture::FrameSource& source,
                           const expression::FaceModel& model, Look look) {
  const std::string recording = options.recording.string();
  if (look == Look::quick) return track_first_face(recording, source, model);
  try {
    return track_whole(options, source, model);
  } catch (const InputError& error) {  // the tracker does not know whose frames it got
    if (std::string(error.what()).ends_with(kNoFace)) throw InputError(recording, kNoFace);
    throw;
  }
}

/// The face that a camera has recorded; with the tracked mesh where skin is to follow it.
RecordedFace track_face(const scene::Scene& scene, Look look) {
  RecordedFace recorded;
  std::optional<expression::FaceModel> own;
  const expression::FaceModel& model = face_model(scene.motion, own);
  const auto source = open_recording(scene.motion);
  const tracking::Tracking tracking = tracked(scene.motion, *source, model, look);
  const auto lost = std::count_if(tracking.frames.begin(), tracking.frames.end(),
                                  [](const auto& frame) { return !frame.valid; });
  recorded.notes.push_back(
      look == Look::quick
          ? fmt::format("motion: there is a face in frame {} of the recording; not checked: the "
                        "frames after it, which a run tracks",
                        tracking.frames.front().index)
          : fmt::format("motion: a face tracked in {} of {} frames", tracking.frames.size() - lost,
                        tracking.frames.size()));
  if (!tracking.neutral->metric)
    recorded.notes.push_back(
        "motion: no depth in the recording; lengths rest on a usual distance between the eyes");
  for (const auto& note : source->notes()) recorded.notes.push_back("motion: " + note);
  recorded.motion =
      tracking::motion_of(model, tracking, scene.region.measured != simulate::Measured::none);
  return recorded;
}

motion::Motion track_recording(const scene::Scene& scene, Look look, Inputs& in) {
  RecordedFace recorded = look == Look::quick
                              ? track_face(scene, look)
                              : recorded_face(scene, [&] { return track_face(scene, look); });
  in.notes.insert(in.notes.end(), recorded.notes.begin(), recorded.notes.end());
  if (capture::source_kind(scene.motion.recording.string()) == capture::SourceKind::video &&
      !scene.origins.contains("motion.mirrored"))
    in.warnings.push_back(
        "the video is taken as not mirrored, as it does not tell; where it is (many selfie videos "
        "are), left and right are exchanged: say motion.mirrored = true, or false");
  recorded.motion.source = scene.motion.recording.string();
  return std::move(recorded.motion);
}

motion::Motion read_motion(const scene::Scene& scene, Look look, Inputs& in) {
  if (scene.motion.mirrored && scene.motion.recording.empty())
    throw InputError(
        scene::problem_at(scene, "motion.mirrored",
                          "false, as there is no motion.recording: only a camera's pictures "
                          "can be turned back"));
  if (!scene.motion.recording.empty()) return track_recording(scene, look, in);
  if (scene.motion.source.file.empty()) return read_expressions(scene.motion, in);
  auto m = motion::read_motion(scene.motion.source.file, scene.motion.unit);
  if (!m.unit_note.empty()) in.notes.push_back("motion: " + m.unit_note);
  return m;
}

/// Rest is where the scene says; `m` has its head pose taken out.
void settle_rest(const scene::Scene& scene, motion::Motion& m, Inputs& in) {
  const auto stretch = rest_stretch(scene.motion);
  if (!stretch) return;
  auto rested = motion::with_rest(m, *stretch);
  m = std::move(rested.motion);
  if (rested.lead_s > 0)
    in.notes.push_back(fmt::format(
        "the recording does not start at rest: the run leads the face from rest into it and so "
        "begins {:g} s before it",
        rested.lead_s * scene.motion.time_scale));
}

motion::StabilisedMotion steady(const scene::Scene& scene, const motion::Motion& m, Look look,
                                Inputs& in) {
  if (!scene.motion.source.embedded && (scene.motion.recording.empty() || look == Look::whole)) {
    in.notes.push_back(timing_note(m));
    if (const auto warning = timing_warning(m); !warning.empty()) in.warnings.push_back(warning);
  }
  motion::GapOptions gaps;
  gaps.max_gap_s = scene.motion.max_gap_s;
  const motion::FilledMotion filled = motion::fill_gaps(m, gaps);
  if (!filled.gaps.empty())
    in.notes.push_back(
        fmt::format("{} gaps of the recording were interpolated, the first of {} at {:.3f} s",
                    filled.gaps.size(), filled.gaps.front().point, filled.gaps.front().from_s));
  motion::StabiliseOptions options;
  options.rigid_points = scene.motion.rigid_points;
  // Expressions move a face model, whose head stays where it is.
  const bool expressions = !scene.motion.arkit.empty() || !scene.motion.openface.empty();
  auto steady = expressions ? motion::with_still_head(filled.motion)
                            : motion::stabilise(filled.motion, options);
  const auto greatest = [](const std::vector<double>& v) { return *std::ranges::max_element(v); };
  in.head_shift_uncertainty_mm = 1e3 * greatest(steady.shift_uncertainty_m);
  in.head_turn_uncertainty_deg = greatest(steady.turn_uncertainty_rad) * 180 / std::numbers::pi;
  constexpr double worth_a_note_mm = 1;
  if (in.head_shift_uncertainty_mm > worth_a_note_mm)
    in.notes.push_back(
        fmt::format("the head's pose is uncertain by up to {:.1f} mm and {:.1f} degrees (95 %), as "
                    "the points around it move with the expression; motion.rigid_points names "
                    "points fixed to the skull where there are any",
                    in.head_shift_uncertainty_mm, in.head_turn_uncertainty_deg));
  // A quick look at a camera's recording has its first frame alone.
  if (scene.motion.recording.empty() || look == Look::whole) {
    settle_rest(scene, steady.motion, in);
    if (const auto warning = stillness_warning(steady.motion); !warning.empty())
      in.warnings.push_back(warning);
  }
  return steady;
}

/// What a recording shows without the scan's landmarks.
void check_without_landmarks(const scene::Scene& scene, const motion::Motion& m, Inputs& in) {
  const FaceAtRest average = average_face();
  const bool whole = scene.motion.recording.empty();  // of a camera's there is its first face only
  check_sides(m, average);
  if (whole) {
    for (const auto& warning : {start_warning(m, average), exchanged_warning(m, average)})
      if (!warning.empty()) in.warnings.push_back(warning);
  }
  in.notes.push_back(
      whole ? "whether left and right are exchanged and whether the recording starts at rest was "
              "checked against an average face, as the scan's landmarks are not known"
            : "not checked: whether the recording starts at rest, which a run tells");
}

/// A wrong name is told by where it stands in the scene.
void check_point_gains(const scene::Scene& scene, const motion::Motion& m) {
  std::vector<InputProblem> problems;
  const auto& gains = scene.motion.point_gains;
  for (std::size_t i = 0; i < gains.size(); ++i) {
    const std::string key = fmt::format("motion.point_gain[{}].point", i);
    if (m.index_of(gains[i].point) < 0)
      problems.push_back(scene::problem_at(scene, key, "the name of a point in the recording"));
    for (std::size_t j = 0; j < i; ++j)
      if (gains[j].point == gains[i].point) {
        problems.push_back(scene::problem_at(scene, key, "each point once"));
        break;
      }
  }
  if (!problems.empty()) throw InputError(problems);
}

/// Gains of points, the jitter, and the scale of time.
void exaggerate(const scene::Scene& scene, Look look, motion::Motion& m, Inputs& in) {
  check_point_gains(scene, m);
  m = motion::with_point_gains(m, scene.motion.point_gains);
  settle_jitter(scene, look, m, in);
  m = motion::time_scaled(m, scene.motion.time_scale);
  if (scene.motion.recording.empty() || look == Look::whole) check_length(scene, m);
}

/// Names that do not exist, and tissue that cannot be. `of` precedes the keys: "variant[0].".
void check_names(const scene::Scene& scene, const Inputs& in, const std::string& of = "") {
  const auto check = [&](const std::vector<std::string>& names, const char* key, bool in_motion) {
    std::vector<InputProblem> problems;
    for (const auto& name : names)
      if (in_motion ? in.motion.motion.index_of(name) < 0 : !in.landmarks.count(name))
        problems.push_back(scene::problem_at(
            scene, key,
            fmt::format("names of {} ({} is none)",
                        in_motion ? "points in the recording " + in.motion.motion.source
                                  : "landmarks of the scan",
                        name)));
    return problems;
  };
  std::vector<InputProblem> all;
  const auto add = [&](std::vector<InputProblem> more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  add(check(in.driven, "drive.points", true));
  add(check(scene.support.jaw_points, "support.jaw_points", true));
  add(check(scene.region.measured_points, "region.measured_points", true));
  add(check(scene.drive.still_points, "drive.still_points", false));
  std::vector<std::string> thick;
  for (const auto& p : scene.mesh.depths) thick.push_back(p.landmark);
  add(check(thick, "mesh.thickness_point", false));
  for (const auto& problem : tissue::problems_of(scene.tissue, in.landmarks))
    all.push_back(scene::problem_at(scene, "tissue." + problem.key, problem.expected));
  for (InputProblem& problem : all) {
    const bool of_region =
        problem.key.starts_with("tissue.region[") && problem.key.ends_with("].name");
    if (const std::string near = of_region ? nearest_region(problem.value) : ""; !near.empty())
      problem.expected += "; did you mean " + near + "?";
    problem.key = of + problem.key;
  }
  if (!all.empty()) throw InputError(all);
}

/// Files of tissue a vertex, of the scene and of its variants, each told of once.
void note_tissue_files(const scene::Scene& scene, Inputs& in) {
  const auto note_once = [&](std::vector<std::string> notes) {
    for (auto& note : notes)
      if (std::find(in.notes.begin(), in.notes.end(), note) == in.notes.end())
        in.notes.push_back(std::move(note));
  };
  const auto add = [&](const scene::Scene& s) {
    note_once(tissue::notes_on_files(s.tissue, in.scan.mesh));
  };
  note_once(tissue::notes_on_depth_files(scene.mesh, in.scan.mesh));
  add(scene);
  for (const scene::Variant& variant : scene.variants)
    if (!(variant.scene.tissue == scene.tissue)) add(variant.scene);
}

/// Labels that nothing asked for: a name that the recording or the scene has serves there.
void note_unknown_landmarks(const scene::Scene& scene, const io::Landmarks& given, Inputs& in) {
  std::vector<std::string> unknown = anatomy::unknown_landmarks(given);
  std::erase_if(unknown, [&](const std::string& name) {
    return in.motion.motion.index_of(name) >= 0 ||
           std::count(scene.drive.still_points.begin(), scene.drive.still_points.end(), name) > 0 ||
           std::any_of(scene.mesh.depths.begin(), scene.mesh.depths.end(),
                       [&](const tissue::DepthAt& p) { return p.landmark == name; }) ||
           std::any_of(scene.tissue.points.begin(), scene.tissue.points.end(),
                       [&](const tissue::TissuePoint& p) { return name.starts_with(p.landmark); });
  });
  for (std::string& warning : misspelt_landmarks(unknown)) in.warnings.push_back(warning);
  if (!unknown.empty()) in.notes.push_back(anatomy::unknown_landmarks_note(unknown));
}

void note_missing_support(const scene::Scene& scene, Inputs& in) {
  const simulate::SupportOptions& s = scene.support;
  if (!s.border_held && s.skull == simulate::Hold::free && s.mandible == simulate::Mandible::free &&
      s.field_pa_per_m == 0)
    in.notes.push_back(
        "nothing holds the tissue: support.border, support.skull and support.mandible are free and "
        "support.field_kpa_per_mm is 0; it hangs on the driven points alone and may swing about "
        "them");
}

/// Lips move apart only where several elements lie between the mouth's corners.
void check_element_size(const scene::Scene& scene, const Inputs& in) {
  constexpr double share_of_mouth = 1.0 / 3;
  const auto right = in.landmarks.find("cheilion_R"), left = in.landmarks.find("cheilion_L");
  if (right == in.landmarks.end() || left == in.landmarks.end()) return;
  const double mouth_m = (left->second - right->second).norm();
  if (scene.mesh.element_size_m > share_of_mouth * mouth_m)
    throw InputError(scene::problem_at(
        scene, "mesh.element_size_mm",
        fmt::format("at most {:.1f} mm, a third of this mouth's width, for the lips to move apart",
                    1e3 * share_of_mouth * mouth_m)));
}

}  // namespace

io::Landmarks find_landmarks(const io::Scan& scan, const std::string& why,
                             std::vector<std::string>& notes, const KeptResults& kept) {
  FoundLandmarks found = landmarks_on(scan, std::nullopt, kept);
  notes.push_back(fmt::format(
      "{}: {} were found on the scan in {} pictures, which lie {:.1f} mm (median) from where all "
      "agree; hyperex landmarks --picture draws them",
      why, found.landmarks.size(), found.views, 1e3 * found.spread_m));
  return std::move(found.landmarks);
}

namespace {

/// What is read of the scan and, beside it, of the recording: each tells into Inputs of its own.
struct Reading {
  Inputs in;
  Problems problems;
};

io::Landmarks given_landmarks(const scene::Scene& scene) {
  if (!scene.scan.landmarks.empty())
    return io::read_landmarks(scene.scan.landmarks, scene.scan.landmarks_unit);
  if (scene.scan.source.embedded) return anatomy::embedded_face().landmarks;
  return {};
}

void take_recording(const Inputs& recording, Inputs& in) {
  in.notes.insert(in.notes.end(), recording.notes.begin(), recording.notes.end());
  in.warnings.insert(in.warnings.end(), recording.warnings.begin(), recording.warnings.end());
  in.head_shift_uncertainty_mm = recording.head_shift_uncertainty_mm;
  in.head_turn_uncertainty_deg = recording.head_turn_uncertainty_deg;
}

}  // namespace

Inputs read_inputs(const scene::Scene& scene, Look look) {
  Reading scan, completion, recording;
  io::Landmarks given;
  std::optional<motion::StabilisedMotion> steadied;
  bool scan_read = false;
  run_together({[&] {
                  scan.problems.attempt([&] {
                    read_scan(scene, scan.in);
                    scan_read = true;
                  });
                  if (scan_read) scan.problems.attempt([&] { note_tissue_files(scene, scan.in); });
                  scan.problems.attempt([&] { given = given_landmarks(scene); });
                  if (scan_read && !given.empty())
                    completion.problems.attempt(
                        [&] { complete(scene, given, scan.in.scan, completion.in); });
                },
                [&] {
                  if (scene.motion.source.embedded) return;
                  recording.problems.attempt([&] {
                    steadied =
                        steady(scene, read_motion(scene, look, recording.in), look, recording.in);
                  });
                }});
  Inputs in = std::move(scan.in);
  Problems problems = scan.problems;
  take_recording(recording.in, in);
  problems.add(recording.problems);
  // Finding landmarks takes long: whatever else is wrong is told before.
  const bool to_find = scene.scan.landmarks.empty() && !scene.scan.source.embedded;
  if (to_find && look == Look::whole) {
    problems.throw_if_any();
    given = find_landmarks(in.scan, "the scene names no landmarks", in.notes, scene.kept);
    completion.problems.attempt([&] { complete(scene, given, in.scan, completion.in); });
  }
  in.landmarks = std::move(completion.in.landmarks);
  in.placed = std::move(completion.in.placed);
  in.notes.insert(in.notes.end(), completion.in.notes.begin(), completion.in.notes.end());
  problems.add(completion.problems);
  if (scene.motion.source.embedded && !in.landmarks.empty())
    problems.attempt([&] {
      auto opening = motion::embedded_mouth_opening(in.landmarks);
      opening.source = "embedded motion";
      steadied = steady(scene, opening, look, in);
    });
  if (steadied) problems.attempt([&] { exaggerate(scene, look, steadied->motion, in); });
  if (scan_read)
    problems.attempt([&] { in.teeth = read_teeth(scene, in.scan.unit, in.landmarks, in.notes); });
  problems.throw_if_any();
  if (given.empty()) {
    in.notes.push_back(
        "the scene names no landmarks, so a run looks for them on the scan, as hyperex landmarks "
        "does; not checked: whether they are found, how the recording fits them, and the names of "
        "points and landmarks");
    if (steadied) check_without_landmarks(scene, steadied->motion, in);
    note_missing_support(scene, in);
    return in;
  }
  const FaceAtRest at_rest{in.landmarks, "the scan"};
  check_sides(steadied->motion, at_rest);
  in.motion = simulate::align(steadied->motion, in.landmarks, scene.alignment.method);
  in.jitter_m *= in.motion.scan_from_motion.scale;
  in.notes.push_back(fmt::format(
      "aligned by {} common points, scale {:.3f}, {:.1f} mm rms apart before the smooth "
      "correction",
      in.motion.common.size(), in.motion.scan_from_motion.scale, in.motion.rms_mm));
  const auto warn = [&](const std::string& warning) {
    if (!warning.empty()) in.warnings.push_back(warning);
  };
  if (!scene.scan.landmarks.empty())
    for (const auto& doubt : anatomy::landmark_doubts(given, in.scan.mesh)) warn(doubt);
  warn(idle_law_warning(scene));
  warn(misfit_warning(in.motion));
  warn(start_warning(steadied->motion, at_rest));
  warn(exchanged_warning(steadied->motion, at_rest));
  note_unknown_landmarks(scene, given, in);
  note_missing_support(scene, in);
  in.driven = driven_points(scene, in.motion.motion);
  note_left_out_points(scene, in.motion.motion, in.notes);
  problems.attempt([&] { check_names(scene, in); });
  problems.attempt([&] { check_element_size(scene, in); });
  problems.throw_if_any();
  for (std::size_t i = 0; i < scene.variants.size(); ++i)
    problems.attempt([&] {
      check_names(scene.variants[i].scene, inputs_of_variant(scene.variants[i].scene, in),
                  fmt::format("variant[{}].", i));
    });
  problems.throw_if_any();
  return in;
}

Inputs inputs_of_variant(const scene::Scene& variant, const Inputs& inputs) {
  Inputs in = inputs;
  in.driven = driven_points(variant, in.motion.motion);
  return in;
}

}  // namespace hyperex::session
