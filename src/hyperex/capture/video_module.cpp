// SPDX-License-Identifier: GPL-3.0-or-later
// hx_video.so: the only part of the program that is linked to OpenCV's videoio.
#include <opencv2/videoio.hpp>

#include "hyperex/capture/video_library.hpp"

namespace hyperex::capture {
namespace {

class Reader : public VideoReader {
 public:
  explicit Reader(cv::VideoCapture capture) : capture_(std::move(capture)) {}
  bool read(cv::Mat& picture) override { return capture_.read(picture); }
  double frames_a_second() const override { return capture_.get(cv::CAP_PROP_FPS); }
  double frame_count() const override { return capture_.get(cv::CAP_PROP_FRAME_COUNT); }
  double position_s() const override { return capture_.get(cv::CAP_PROP_POS_MSEC) / 1000; }
  void request_size(int width_px, int height_px) override {
    capture_.set(cv::CAP_PROP_FRAME_WIDTH, width_px);
    capture_.set(cv::CAP_PROP_FRAME_HEIGHT, height_px);
  }

 private:
  cv::VideoCapture capture_;
};

class Encoder : public VideoEncoder {
 public:
  explicit Encoder(cv::VideoWriter writer) : writer_(std::move(writer)) {}
  void write(const cv::Mat& bgr) override { writer_.write(bgr); }

 private:
  cv::VideoWriter writer_;
};

class Library : public VideoLibrary {
 public:
  std::unique_ptr<VideoReader> open_file(const std::string& file) const override {
    return opened(cv::VideoCapture(file, cv::CAP_FFMPEG));
  }
  std::unique_ptr<VideoReader> open_webcam(int number) const override {
    return opened(cv::VideoCapture(number, cv::CAP_V4L2));
  }
  std::unique_ptr<VideoEncoder> create_file(const std::string& file, int width_px, int height_px,
                                            double frames_a_second) const override {
    cv::VideoWriter writer(file, cv::CAP_FFMPEG, cv::VideoWriter::fourcc('a', 'v', 'c', '1'),
                           frames_a_second, {width_px, height_px});
    if (!writer.isOpened()) return nullptr;
    return std::make_unique<Encoder>(std::move(writer));
  }

 private:
  static std::unique_ptr<VideoReader> opened(cv::VideoCapture capture) {
    if (!capture.isOpened()) return nullptr;
    return std::make_unique<Reader>(std::move(capture));
  }
};

}  // namespace
}  // namespace hyperex::capture

extern "C" __attribute__((visibility("default"))) const hyperex::capture::VideoLibrary*
hyperex_video() {
  static const hyperex::capture::Library library;
  return &library;
}
