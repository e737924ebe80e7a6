// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/openni.hpp"

#include <OpenNI.h>
#include <fmt/format.h>

#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <mutex>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <thread>

#include "hyperex/capture/buffered.hpp"
#include "hyperex/capture/camera_file.hpp"
#include "hyperex/capture/faults.hpp"
#include "hyperex/capture/pairing.hpp"
#include "hyperex/core/error.hpp"

namespace hyperex::capture {
namespace {
namespace fs = std::filesystem;

constexpr int device_patience_ms = 5000;
constexpr int file_patience_ms = 2000;  // sufficient for the player to deliver one frame

/// OpenNI's own error message on one line.
std::string reason() {
  std::string text = openni::OpenNI::getExtendedError();
  for (char& c : text)
    if (c == '\n' || c == '\t') c = ' ';
  while (text.ends_with(' ')) text.pop_back();
  return text.empty() ? "" : " (" + text + ")";
}

/// OpenNI stores every thread that has waited for a frame and later checks whether it is still
/// alive. This check crashes if the thread has ended. Therefore a single thread that never ends
/// does all the waiting.
class WaitingThread {
 public:
  /// Runs `work` on that thread and returns its result.
  template <class Work>
  static auto run(Work work) {
    std::packaged_task<decltype(work())()> task(std::move(work));
    auto result = task.get_future();
    WaitingThread& self = instance();
    {
      const std::lock_guard lock(self.mutex_);
      self.tasks_.push_back([&task] { task(); });
    }
    self.changed_.notify_one();
    return result.get();
  }

 private:
  static WaitingThread& instance() {
    // Never destroyed: its thread runs until the program ends.
    static WaitingThread& self = *new WaitingThread;
    return self;
  }
  WaitingThread() {
    std::thread([this] {
      while (true) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return !tasks_.empty(); });
        const auto task = std::move(tasks_.front());
        tasks_.pop_front();
        lock.unlock();
        task();
      }
    }).detach();
  }
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;
};

/// Initialises OpenNI. OpenNI counts the calls, so several sessions may exist.
struct Session {
  Session() {
    if (openni::OpenNI::initialize() != openni::STATUS_OK)
      throw InputError("openni: cannot start" + reason());
  }
  ~Session() { openni::OpenNI::shutdown(); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
};

/// The picture in BGR order; empty if its format is unknown.
cv::Mat colour_of(const openni::VideoFrameRef& frame) {
  const auto view = [&](int type) {
    return cv::Mat(frame.getHeight(), frame.getWidth(), type, const_cast<void*>(frame.getData()),
                   static_cast<std::size_t>(frame.getStrideInBytes()));
  };
  cv::Mat bgr;
  switch (frame.getVideoMode().getPixelFormat()) {
    case openni::PIXEL_FORMAT_RGB888:
      cv::cvtColor(view(CV_8UC3), bgr, cv::COLOR_RGB2BGR);
      break;
    case openni::PIXEL_FORMAT_YUV422:
      cv::cvtColor(view(CV_8UC2), bgr, cv::COLOR_YUV2BGR_UYVY);
      break;
    case openni::PIXEL_FORMAT_YUYV:
      cv::cvtColor(view(CV_8UC2), bgr, cv::COLOR_YUV2BGR_YUYV);
      break;
    case openni::PIXEL_FORMAT_GRAY8:
      cv::cvtColor(view(CV_8UC1), bgr, cv::COLOR_GRAY2BGR);
      break;
    default:
      break;
  }
  return bgr;
}

cv::Mat depth_of(const openni::VideoFrameRef& frame) {
  const auto format = frame.getVideoMode().getPixelFormat();
  if (format != openni::PIXEL_FORMAT_DEPTH_1_MM && format != openni::PIXEL_FORMAT_DEPTH_100_UM)
    return {};
  cv::Mat depth_m;
  cv::Mat(frame.getHeight(), frame.getWidth(), CV_16UC1, const_cast<void*>(frame.getData()),
          static_cast<std::size_t>(frame.getStrideInBytes()))
      .convertTo(depth_m, CV_32F, format == openni::PIXEL_FORMAT_DEPTH_1_MM ? 1e-3 : 1e-4);
  return depth_m;
}

/// One stream of the device. Mirroring is switched off.
class Sensor {
 public:
  ~Sensor() {
    if (!stream_.isValid()) return;
    stream_.stop();
    stream_.destroy();
  }

  void create(openni::Device& device, openni::SensorType type, const std::string& name) {
    if (stream_.create(device, type) != openni::STATUS_OK) throw InputError(name + reason());
  }
  /// Selects the given mode if the sensor supports it; otherwise the mode is left unchanged.
  void choose_mode(openni::PixelFormat format, int width, int height) {
    const auto& modes = stream_.getSensorInfo().getSupportedVideoModes();
    for (int i = 0; i < modes.getSize(); ++i) {
      const openni::VideoMode& mode = modes[i];
      if (mode.getPixelFormat() == format && mode.getResolutionX() == width &&
          mode.getResolutionY() == height && mode.getFps() == 30)
        stream_.setVideoMode(mode);
    }
  }
  void start(const std::string& name) {
    stream_.setMirroringEnabled(false);
    mirrored_ = stream_.getMirroringEnabled();
    if (stream_.start() != openni::STATUS_OK) throw InputError(name + reason());
  }
  /// The picture that has just arrived, decoded by `decode`; nothing if OpenNI cannot read it.
  template <class Decode>
  std::optional<TimedPicture> read(Decode decode) {
    openni::VideoFrameRef frame;
    ++frames_;
    if (stream_.readFrame(&frame) != openni::STATUS_OK || !frame.isValid()) return std::nullopt;
    TimedPicture timed{1e-6 * static_cast<double>(frame.getTimestamp()), decode(frame)};
    if (mirrored_ && !timed.picture.empty()) cv::flip(timed.picture, timed.picture, 1);
    return timed;
  }
  openni::VideoStream& stream() { return stream_; }
  int frames() const { return frames_; }

 private:
  openni::VideoStream stream_;
  bool mirrored_ = false;
  int frames_ = 0;
};

class OpenniSource : public FrameSource {
 public:
  /// `uri` nullptr: any device.
  OpenniSource(std::string name, const char* uri, bool is_file, const SourceOptions& options)
      : name_(std::move(name)),
        faults_(name_),
        is_file_(is_file),
        has_depth_(!options.colour_only) {
    if (device_.open(uri) != openni::STATUS_OK)
      throw InputError(name_ +
                       (is_file ? ": no recording that OpenNI2 can read"
                                : ": no device found or it cannot be opened") +
                       reason());
    if (device_.getSensorInfo(openni::SENSOR_COLOR) == nullptr)
      throw InputError(name_ + ": has no colour stream");
    if (has_depth_ && device_.getSensorInfo(openni::SENSOR_DEPTH) == nullptr) {
      has_depth_ = false;
      notes_.push_back(name_ + ": has no depth stream, so colour only");
    }
    if (is_file) prepare_file();
    colour_.create(device_, openni::SENSOR_COLOR, name_ + ": no colour stream");
    if (has_depth_) depth_.create(device_, openni::SENSOR_DEPTH, name_ + ": no depth stream");
    if (!is_file) prepare_device();
    find_intrinsics(options);
    colour_.start(name_ + ": colour does not start");
    if (has_depth_) depth_.start(name_ + ": depth does not start");
  }

  const Intrinsics& intrinsics() const override { return intrinsics_; }
  bool has_depth() const override { return has_depth_; }
  bool live() const override { return !is_file_; }
  std::optional<std::size_t> frame_count() const override { return std::nullopt; }
  std::vector<std::string> notes() const override { return notes_; }

  std::optional<Frame> next() override {
    return WaitingThread::run([this] { return next_frame(); });
  }

 private:
  std::optional<Frame> next_frame() {
    if (ended_) return std::nullopt;
    while (true) {
      if (auto frame = take()) return frame;
      if (is_file_ && all_read()) return end("");
      openni::VideoStream* streams[] = {&colour_.stream(), &depth_.stream()};
      int ready = -1;
      const int patience_ms = is_file_ ? file_patience_ms : device_patience_ms;
      if (openni::OpenNI::waitForAnyStream(streams, has_depth_ ? 2 : 1, &ready, patience_ms) !=
          openni::STATUS_OK)
        return end(fmt::format("no frame within {} s", patience_ms / 1000));
      if (ready == 0) {
        auto colour = colour_.read(colour_of);
        if (!colour) continue;
        if (!has_depth_) pairing_.add_depth({colour->time_s, {}});
        pairing_.add_colour(std::move(*colour));
      } else if (auto depth = depth_.read(depth_of)) {
        pairing_.add_depth(std::move(*depth));
      }
    }
  }

  void prepare_file() {
    openni::PlaybackControl* playback = device_.getPlaybackControl();
    if (playback == nullptr) throw InputError(name_ + ": is no recording");
    playback->setRepeatEnabled(false);
    playback->setSpeed(-1);  // delivers each frame when it is requested
    if (has_depth_)
      notes_.push_back(name_ +
                       ": does not say whether its depth was registered to colour; it is "
                       "taken to be");
  }
  void prepare_device() {
    colour_.choose_mode(openni::PIXEL_FORMAT_RGB888, 640, 480);
    if (!has_depth_) return;
    depth_.choose_mode(openni::PIXEL_FORMAT_DEPTH_1_MM, 640, 480);
    constexpr auto registered = openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR;
    if (!device_.isImageRegistrationModeSupported(registered) ||
        device_.setImageRegistrationMode(registered) != openni::STATUS_OK)
      throw InputError(name_ +
                       ": the device cannot register its depth to colour (colour only "
                       "would work)");
    // Not all devices support this; pairing by time suffices.
    device_.setDepthColorSyncEnabled(true);
  }

  void find_intrinsics(const SourceOptions& options) {
    const openni::VideoMode mode = colour_.stream().getVideoMode();
    const int width = mode.getResolutionX(), height = mode.getResolutionY();
    const double stated_deg = colour_.stream().getHorizontalFieldOfView() * 180 / std::numbers::pi;
    if (!options.camera_file.empty()) {
      const Camera camera = read_camera_file(options.camera_file);
      intrinsics_ = camera.intrinsics;
      notes_.insert(notes_.end(), camera.notes.begin(), camera.notes.end());
      if (intrinsics_.width_px != width || intrinsics_.height_px != height)
        throw InputError(options.camera_file,
                         fmt::format("describes pictures of {}, but those of {} are {}",
                                     size_text(intrinsics_.width_px, intrinsics_.height_px), name_,
                                     size_text(width, height)));
    } else if (stated_deg > 10 && stated_deg < 170 && width >= height) {
      intrinsics_ = guess_intrinsics(width, height, stated_deg);
    } else {
      notes_.push_back(fmt::format("{}: states no field of view; it is taken to be {:g} degrees",
                                   name_, options.field_of_view_deg));
      intrinsics_ = guess_intrinsics(width, height, options.field_of_view_deg);
    }
    if (!is_file_) return;
    openni::PlaybackControl& playback = *device_.getPlaybackControl();
    colour_frames_ = playback.getNumberOfFrames(colour_.stream());
    depth_frames_ = has_depth_ ? playback.getNumberOfFrames(depth_.stream()) : 0;
  }

  bool all_read() const {
    return colour_.frames() >= colour_frames_ && depth_.frames() >= depth_frames_;
  }

  std::optional<Frame> take() {
    auto pair = pairing_.take();
    if (!pair) return std::nullopt;
    Frame frame;
    frame.index = faults_.frames();
    frame.colour = std::move(pair->first.picture);
    frame.depth_m = std::move(pair->second.picture);
    if (!first_time_s_) first_time_s_ = pair->first.time_s;
    frame.time_s = pair->first.time_s - *first_time_s_;
    frame.fault = fault_of(frame);
    frame.valid = frame.fault.empty();
    if (frame.valid) last_time_s_ = frame.time_s;
    faults_.add(frame);
    return frame;
  }
  /// Returns the fault of a frame. Also resizes its depth to the size of its colour picture.
  std::string fault_of(Frame& frame) const {
    const cv::Size size(intrinsics_.width_px, intrinsics_.height_px);
    if (frame.colour.empty()) return name_ + ": colour of an unknown format";
    if (frame.colour.size() != size)
      return fmt::format("{}: a picture of {}, expected {}", name_,
                         size_text(frame.colour.cols, frame.colour.rows),
                         size_text(size.width, size.height));
    if (last_time_s_ && frame.time_s <= *last_time_s_)
      return fmt::format("{}: time goes back from {:.6f} to {:.6f} s", name_, *last_time_s_,
                         frame.time_s);
    if (!has_depth_) return "";
    if (frame.depth_m.empty()) return name_ + ": depth of an unknown format";
    if (frame.depth_m.cols * size.height != frame.depth_m.rows * size.width)
      return fmt::format("{}: depth of {} for colour of {}", name_,
                         size_text(frame.depth_m.cols, frame.depth_m.rows),
                         size_text(size.width, size.height));
    if (frame.depth_m.size() != size)
      cv::resize(frame.depth_m, frame.depth_m, size, 0, 0, cv::INTER_NEAREST);
    return cv::countNonZero(frame.depth_m) == 0 ? name_ + ": depth without a single reading" : "";
  }

  /// Before the first frame, the end is an error. Later, the frames seen so far remain valid.
  std::optional<Frame> end(const std::string& why) {
    ended_ = true;
    if (!why.empty() && faults_.frames() == 0) throw InputError(name_ + ": " + why);
    if (!why.empty())
      notes_.push_back(fmt::format("{}: {} after {} frames", name_, why, faults_.frames()));
    if (pairing_.unpaired() > 0)
      notes_.push_back(fmt::format("{}: {} pictures without a partner within 20 ms were left out",
                                   name_, pairing_.unpaired()));
    faults_.check_at_end();
    return std::nullopt;
  }

  Session session_;
  openni::Device device_;
  Sensor colour_, depth_;
  std::string name_;
  Intrinsics intrinsics_;
  std::vector<std::string> notes_;
  FaultCount faults_;
  Pairing pairing_;
  std::optional<double> first_time_s_, last_time_s_;
  int colour_frames_ = 0, depth_frames_ = 0;
  bool is_file_, has_depth_, ended_ = false;
};

}  // namespace

std::unique_ptr<FrameSource> open_openni(const std::string& uri, const SourceOptions& options) {
  return std::make_unique<OpenniSource>(uri.empty() ? "openni" : "openni:" + uri,
                                        uri.empty() ? nullptr : uri.c_str(), false, options);
}

std::unique_ptr<FrameSource> open_oni(const fs::path& file, const SourceOptions& options) {
  if (!fs::is_regular_file(file)) throw InputError(file, "no such file");
  auto source = std::make_unique<OpenniSource>(file.string(), file.c_str(), true, options);
  if (options.read_ahead_frames == 0) return source;
  return read_ahead(std::move(source), options.read_ahead_frames);
}

}  // namespace hyperex::capture
