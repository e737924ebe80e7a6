// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "commands.hpp"
#include "hyperex/capture/mirrored.hpp"
#include "hyperex/capture/open_source.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/memory.hpp"
#include "hyperex/core/printable.hpp"
#include "hyperex/report/tracking_page.hpp"
#include "hyperex/tracking/fit/score.hpp"
#include "track_live.hpp"
#include "track_outputs.hpp"

namespace hyperex::cli {
namespace {

struct TrackOptions {
  std::string recording, device, model = "canonical";
  TrackOutputs outputs;
  std::filesystem::path score, camera, plots;
  std::string mirrored;  ///< "yes", "no", or empty: not stated
  bool no_depth = false, json = false;
  double eye_distance_mm = 90;
  std::optional<double> seconds;
};

constexpr std::string_view kCandide = "candide:";

/// "canonical", or "candide:FILE" read into `own`.
const expression::FaceModel& model_of(const std::string& text,
                                      std::optional<expression::FaceModel>& own) {
  if (text == "canonical") return expression::canonical_model();
  if (!text.starts_with(kCandide))
    throw InputError({{}, 0, "--model", text, "canonical or candide:FILE.wfm"});
  own = expression::candide_model(text.substr(kCandide.size()));
  return *own;
}

nlohmann::ordered_json number(std::optional<double> value) {
  if (!value || !std::isfinite(*value)) return nullptr;
  return *value;
}

void print_score(const tracking::Score& score, bool json) {
  const auto pair = [](const tracking::Quantiles& q) {
    nlohmann::ordered_json made;
    made["median"] = number(q.median);
    made["p95"] = number(q.p95);
    return made;
  };
  if (json) {
    nlohmann::ordered_json out;
    out["frames"] = score.frames;
    out["lost"] = score.lost;
    out["rotation_deg"] = pair(score.rotation_deg);
    out["translation_mm"] = pair(score.translation_mm);
    out["deformation_mm"] = pair(score.deformation_mm);
    out["jaw_correlation"] = number(score.jaw_correlation);
    out["rest_jitter_mm"] = number(score.rest_jitter_mm);
    std::cout << out.dump(2) << '\n';
    return;
  }
  const auto line = [](const char* name, const tracking::Quantiles& q) {
    std::cout << fmt::format("{:<16} {:8.3f} {:8.3f}\n", name, q.median, q.p95);
  };
  const auto text = [](std::optional<double> value) {
    return value ? fmt::format("{:8.4f}", *value) : std::string("       -");
  };
  std::cout << fmt::format("{} frames, {} lost\n{:<16} {:>8} {:>8}\n", score.frames, score.lost, "",
                           "median", "p95");
  line("rotation, deg", score.rotation_deg);
  line("translation, mm", score.translation_mm);
  line("deformation, mm", score.deformation_mm);
  std::cout << fmt::format("jaw correlation  {}\nrest jitter, mm  {}\n",
                           text(score.jaw_correlation), text(score.rest_jitter_mm));
}

void say_what_was_tracked(const tracking::Tracking& tracking) {
  std::size_t lost = 0, several = 0;
  std::string faults;
  constexpr std::size_t listed = 3;
  for (const auto& frame : tracking.frames) {
    if (frame.faces_in_view > 1) ++several;
    if (frame.valid) continue;
    if (lost++ < listed)
      faults += fmt::format("{}frame {} ({})", lost > 1 ? ", " : ": ", frame.index, frame.fault);
  }
  const auto& times = tracking.times;
  const double frames = std::max<double>(1, double(times.frames));
  spdlog::info("{} frames, {} not valid{}{}", tracking.frames.size(), lost, faults,
               lost > listed ? fmt::format(" and {} more", lost - listed) : "");
  if (several) spdlog::warn("several faces in {} frames: the largest was followed", several);
  spdlog::info(
      "ms per frame: network {:.1f}, pictures {:.1f}, fit {:.1f}; the person's shape {:.0f} ms "
      "once",
      1e3 * times.network_s / frames, 1e3 * times.picture_s / frames, 1e3 * times.fit_s / frames,
      1e3 * times.neutral_s);
}

/// Whether the pictures must be mirrored back. This cannot be detected in a colour picture, and a
/// mirrored picture would swap left and right without a warning. For a webcam, the user must state
/// it.
bool asked_mirrored(const TrackOptions& options, const std::string& spec) {
  if (!options.mirrored.empty()) return options.mirrored == "yes";
  if (capture::source_kind(spec) == capture::SourceKind::webcam)
    throw InputError("track: " + spec +
                     ": does its picture show the world as a mirror does? Say --mirrored yes or "
                     "--mirrored no: left and right depend on it");
  return false;
}

/// Prints the warning only for a video that could be opened.
void warn_of_video(const TrackOptions& options, const std::string& recording) {
  if (options.mirrored.empty() && !options.json &&
      capture::source_kind(recording) == capture::SourceKind::video)
    spdlog::warn(
        "{}: assumed not mirrored; a video file has no such flag. If it is mirrored, left and "
        "right "
        "are swapped: give --mirrored yes",
        recording);
}

tracking::FrameVisitor visitor_of(tracking::PreviewMovie* preview) {
  if (preview == nullptr) return {};
  return [preview](const tracking::TrackedFrame& frame, const cv::Mat& bgr) {
    preview->add(frame, bgr);
  };
}

tracking::Tracking track(capture::FrameSource& source, const std::string& name,
                         const expression::FaceModel& model,
                         const tracking::TrackerOptions& tracker, const TrackOptions& options,
                         const tracking::FrameVisitor& visit) {
  try {
    return source.live() ? track_live(source, model, tracker, options.seconds, visit)
                         : tracking::track(source, model, tracker, visit);
  } catch (const InputError& error) {
    throw tracking::about_recording(error, name);
  }
}

std::vector<std::filesystem::path> outputs_of(const TrackOptions& options) {
  std::vector<std::filesystem::path> files = options.outputs.files();
  files.push_back(options.plots);
  return files;
}

/// The files that are read. For a folder, these are the files in it except the pictures.
std::vector<std::filesystem::path> inputs_of(const TrackOptions& options) {
  std::vector<std::filesystem::path> files = {options.camera};
  std::string played = options.device;
  if (played.starts_with("play:")) files.push_back(played.substr(5));
  if (options.model.starts_with(kCandide)) files.push_back(options.model.substr(kCandide.size()));
  files.push_back(options.recording);
  for (const char* name : {"associations.txt", "rgb.txt", "depth.txt", "camera.toml"})
    if (!options.recording.empty())
      files.push_back(std::filesystem::path(options.recording) / name);
  if (!options.score.empty())
    for (const char* name :
         {"truth_pose.csv", "truth_landmarks68_camera_m.csv", "truth_weights.csv"})
      files.push_back(options.score / name);
  return files;
}

void run(const TrackOptions& options) {
  if (!options.outputs.any() && options.plots.empty() && options.score.empty())
    throw InputError(
        "track: nothing to do: give --out, --trc, --preview, --glb, --livelink, --plots or "
        "--score");
  if (options.json && options.score.empty())
    throw InputError("track: --json prints a score: give --score TRUTH_FOLDER too");
  check_outputs(outputs_of(options), inputs_of(options));
  take_library_memory();
  std::optional<expression::FaceModel> own;
  const expression::FaceModel& model = model_of(options.model, own);
  std::vector<OutputFile> kinds = options.outputs.kinds(model);
  kinds.push_back({options.plots, {".html"}, "<!doctype html>", {"<title>Hyperex tracking"}});
  check_output_kinds(kinds);
  std::optional<tracking::Truth> truth;
  if (!options.score.empty()) truth = tracking::read_truth(options.score);
  capture::SourceOptions source_options;
  source_options.colour_only = options.no_depth;
  source_options.camera_file = options.camera;
  const std::string recording =
      options.recording.empty() ? options.score.string() : options.recording;
  std::string played = options.device.empty() ? recording : options.device;
  if (played.starts_with("play:")) played.erase(0, 5);
  const bool flip = asked_mirrored(options, played);
  auto source = options.device.empty() ? capture::open_source(recording, source_options)
                                       : capture::open_device(options.device, source_options);
  warn_of_video(options, played);
  if (flip) source = std::make_unique<capture::Mirrored>(std::move(source));
  if (options.seconds && !source->live())
    throw InputError("track: --seconds is for a camera; a recording has its end");
  tracking::TrackerOptions tracker;
  tracker.neutral.eye_distance_m = options.eye_distance_mm * 1e-3;
  tracker.use_depth = !options.no_depth;
  tracker.network.mirrored_too = !source->live();  // not live: twice the time per frame
  const auto preview = preview_of(options.outputs, model, source->intrinsics());
  const tracking::FrameVisitor visit = visitor_of(preview.get());
  const std::string name = options.device.empty() ? recording : options.device;
  const tracking::Tracking tracking = track(*source, name, model, tracker, options, visit);
  if (preview) preview->finish();
  if (!options.json) {
    for (const auto& note : source->notes()) spdlog::info("{}", note);
    say_what_was_tracked(tracking);
    if (!tracking.neutral->metric)
      spdlog::warn(
          "no depth: lengths rest on {} mm between the outer eye corners "
          "(--eye-distance-mm)",
          options.eye_distance_mm);
  }
  write_outputs(options.outputs, model, tracking, source->intrinsics(), options.json);
  if (!options.plots.empty()) {
    report::write_tracking_page(options.plots,
                                {model, tracking, name, options.eye_distance_mm, source->notes()});
    if (!options.json)
      std::cout << fmt::format("written: {} (plots)\n", printable(options.plots.string()));
  }
  if (truth) print_score(tracking::score(model, tracking.frames, *truth), options.json);
}

}  // namespace

void add_track(CLI::App& program) {
  auto options = std::make_shared<TrackOptions>();
  CLI::App* command =
      program.add_subcommand("track",
                             "Track a face through a recording of colour and depth: its motion in "
                             "millimetres in the face's frame, and separately head pose and action "
                             "units. The face should be at rest at the start.");
  command->add_option(
      "RECORDING", options->recording,
      "A folder in TUM's layout, a video, or a device; with --score alone the truth's "
      "own folder");
  command
      ->add_option("--device", options->device,
                   "Track the face before a camera, live: kinect, openni, openni:URI, webcam:N, or "
                   "play:RECORDING, which plays a recording at its own pace. Ctrl-C ends it and "
                   "writes what was tracked")
      ->excludes("RECORDING");
  command->add_option("--seconds", options->seconds, "With a camera: end after this many seconds")
      ->check(CLI::PositiveNumber);
  add_output_options(*command, options->outputs);
  command->add_option("--plots", options->plots,
                      "Write a page of plots here (.html): pose, units, distances, residuals");
  command->add_option("--model", options->model, "canonical, or candide:FILE.wfm")
      ->capture_default_str();
  command
      ->add_option(
          "--mirrored", options->mirrored,
          "yes: the pictures show the world as a mirror does and are turned back; no: they "
          "do not. Required for a webcam; a video is assumed not to be mirrored")
      ->check([](const std::string& said) {
        return said == "yes" || said == "no" ? "" : "expected yes or no, not \"" + said + "\"";
      })
      ->option_text("yes|no");
  command->add_flag("--no-depth", options->no_depth, "Ignore the depth");
  command->add_option("--camera", options->camera,
                      "A camera.toml used instead of the recording's own");
  command
      ->add_option(
          "--eye-distance-mm", options->eye_distance_mm,
          "Distance between the outer eye corners, which sets the scale where there is no depth")
      ->check(CLI::Range(50.0, 150.0))
      ->capture_default_str();
  command->add_option("--score", options->score,
                      "Compare with the truth in this folder (truth_pose.csv, "
                      "truth_landmarks68_camera_m.csv, truth_weights.csv)");
  command->add_flag("--json", options->json, "Print only the score, as JSON");
  command->footer(
      "Examples:\n"
      "  hyperex track recording --out out/motion.csv --preview out/preview.mp4\n"
      "  hyperex track recording --glb out/face.glb --trc out/motion.trc --plots out/plots.html\n"
      "  hyperex track selfie.mp4 --mirrored yes --eye-distance-mm 92 --out out/motion.csv\n"
      "  hyperex track --device kinect --out out/motion.csv\n"
      "  hyperex track --device webcam:0 --mirrored no --seconds 20 --preview out/preview.mp4\n"
      "  hyperex track --score recording --json");
  command->callback([options] { run(*options); });
}

}  // namespace hyperex::cli
