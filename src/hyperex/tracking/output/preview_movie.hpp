// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "hyperex/capture/video_writer.hpp"
#include "hyperex/tracking/output/preview.hpp"

namespace hyperex::tracking {

/// A video of what PreviewPainter draws, in the recording's own time: pictures come at a constant
/// rate, which is that of the first frames (1 to 120 per second); where the recording skips, the
/// last picture stands, and frames that come faster are left out.
class PreviewMovie {
 public:
  /// Throws InputError where the name does not end in .mp4. `model` must outlive the movie.
  PreviewMovie(std::filesystem::path file, const expression::FaceModel& model,
               const capture::Intrinsics& camera);

  /// Frames in order. Throws InputError where the video cannot be written.
  void add(const TrackedFrame& frame, const cv::Mat& bgr);
  /// The file appears. Without frames there is none.
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
  std::vector<Drawn> first_;  // until the rate is known
  std::optional<capture::VideoWriter> writer_;
  double rate_hz_ = 0, start_s_ = 0, last_s_ = 0;
  long shown_ = 0;
  cv::Mat standing_;
};

/// The rate of frames at these times, rising or not: 1 / the median of the steps that rise; 30
/// where there are none. Between 1 and 120.
double frame_rate_hz(const std::vector<double>& time_s);

}  // namespace hyperex::tracking
