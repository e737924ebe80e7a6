// SPDX-License-Identifier: GPL-3.0-or-later
// An OpenNI2 driver for a camera that does not exist, to test how devices and recordings are read
// through OpenNI2. URI "made-up": 64 x 48, colour and depth at 50 Hz, 16 frames. It mirrors frames
// as a PrimeSense does, unless mirroring is switched off. Frame i before mirroring:
//   colour: red = column, green = row, blue = 10 i
//   depth:  1000 mm + 10 i + column; 500 mm more as long as registration is off
#include <Driver/OniDriverAPI.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <thread>
#include <vector>

namespace {

constexpr int width = 64, height = 48, frames = 16;
constexpr std::uint64_t period_us = 20000;
constexpr float fov_rad = 1.0f;
constexpr const char* uri_text = "made-up";

std::atomic<bool> registered{false};

class Stream : public oni::driver::StreamBase {
 public:
  explicit Stream(bool is_depth) : is_depth_(is_depth) {}
  ~Stream() override { stop(); }

  OniStatus start() override {
    stop();
    running_ = true;
    worker_ = std::thread([this] { run(); });
    return ONI_STATUS_OK;
  }
  void stop() override {
    running_ = false;
    if (worker_.joinable()) worker_.join();
  }

  OniBool isPropertySupported(int id) override {
    return id == ONI_STREAM_PROPERTY_VIDEO_MODE || id == ONI_STREAM_PROPERTY_HORIZONTAL_FOV ||
           id == ONI_STREAM_PROPERTY_VERTICAL_FOV || id == ONI_STREAM_PROPERTY_MIRRORING ||
           id == ONI_STREAM_PROPERTY_CROPPING || id == ONI_STREAM_PROPERTY_MAX_VALUE;
  }
  OniStatus getProperty(int id, void* data, int* size) override {
    switch (id) {
      case ONI_STREAM_PROPERTY_VIDEO_MODE:
        return give(mode(), data, size);
      case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
        return give(fov_rad, data, size);
      case ONI_STREAM_PROPERTY_VERTICAL_FOV:
        return give(0.75f * fov_rad, data, size);
      case ONI_STREAM_PROPERTY_MIRRORING:
        return give(OniBool{mirrored_}, data, size);
      case ONI_STREAM_PROPERTY_MAX_VALUE:
        return give(int{10000}, data, size);
      // Recordings of sensors without it cannot be replayed.
      case ONI_STREAM_PROPERTY_CROPPING:
        return give(OniCropping{0, 0, 0, width, height}, data, size);
      default:
        return ONI_STATUS_NOT_IMPLEMENTED;
    }
  }
  OniStatus setProperty(int id, const void* data, int size) override {
    if (id == ONI_STREAM_PROPERTY_MIRRORING && size == sizeof(OniBool)) {
      OniBool value;
      std::memcpy(&value, data, sizeof value);
      mirrored_ = value != 0;
      return ONI_STATUS_OK;
    }
    return id == ONI_STREAM_PROPERTY_VIDEO_MODE ? ONI_STATUS_OK : ONI_STATUS_NOT_IMPLEMENTED;
  }
  /// What a recorder writes into its file.
  void notifyAllProperties() override {
    const OniVideoMode video = mode();
    const OniBool mirrored = mirrored_;
    const float vertical_rad = 0.75f * fov_rad;
    raisePropertyChanged(ONI_STREAM_PROPERTY_VIDEO_MODE, &video, sizeof video);
    raisePropertyChanged(ONI_STREAM_PROPERTY_HORIZONTAL_FOV, &fov_rad, sizeof fov_rad);
    raisePropertyChanged(ONI_STREAM_PROPERTY_VERTICAL_FOV, &vertical_rad, sizeof vertical_rad);
    raisePropertyChanged(ONI_STREAM_PROPERTY_MIRRORING, &mirrored, sizeof mirrored);
  }

  OniVideoMode mode() const {
    return {is_depth_ ? ONI_PIXEL_FORMAT_DEPTH_1_MM : ONI_PIXEL_FORMAT_RGB888, width, height, 50};
  }

 private:
  template <class T>
  static OniStatus give(const T& value, void* data, int* size) {
    if (*size < static_cast<int>(sizeof(T))) return ONI_STATUS_BAD_PARAMETER;
    std::memcpy(data, &value, sizeof(T));
    *size = sizeof(T);
    return ONI_STATUS_OK;
  }

  void run() {
    const auto begin = std::chrono::steady_clock::now() + std::chrono::milliseconds(100);
    for (int i = 0; i < frames && running_; ++i) {
      std::this_thread::sleep_until(begin + i * std::chrono::microseconds(period_us));
      OniFrame* frame = getServices().acquireFrame();
      if (frame == nullptr) continue;
      fill(*frame, i);
      raiseNewFrame(frame);
      getServices().releaseFrame(frame);
    }
  }

  void fill(OniFrame& frame, int i) const {
    frame.frameIndex = i + 1;
    frame.videoMode = mode();
    frame.width = width;
    frame.height = height;
    frame.croppingEnabled = 0;
    frame.cropOriginX = frame.cropOriginY = 0;
    frame.sensorType = is_depth_ ? ONI_SENSOR_DEPTH : ONI_SENSOR_COLOR;
    frame.timestamp = (i + 1) * period_us;
    const int bytes_a_pixel = is_depth_ ? 2 : 3;
    frame.stride = width * bytes_a_pixel;
    frame.dataSize = frame.stride * height;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const int at = y * width + (mirrored_ ? width - 1 - x : x);
        if (is_depth_) {
          const int depth_mm = 1000 + 10 * i + x + (registered ? 0 : 500);
          static_cast<OniDepthPixel*>(frame.data)[at] = static_cast<OniDepthPixel>(depth_mm);
        } else {
          static_cast<OniRGB888Pixel*>(frame.data)[at] = {static_cast<std::uint8_t>(x),
                                                          static_cast<std::uint8_t>(y),
                                                          static_cast<std::uint8_t>(10 * i)};
        }
      }
    }
  }

  const bool is_depth_;
  std::atomic<bool> mirrored_{true}, running_{false};
  std::thread worker_;
};

class Device : public oni::driver::DeviceBase {
 public:
  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* count) override {
    *sensors = sensors_;
    *count = 2;
    return ONI_STATUS_OK;
  }
  oni::driver::StreamBase* createStream(OniSensorType type) override {
    return type == ONI_SENSOR_IR ? nullptr : new Stream(type == ONI_SENSOR_DEPTH);
  }
  void destroyStream(oni::driver::StreamBase* stream) override { delete stream; }
  OniBool isPropertySupported(int id) override {
    return id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION;
  }
  OniStatus setProperty(int id, const void* data, int) override {
    if (id != ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION) return ONI_STATUS_NOT_IMPLEMENTED;
    registered = *static_cast<const int*>(data) == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR;
    return ONI_STATUS_OK;
  }
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode) override { return TRUE; }

 private:
  OniVideoMode modes_[2] = {Stream(true).mode(), Stream(false).mode()};
  OniSensorInfo sensors_[2] = {{ONI_SENSOR_DEPTH, 1, &modes_[0]},
                               {ONI_SENSOR_COLOR, 1, &modes_[1]}};
};

class Driver : public oni::driver::DriverBase {
 public:
  explicit Driver(OniDriverServices* services) : DriverBase(services) {
    std::strcpy(info_.uri, uri_text);
    std::strcpy(info_.vendor, "nobody");
    std::strcpy(info_.name, "made-up");
  }
  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback changed, void* cookie) override {
    DriverBase::initialize(connected, disconnected, changed, cookie);
    deviceConnected(&info_);
    return ONI_STATUS_OK;
  }
  oni::driver::DeviceBase* deviceOpen(const char* uri, const char*) override {
    return std::strcmp(uri, uri_text) == 0 ? new Device : nullptr;
  }
  void deviceClose(oni::driver::DeviceBase* device) override { delete device; }
  void shutdown() override {}

 private:
  OniDeviceInfo info_{};
};

}  // namespace

#define XN_NEW(Type, ...) new Type(__VA_ARGS__)
#define XN_DELETE(pointer) delete pointer
ONI_EXPORT_DRIVER(Driver)
