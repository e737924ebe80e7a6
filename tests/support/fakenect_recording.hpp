// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A recording for fakenect, libfreenect's library that replays the data of a Kinect through the
// driver's own interface. A program that is linked to it and has FAKENECT_PATH set to the folder
// finds a Kinect.
#include <libfreenect.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <opencv2/core/mat.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

namespace hyperex::test {

/// Writes frames one by one. Layout: INDEX.txt lists the files in the order of time; each is named
/// TYPE-SECONDS-TICKS, with r a PPM, d a PGM of the sensor's 11 bits, a the accelerometer; and
/// device.json holds the calibration.
class FakenectRecording {
 public:
  explicit FakenectRecording(std::filesystem::path folder) : folder_(std::move(folder)) {
    std::filesystem::create_directories(folder_);
    index_.open(folder_ / "INDEX.txt");
  }

  /// CV_8UC3 BGR, 640 x 480. `ticks`: the device's clock, 60 MHz.
  void add_colour(double time_s, std::uint32_t ticks, const cv::Mat& bgr) {
    cv::Mat rgb;
    cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
    add("r", ".ppm", "P6 640 480 255 \n", time_s, ticks, rgb.data, 640 * 480 * 3);
  }
  /// CV_16UC1, 640 x 480, raw values 0 to 2047; 2047 = no reading.
  void add_depth(double time_s, std::uint32_t ticks, const cv::Mat& raw) {
    add("d", ".pgm", "P5 640 480 65535 \n", time_s, ticks, raw.data, 640 * 480 * 2);
  }
  void add_tilt(double time_s, std::uint32_t ticks) {
    const freenect_raw_tilt_state level{0, 819, 0, 0, TILT_STATUS_STOPPED};
    add("a", ".dump", "", time_s, ticks, &level, sizeof level);
  }

 private:
  void add(const std::string& type, const std::string& extension, const std::string& header,
           double time_s, std::uint32_t ticks, const void* data, std::size_t bytes) {
    const std::string name =
        type + "-" + std::to_string(time_s) + "-" + std::to_string(ticks) + extension;
    std::ofstream file(folder_ / name, std::ios::binary);
    file << header;
    file.write(static_cast<const char*>(data), static_cast<std::streamsize>(bytes));
    index_ << name << '\n' << std::flush;
  }

  std::filesystem::path folder_;
  std::ofstream index_;
};

}  // namespace hyperex::test
