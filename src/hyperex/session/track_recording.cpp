// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/track_recording.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hyperex/capture/mirrored.hpp"
#include "hyperex/capture/open_source.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/quantile.hpp"
#include "hyperex/session/kept.hpp"
#include "hyperex/session/rig_face.hpp"
#include "hyperex/tracking/output/tracking_outputs.hpp"

namespace hyperex::session {

const expression::FaceModel& face_model(const scene::Scene& scene,
                                        std::optional<expression::FaceModel>& own) {
  const scene::MotionOptions& options = scene.motion;
  if (!options.rig.empty()) return own.emplace(rig_face(options.rig, scene.kept));
  if (options.candide.empty()) return expression::canonical_model();
  return own.emplace(expression::candide_model(options.candide.string()));
}

std::optional<motion::RestStretch> rest_stretch(const scene::MotionOptions& options) {
  if (options.rest_s.empty()) return std::nullopt;
  return motion::RestStretch{options.rest_s.front(), options.rest_s.back()};
}

namespace {

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
    if (!frame) throw InputError(recording, "no face was found in any of the frames");
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

tracking::Tracking track_whole(const scene::MotionOptions& options, capture::FrameSource& source,
                               const expression::FaceModel& model) {
  const auto stretch = rest_stretch(options);
  if (!stretch) return tracking::track(source, model);
  // Around a single time too: one frame alone determines a person's shape badly.
  const double around_s = stretch->from_s == stretch->to_s ? 0.25 : 0;
  const auto again = open_recording(options);
  return tracking::track(source, model, {}, {},
                         {again.get(), stretch->from_s - around_s, stretch->to_s + around_s});
}

tracking::Tracking tracked(const scene::MotionOptions& options, capture::FrameSource& source,
                           const expression::FaceModel& model, Extent extent) {
  const std::string recording = options.recording.string();
  if (extent == Extent::quick) return track_first_face(recording, source, model);
  try {
    return track_whole(options, source, model);
  } catch (const InputError& error) {
    throw tracking::about_recording(error, recording);
  }
}

/// The face that a camera has recorded; with the tracked mesh where skin is to follow it.
RecordedFace track_face(const scene::Scene& scene, Extent extent) {
  RecordedFace recorded;
  std::optional<expression::FaceModel> own;
  const expression::FaceModel& model = face_model(scene, own);
  const auto source = open_recording(scene.motion);
  const tracking::Tracking tracking = tracked(scene.motion, *source, model, extent);
  const auto lost = std::count_if(tracking.frames.begin(), tracking.frames.end(),
                                  [](const auto& frame) { return !frame.valid; });
  const auto note = [&](const char* id, std::string text) {
    recorded.notes.push_back(make_note(id, std::move(text)));
  };
  if (extent == Extent::quick)
    note("recording.first_face",
         fmt::format("motion: there is a face in frame {} of the recording; not checked: the "
                     "frames after it, which a run tracks",
                     tracking.frames.front().index));
  else
    note("recording.tracked", fmt::format("motion: a face tracked in {} of {} frames",
                                          tracking.frames.size() - lost, tracking.frames.size()));
  if (!tracking.neutral->metric)
    note("recording.no_depth",
         "motion: no depth in the recording; lengths assume an average distance between the eyes");
  for (const auto& remark : source->notes()) note("recording.source", "motion: " + remark);
  recorded.motion =
      tracking::motion_of(model, tracking, scene.region.measured != simulate::Measured::none);
  return recorded;
}

void refuse_a_picture(const scene::Scene& scene) {
  if (capture::source_kind(scene.motion.recording.string()) == capture::SourceKind::still)
    throw InputError(
        scene::problem_at(scene, "motion.recording",
                          "a video or a depth camera's recording, as one picture has no motion"));
}

}  // namespace

double expected_length_s(const scene::MotionOptions& options) {
  constexpr std::size_t most_read = 12;
  const auto source = open_recording(options);
  const std::optional<std::size_t> count = source->frame_count();
  if (!count || *count < 2) return 0;
  std::vector<double> times;
  for (std::size_t k = 0; k < std::min(*count, most_read); ++k) {
    const auto frame = source->next();
    if (!frame) break;
    if (frame->valid) times.push_back(frame->time_s);
  }
  return times.size() < 2 ? 0 : double(*count - 1) * median_step(times);
}

motion::Motion track_recording(const scene::Scene& scene, Extent extent, Inputs& in) {
  refuse_a_picture(scene);
  RecordedFace recorded = extent == Extent::quick
                              ? track_face(scene, extent)
                              : recorded_face(scene, [&] { return track_face(scene, extent); });
  append(in.notes, recorded.notes);
  if (extent == Extent::quick) in.lasts_s = expected_length_s(scene.motion);
  if (capture::source_kind(scene.motion.recording.string()) == capture::SourceKind::video &&
      !scene.origins.contains("motion.mirrored"))
    in.notes.push_back(make_warning(
        "recording.mirror_unknown",
        "the video is assumed not mirrored, as the file has no such flag; if it is mirrored (as "
        "many selfie videos are), left and right are exchanged: set motion.mirrored to true or "
        "false"));
  recorded.motion.source = scene.motion.recording.string();
  return std::move(recorded.motion);
}

}  // namespace hyperex::session
