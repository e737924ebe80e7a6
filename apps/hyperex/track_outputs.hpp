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

/// The files that `hyperex track` writes, each where it is named.
struct TrackOutputs {
  std::filesystem::path motion;  ///< CSV, with tables beside it
  std::filesystem::path trc, preview, glb, live_link;
  bool vertices = false;  ///< in the motion too

  /// Every file, those beside the motion among them; some empty.
  std::vector<std::filesystem::path> files() const;
  /// The same, with what distinguishes earlier outputs from other files.
  std::vector<OutputFile> kinds(const expression::FaceModel& model) const;
  bool any() const {
    return !motion.empty() || !trc.empty() || !preview.empty() || !glb.empty() ||
           !live_link.empty();
  }
};

void add_output_options(CLI::App& command, TrackOutputs& outputs);

/// Draws while tracking runs; null where no preview is requested. Throws InputError for a name that
/// is none of a video.
std::unique_ptr<tracking::PreviewMovie> preview_of(const TrackOutputs& outputs,
                                                   const expression::FaceModel& model,
                                                   const capture::Intrinsics& camera);

/// All but the preview; says what was written unless `quiet`.
void write_outputs(const TrackOutputs& outputs, const expression::FaceModel& model,
                   const tracking::Tracking& tracking, const capture::Intrinsics& camera,
                   bool quiet);

}  // namespace hyperex::cli
