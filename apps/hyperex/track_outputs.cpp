// SPDX-License-Identifier: GPL-3.0-or-later
#include "track_outputs.hpp"

#include <fmt/format.h>

#include <iostream>

#include "hyperex/core/printable.hpp"
#include "hyperex/io/trc.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "hyperex/report/tracked_glb.hpp"
#include "hyperex/tracking/output/live_link.hpp"

namespace hyperex::cli {
namespace {

/// a.csv and "pose" -> a.pose.csv
std::filesystem::path beside(std::filesystem::path file, const std::string& kind) {
  return file.replace_extension("." + kind + ".csv");
}

void write_trc(const std::filesystem::path& file, const motion::Motion& motion) {
  io::TrcFile trc;
  trc.names = motion.names;
  trc.time_s = motion.time_s;
  trc.positions = motion.positions;
  if (motion.time_s.size() > 1)
    trc.data_rate_hz =
        double(motion.time_s.size() - 1) / (motion.time_s.back() - motion.time_s.front());
  io::write_trc(file, trc);
}

}  // namespace

std::vector<std::filesystem::path> TrackOutputs::files() const {
  std::vector<std::filesystem::path> all = {motion, trc, preview, glb, live_link};
  if (!motion.empty())
    for (const char* kind : {"pose", "units", "arkit"}) all.push_back(beside(motion, kind));
  return all;
}

std::vector<OutputFile> TrackOutputs::kinds(const expression::FaceModel& model) const {
  const std::string point = model.landmarks.begin()->first;
  const auto table = [&](const char* kind) {
    return motion.empty() ? motion : beside(motion, kind);
  };
  return {{motion, {".csv"}, "time_s," + point + "_x_mm,"},
          {table("pose"), {".csv"}, "time_s,valid,T00,"},
          {table("units"), {".csv"}, "time_s,valid,"},
          {table("arkit"), {".csv"}, "time_s,browDownLeft,"},
          {trc, {".trc"}, "PathFileType", {"\t" + point + "\t"}},
          // A video does not show which program wrote it, and it might be a recording. So an
          // existing video is never replaced. Its name is checked together with the video library.
          {preview, {""}, ""},
          {glb, {".glb"}, "glTF", {"\"generator\"", "\"hyperex\""}},
          // Recordings by the phone app have the same first line, but they start at the time of
          // day.
          {live_link, {".csv"}, "Timecode,BlendShapeCount,", {"\n00:00:00:00.000,"}}};
}

void add_output_options(CLI::App& command, TrackOutputs& outputs) {
  command.add_option(
      "--out", outputs.motion,
      "Write the motion (CSV) here, and beside it .pose.csv (with validity, faults and residuals), "
      ".units.csv, .arkit.csv");
  command.add_option("--trc", outputs.trc, "Write the motion as TRC here");
  command.add_option(
      "--preview", outputs.preview,
      "Write a video (.mp4) of the recording with mesh, landmarks, pose and units overlaid");
  command.add_option(
      "--glb", outputs.glb,
      "Write the moving face here (.glb), with the head pose as the animation of its node");
  command.add_option("--livelink", outputs.live_link,
                     "Write ARKit's blend-shape weights here as Live Link Face records them (CSV)");
  command.add_flag("--vertices", outputs.vertices, "Write the model's vertices too, as vertex_K");
}

std::unique_ptr<tracking::PreviewMovie> preview_of(const TrackOutputs& outputs,
                                                   const expression::FaceModel& model,
                                                   const capture::Intrinsics& camera) {
  if (outputs.preview.empty()) return nullptr;
  return std::make_unique<tracking::PreviewMovie>(outputs.preview, model, camera);
}

void write_outputs(const TrackOutputs& outputs, const expression::FaceModel& model,
                   const tracking::Tracking& tracking, const capture::Intrinsics& camera,
                   bool quiet) {
  const motion::Motion motion = tracking::motion_of(model, tracking, outputs.vertices);
  if (!outputs.motion.empty()) {
    motion::write_motion_csv(outputs.motion, motion);
    tracking::write_pose_csv(beside(outputs.motion, "pose"), tracking);
    tracking::write_units_csv(beside(outputs.motion, "units"), model, tracking);
    tracking::write_arkit_csv(beside(outputs.motion, "arkit"), model, tracking);
  }
  if (!outputs.trc.empty()) write_trc(outputs.trc, motion);
  if (!outputs.glb.empty()) report::write_tracked_glb(outputs.glb, model, tracking, camera);
  if (!outputs.live_link.empty()) tracking::write_live_link_csv(outputs.live_link, model, tracking);
  if (quiet) return;
  if (!outputs.motion.empty())
    std::cout << fmt::format(
        "written: {} (points, mm), and beside it .pose.csv, .units.csv and .arkit.csv\n",
        printable(outputs.motion.string()));
  for (const auto& file : {outputs.trc, outputs.preview, outputs.glb, outputs.live_link})
    if (!file.empty()) std::cout << fmt::format("written: {}\n", printable(file.string()));
}

}  // namespace hyperex::cli
