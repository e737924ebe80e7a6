// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>

namespace hyperex::capture {

/// Writes a video that browsers can play: H.264, yuv420p, in an MP4 file with a constant frame
/// rate. The file appears under its final name only when it is complete.
class VideoWriter {
 public:
  /// `width_px`, `height_px`: even, > 0; `frames_a_second` > 0 (std::invalid_argument otherwise).
  /// Throws InputError where the name does not end in .mp4, the file cannot be written, or this
  /// system has no H.264 encoder.
  VideoWriter(const std::filesystem::path& file, int width_px, int height_px,
              double frames_a_second);
  /// If finish() has not been called, no file is left.
  ~VideoWriter();
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  /// CV_8UC3, BGR, of the size stated; std::invalid_argument otherwise.
  void add(const cv::Mat& bgr);
  /// Closes the file, checks by reading it that it contains every picture, and gives it its final
  /// name. Throws InputError if it could not be written completely. To be called once, at the end.
  void finish();

  /// Throws InputError if the constructor would refuse this name, or if this program was built
  /// without video support. Call it before long work, so that the error is reported early.
  static void check_name(const std::filesystem::path& file);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hyperex::capture
