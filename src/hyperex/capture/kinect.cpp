// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/kinect.hpp"

#include <fmt/format.h>
#include <libfreenect.h>
#include <sys/time.h>

#include <chrono>
#include <opencv2/imgproc.hpp>

#include "hyperex/capture/camera_file.hpp"
#include "hyperex/capture/faults.hpp"
#include "hyperex/capture/kinect_depth.hpp"
#include "hyperex/capture/pairing.hpp"
#include "hyperex/core/error.hpp"

namespace hyperex::capture {
namespace {

constexpr int width_px = 640, height_px = 480;
constexpr double nominal_f_px = 525;
constexpr double ticks_a_second = 60e6;
constexpr auto patience = std::chrono::seconds(5);

/// Seconds since the first time stamp. Handles the overflow of the device's 32-bit counter (every
/// 71 s).
class TickClock {
 public:
  double seconds(std::uint32_t ticks) {
    if (!last_) last_ = ticks;
    elapsed_ += static_cast<std::int32_t>(ticks - *last_);
    last_ = ticks;
    return static_cast<double>(elapsed_) / ticks_a_second;
  }

 private:
  std::optional<std::uint32_t> last_;
  std::int64_t elapsed_ = 0;
};

class Kinect : public FrameSource {
 public:
  explicit Kinect(const SourceOptions& options)
      : faults_("kinect"), colour_only_(options.colour_only) {
    read_camera(options);
    open();
  }
  ~Kinect() override { close(); }

  const Intrinsics& intrinsics() const override { return intrinsics_; }
  bool has_depth() const override { return !colour_only_; }
  bool live() const override { return true; }
  std::optional<std::size_t> frame_count() const override { return std::nullopt; }
  std::vector<std::string> notes() const override { return notes_; }

  std::optional<Frame> next() override {
    if (lost_) return std::nullopt;
    const auto deadline = std::chrono::steady_clock::now() + patience;
    while (true) {
      if (auto frame = take()) return frame;
      timeval wait{.tv_sec = 0, .tv_usec = 100000};
      const int result = freenect_process_events_timeout(context_, &wait);
      if (result < 0) return lose(fmt::format("the device was lost (error {})", result));
      if (std::chrono::steady_clock::now() > deadline)
        return lose(fmt::format("no frame within {} s", patience.count()));
    }
  }

 private:
  void read_camera(const SourceOptions& options) {
    if (options.camera_file.empty()) {
      intrinsics_ = {nominal_f_px,          nominal_f_px, (width_px - 1) / 2.0,
                     (height_px - 1) / 2.0, width_px,     height_px};
      notes_.push_back("kinect: the colour camera is taken to be the nominal one, 525 pixels");
      return;
    }
    const Camera camera = read_camera_file(options.camera_file);
    intrinsics_ = camera.intrinsics;
    notes_ = camera.notes;
    if (intrinsics_.width_px != width_px || intrinsics_.height_px != height_px)
      throw InputError(options.camera_file, "a Kinect gives pictures of 640 x 480");
  }

  void open() {
    if (freenect_init(&context_, nullptr) < 0) {
      context_ = nullptr;
      throw InputError("kinect: the USB system cannot be reached");
    }
    try {
      freenect_set_log_level(context_, FREENECT_LOG_FATAL);
      freenect_select_subdevices(context_, FREENECT_DEVICE_CAMERA);
      if (freenect_num_devices(context_) < 1)
        throw InputError("kinect: none found (plugged in, and its own power supply on?)");
      if (freenect_open_device(context_, &device_, 0) < 0)
        throw InputError(
            "kinect: cannot be opened (in use, or not permitted: see libfreenect's udev rules)");
      freenect_set_user(device_, this);
      freenect_set_video_callback(device_, on_colour);
      check(freenect_set_video_mode(
                device_, freenect_find_video_mode(FREENECT_RESOLUTION_MEDIUM, FREENECT_VIDEO_RGB)),
            "colour of 640 x 480");
      check(freenect_start_video(device_), "a colour stream");
      if (colour_only_) return;
      freenect_set_depth_callback(device_, on_depth);
      choose_depth_mode();
      check(freenect_start_depth(device_), "a depth stream");
    } catch (...) {
      close();
      throw;
    }
  }
  /// Selects a mode from the device's own list. Some drivers abort the program when an unsupported
  /// mode is requested.
  void choose_depth_mode() {
    const auto set = [&](freenect_depth_format format) {
      for (int i = 0; i < freenect_get_depth_mode_count(); ++i) {
        const freenect_frame_mode mode = freenect_get_depth_mode(i);
        if (mode.is_valid != 0 && mode.depth_format == format && mode.width == width_px)
          return freenect_set_depth_mode(device_, mode) >= 0;
      }
      return false;
    };
    if (set(FREENECT_DEPTH_REGISTERED)) return;
    if (!set(FREENECT_DEPTH_11BIT)) throw InputError("kinect: offers no depth of 640 x 480");
    is_raw_ = true;
    notes_.push_back(
        "kinect: the driver does not register depth to colour; done by the nominal calibration");
  }
  static void check(int result, const char* what) {
    if (result < 0) throw InputError(fmt::format("kinect: refuses {}", what));
  }

  void close() {
    if (device_ != nullptr) {
      freenect_stop_depth(device_);
      freenect_stop_video(device_);
      freenect_close_device(device_);
    }
    if (context_ != nullptr) freenect_shutdown(context_);
    device_ = nullptr;
    context_ = nullptr;
  }

  static void on_colour(freenect_device* device, void* rgb, std::uint32_t ticks) {
    auto& self = *static_cast<Kinect*>(freenect_get_user(device));
    TimedPicture colour{self.clock_.seconds(ticks), {}};
    cv::cvtColor(cv::Mat(height_px, width_px, CV_8UC3, rgb), colour.picture, cv::COLOR_RGB2BGR);
    if (self.colour_only_) self.pairing_.add_depth({colour.time_s, {}});
    self.pairing_.add_colour(std::move(colour));
  }
  static void on_depth(freenect_device* device, void* data, std::uint32_t ticks) {
    auto& self = *static_cast<Kinect*>(freenect_get_user(device));
    TimedPicture depth{self.clock_.seconds(ticks), {}};
    const cv::Mat values(height_px, width_px, CV_16UC1, data);
    if (self.is_raw_)
      depth.picture = registered_nominally(values, self.intrinsics_);
    else
      values.convertTo(depth.picture, CV_32F, 1e-3);
    self.pairing_.add_depth(std::move(depth));
  }

  std::optional<Frame> take() {
    auto pair = pairing_.take();
    if (!pair) return std::nullopt;
    Frame frame;
    frame.index = faults_.frames();
    frame.time_s = pair->first.time_s;
    frame.colour = std::move(pair->first.picture);
    frame.depth_m = std::move(pair->second.picture);
    if (last_time_s_ && frame.time_s <= *last_time_s_)
      frame.fault = fmt::format("kinect: time goes back from {:.6f} to {:.6f} s", *last_time_s_,
                                frame.time_s);
    else if (!colour_only_ && cv::countNonZero(frame.depth_m) == 0)
      frame.fault = "kinect: depth without a single reading";
    frame.valid = frame.fault.empty();
    if (frame.valid) last_time_s_ = frame.time_s;
    faults_.add(frame);
    return frame;
  }

  /// If the camera is lost before the first frame, this is an error. Later, the frames seen so far
  /// remain valid.
  std::optional<Frame> lose(const std::string& why) {
    lost_ = true;
    if (faults_.frames() == 0) throw InputError("kinect: " + why);
    notes_.push_back(fmt::format("kinect: {} after {} frames", why, faults_.frames()));
    faults_.check_at_end();
    return std::nullopt;
  }

  Intrinsics intrinsics_;
  std::vector<std::string> notes_;
  FaultCount faults_;
  Pairing pairing_;
  TickClock clock_;
  freenect_context* context_ = nullptr;
  freenect_device* device_ = nullptr;
  std::optional<double> last_time_s_;
  bool colour_only_, is_raw_ = false, lost_ = false;
};

}  // namespace

std::unique_ptr<FrameSource> open_kinect(const SourceOptions& options) {
  return std::make_unique<Kinect>(options);
}

}  // namespace hyperex::capture
