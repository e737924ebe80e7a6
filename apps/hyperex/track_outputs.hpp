// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "hyperex/core/output_file.hpp"
#include "hyperex/tracking/output/preview_movie.hpp"
#include "hyperex/tracking/output/tracking_outputs.hpp"

namespace hyperex::cli {

/// The files that `hyperex track` writes. An empty path means that this file is not written.
struct TrackOutputs {
  std::filesystem::path motion;  ///< CSV; its tables are written beside it
  std::filesystem::path trc, preview, glb, live_link;
  bool vertices = false;  ///< whether the motion file also contains the vertices

  /// All output files, including the tables beside the motion. Some paths may be empty.
  std::vector<std::filesystem::path> files() const;
  /// The same files, with the marks by which an earlier output is distinguished from other files.
  std::vector<OutputFile> kinds(const expression::FaceModel& model) const;
  bool any() const {
    return !motion.empty() || !trc.empty() || !preview.empty() || !glb.empty() ||
           !live_link.empty();
  }
};

void add_output_options(CLI::App& command, TrackOutputs& outputs);

/// The preview video, which is drawn while tracking runs; null if none is requested. Throws
/// InputError if the file name does not belong to a video.
std::unique_ptr<tracking::PreviewMovie> preview_of(const TrackOutputs& outputs,
                                                   const expression::FaceModel& model,
                                                   const capture::Intrinsics& camera);

/// Writes all files except the preview. Prints what was written unless `quiet` is set.
void write_outputs(const TrackOutputs& outputs, const expression::FaceModel& model,
                   const tracking::Tracking& tracking, const capture::Intrinsics& camera,
                   bool quiet);

}  // namespace hyperex::cli
