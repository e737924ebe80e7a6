// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>

namespace hyperex::capture {

/// Writes a video that browsers play: H.264, yuv420p, in an MP4 file, pictures at a constant rate.
/// The file appears under its name when it is whole.
class VideoWriter {
 public:
  /// `width_px`, `height_px`: even, > 0; `frames_a_second` > 0 (std::invalid_argument otherwise).
  /// Throws InputError where the name does not end in .mp4, the file cannot be written, or this
  /// system has no H.264 encoder.
  VideoWriter(const std::filesystem::path& file, int width_px, int height_px,
              double frames_a_second);
  /// Without finish() nothing is left of the file.
  ~VideoWriter();
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  /// CV_8UC3, BGR, of the size stated; std::invalid_argument otherwise.
  void add(const cv::Mat& bgr);
  /// Closes the file, reads back that it holds every picture, and gives it its name. Throws
  /// InputError where it could not be written whole. Once, at the end.
  void finish();

  /// Throws InputError as the constructor does for a name that it would refuse, and where this
  /// program was built without videos: to say so before long work.
  static void check_name(const std::filesystem::path& file);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hyperex::capture
