// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/video.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "hyperex/capture/buffered.hpp"
#include "hyperex/capture/camera_file.hpp"
#include "hyperex/capture/faults.hpp"
#include "hyperex/capture/video_library.hpp"
#include "hyperex/core/error.hpp"

namespace hyperex::capture {
namespace {
namespace fs = std::filesystem;

/// Returns a copy, because the capture may reuse its buffer.
cv::Mat as_bgr(const cv::Mat& picture) {
  cv::Mat bgr;
  if (picture.type() == CV_8UC1)
    cv::cvtColor(picture, bgr, cv::COLOR_GRAY2BGR);
  else if (picture.type() == CV_8UC4)
    cv::cvtColor(picture, bgr, cv::COLOR_BGRA2BGR);
  else
    picture.copyTo(bgr);
  return bgr;
}

/// The common part of video files and webcams. The first picture is read in advance, because the
/// picture size is known only from it.
class Capture : public FrameSource {
 public:
  const Intrinsics& intrinsics() const override { return intrinsics_; }
  bool has_depth() const override { return false; }
  std::vector<std::string> notes() const override { return notes_; }

 protected:
  Capture(std::string name, std::unique_ptr<VideoReader> reader)
      : name_(std::move(name)), reader_(std::move(reader)), faults_(name_) {}

  void begin(const SourceOptions& options) {
    if (!reader_->read(first_) || first_.empty()) throw InputError(name_ + ": gives no picture");
    intrinsics_ = intrinsics_of(name_, first_.cols, first_.rows, options, notes_);
  }
  /// Returns an empty picture at the end.
  cv::Mat read() {
    cv::Mat picture = std::exchange(first_, cv::Mat());
    if (picture.empty() && !reader_->read(picture)) return {};
    return as_bgr(picture);
  }
  Frame frame_of(cv::Mat picture, double time_s) {
    Frame frame;
    frame.index = faults_.frames();
    frame.time_s = time_s;
    if (picture.cols != intrinsics_.width_px || picture.rows != intrinsics_.height_px)
      frame.fault = fmt::format("{}: picture {} is {}, the first was {}", name_, frame.index,
                                size_text(picture.cols, picture.rows),
                                size_text(intrinsics_.width_px, intrinsics_.height_px));
    else
      frame.colour = std::move(picture);
    frame.valid = frame.fault.empty();
    faults_.add(frame);
    return frame;
  }

  std::string name_;
  std::unique_ptr<VideoReader> reader_;
  cv::Mat first_;
  Intrinsics intrinsics_;
  std::vector<std::string> notes_;
  FaultCount faults_;
};

class VideoFile : public Capture {
 public:
  VideoFile(const fs::path& file, const SourceOptions& options)
      : Capture(file.string(), open(file)) {
    const double rate = reader_->frames_a_second();
    const double count = reader_->frame_count();
    has_rate_ = std::isfinite(rate) && rate > 0.1 && rate < 10000;
    period_s_ = has_rate_ ? 1 / rate : 1.0 / 30;
    if (std::isfinite(count) && count >= 1 && count < 1e9) count_ = static_cast<std::size_t>(count);
    begin(options);
    first_time_s_ = reader_->position_s();
    if (!has_rate_) notes_.push_back(name_ + ": states no frame rate; taken as 30 a second");
  }
  bool live() const override { return false; }
  std::optional<std::size_t> frame_count() const override { return count_; }

  std::optional<Frame> next() override {
    const bool is_first = !first_.empty();
    cv::Mat picture = read();
    if (picture.empty()) {
      if (!std::exchange(ended_, true)) {
        if (count_ && faults_.frames() < *count_)
          notes_.push_back(
              fmt::format("{}: ends after {} of {} frames", name_, faults_.frames(), *count_));
        faults_.check_at_end();
      }
      return std::nullopt;
    }
    return frame_of(std::move(picture), is_first ? start() : advance());
  }

 private:
  static std::unique_ptr<VideoReader> open(const fs::path& file) {
    if (!fs::is_regular_file(file)) throw InputError(file, "no such file");
    if (auto reader = video_library().open_file(file.string())) return reader;
    throw InputError(file, "no video that can be read");
  }
  double start() {
    last_file_time_s_ = first_time_s_;
    return time_s_ = 0;
  }
  /// Advances the time of the frame: by the step of the file's own times if this is plausible,
  /// otherwise by one frame period.
  double advance() {
    const double file_time_s = reader_->position_s();
    const double step_s = file_time_s - last_file_time_s_;
    last_file_time_s_ = file_time_s;
    return time_s_ += std::isfinite(step_s) && step_s > 0 ? step_s : period_s_;
  }

  std::optional<std::size_t> count_;
  double period_s_ = 0, first_time_s_ = 0, last_file_time_s_ = 0, time_s_ = 0;
  bool has_rate_ = false, ended_ = false;
};

class Webcam : public Capture {
 public:
  Webcam(int number, const SourceOptions& options)
      : Capture(fmt::format("webcam:{}", number), open(number, options)) {
    begin(options);
    start_ = std::chrono::steady_clock::now();
  }
  bool live() const override { return true; }
  std::optional<std::size_t> frame_count() const override { return std::nullopt; }

  std::optional<Frame> next() override {
    const bool is_first = !first_.empty();
    cv::Mat picture = read();
    if (picture.empty()) {
      notes_.push_back(fmt::format("{}: gave no more pictures after {}", name_, faults_.frames()));
      return std::nullopt;
    }
    const auto now = is_first ? start_ : std::chrono::steady_clock::now();
    return frame_of(std::move(picture), std::chrono::duration<double>(now - start_).count());
  }

 private:
  static std::unique_ptr<VideoReader> open(int number, const SourceOptions& options) {
    const fs::path device = fmt::format("/dev/video{}", number);
    if (!fs::exists(device))
      throw InputError(fmt::format("webcam:{}: there is no {}", number, device.string()));
    auto reader = video_library().open_webcam(number);
    if (!reader)
      throw InputError(fmt::format("webcam:{}: {} cannot be opened (in use, or not permitted?)",
                                   number, device.string()));
    if (!options.camera_file.empty()) {
      const Intrinsics wanted = read_camera_file(options.camera_file).intrinsics;
      reader->request_size(wanted.width_px, wanted.height_px);
    }
    return reader;
  }
  std::chrono::steady_clock::time_point start_;
};

}  // namespace

std::unique_ptr<FrameSource> open_video(const fs::path& file, const SourceOptions& options) {
  auto source = std::make_unique<VideoFile>(file, options);
  if (options.read_ahead_frames == 0) return source;
  return read_ahead(std::move(source), options.read_ahead_frames);
}

std::unique_ptr<FrameSource> open_webcam(int number, const SourceOptions& options) {
  return std::make_unique<Webcam>(number, options);
}

}  // namespace hyperex::capture
