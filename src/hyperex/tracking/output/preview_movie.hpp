// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "hyperex/capture/video_writer.hpp"
#include "hyperex/tracking/output/preview.hpp"

namespace hyperex::tracking {

/// A video of the pictures drawn by PreviewPainter, at the speed of the recording. Its frame rate
/// is constant and is that of the first frames (1 to 120 per second). In a gap of the recording,
/// the last picture is repeated. Frames that arrive at a higher rate are skipped.
class PreviewMovie {
 public:
  /// Throws InputError where the name does not end in .mp4. `model` must outlive the movie.
  PreviewMovie(std::filesystem::path file, const expression::FaceModel& model,
               const capture::Intrinsics& camera);

  /// Adds frames in order. Throws InputError if the video cannot be written.
  void add(const TrackedFrame& frame, const cv::Mat& bgr);
  /// Completes the file. Without frames, no file is created.
  void finish();

 private:
  struct Drawn {
    double time_s;
    cv::Mat picture;
  };
  void begin();
  void show(Drawn drawn);

  std::filesystem::path file_;
  PreviewPainter painter_;
  std::vector<Drawn> first_;  // kept until the rate is known
  std::optional<capture::VideoWriter> writer_;
  double rate_hz_ = 0, start_s_ = 0, last_s_ = 0;
  long shown_ = 0;
  cv::Mat standing_;
};

/// The frame rate for these times: 1 / the median of the positive steps, limited to 1 to 120; 30 if
/// there are none. The times need not increase.
double frame_rate_hz(const std::vector<double>& time_s);

}  // namespace hyperex::tracking
