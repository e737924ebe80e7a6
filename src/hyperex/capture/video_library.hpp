// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>

// OpenCV's videoio loads FFmpeg, GStreamer and some 240 shared libraries, which would take 0.1 s at
// the start of every command. It is therefore linked to a shared library of its own, hx_video.so
// (video_module.cpp), which is loaded when the first video or webcam is opened. The program and
// that library share only the interfaces in this header. The library uses no other code of Hyperex,
// so that no part of Hyperex exists twice in one process.
namespace hyperex::capture {

/// An open cv::VideoCapture.
class VideoReader {
 public:
  virtual ~VideoReader() = default;
  /// False at the end.
  virtual bool read(cv::Mat& picture) = 0;
  /// The rate that the file states; 0 or meaningless if it states none.
  virtual double frames_a_second() const = 0;
  virtual double frame_count() const = 0;  ///< likewise
  virtual double position_s() const = 0;   ///< of the last picture read
  virtual void request_size(int width_px, int height_px) = 0;
};

/// An open cv::VideoWriter. Its destructor closes the file.
class VideoEncoder {
 public:
  virtual ~VideoEncoder() = default;
  virtual void write(const cv::Mat& bgr) = 0;
};

/// The interface that the function `hyperex_video` (extern "C") of hx_video.so returns.
class VideoLibrary {
 public:
  virtual ~VideoLibrary() = default;
  /// Opens a file by FFmpeg. Returns null if it is not a video.
  virtual std::unique_ptr<VideoReader> open_file(const std::string& file) const = 0;
  /// Opens /dev/videoN. Returns null if it cannot be opened.
  virtual std::unique_ptr<VideoReader> open_webcam(int number) const = 0;
  /// Creates an H.264 video by FFmpeg; the extension of the file name selects the container.
  /// Returns null if there is no such encoder or if the file cannot be written. Width and height
  /// must be even.
  virtual std::unique_ptr<VideoEncoder> create_file(const std::string& file, int width_px,
                                                    int height_px,
                                                    double frames_a_second) const = 0;
};

/// Loads hx_video.so from ../lib/hyperex relative to the program's folder, both in the build tree
/// and in an installation. The library stays loaded. Throws InputError naming the file if it is
/// missing (it is built only if OpenCV's videoio is installed) or if a library that it needs is
/// missing. The message says what to install.
const VideoLibrary& video_library();

}  // namespace hyperex::capture
