// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>

// OpenCV's videoio brings FFmpeg, GStreamer and some 240 shared libraries with it: 0.1 s at the
// start of every command. It stands in a library of its own, hx_video.so (video_module.cpp), which
// is loaded when the first video or webcam is opened. The interfaces here are all that the program
// and that library share: the library uses nothing of the house, so that nothing of the house
// exists twice.
namespace hyperex::capture {

/// cv::VideoCapture, opened.
class VideoReader {
 public:
  virtual ~VideoReader() = default;
  /// False at the end.
  virtual bool read(cv::Mat& picture) = 0;
  virtual double frames_a_second() const = 0;  ///< as stated; 0 or nonsense where it is not
  virtual double frame_count() const = 0;      ///< likewise
  virtual double position_s() const = 0;       ///< of the picture read last
  virtual void ask_for_size(int width_px, int height_px) = 0;
};

/// cv::VideoWriter, opened. Its destructor closes the file.
class VideoEncoder {
 public:
  virtual ~VideoEncoder() = default;
  virtual void write(const cv::Mat& bgr) = 0;
};

/// What hx_video.so gives out, by the function `hyperex_video` (extern "C").
class VideoLibrary {
 public:
  virtual ~VideoLibrary() = default;
  /// By FFmpeg. Nothing where it is no video.
  virtual std::unique_ptr<VideoReader> open_file(const std::string& file) const = 0;
  /// /dev/videoN. Nothing where it cannot be opened.
  virtual std::unique_ptr<VideoReader> open_webcam(int number) const = 0;
  /// H.264 by FFmpeg, in the container of the file's name. Nothing where there is no such encoder
  /// or the file cannot be written. Width and height are even.
  virtual std::unique_ptr<VideoEncoder> create_file(const std::string& file, int width_px,
                                                    int height_px,
                                                    double frames_a_second) const = 0;
};

/// Loads hx_video.so from ../lib/hyperex, seen from the program's folder, in the build tree as
/// installed. It stays loaded. Throws InputError naming the file where it is missing (it is built
/// only where OpenCV's videoio is installed) or what it needs is, and says what to install.
const VideoLibrary& video_library();

}  // namespace hyperex::capture
