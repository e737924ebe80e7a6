// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/tum_writer.hpp"

#include <fmt/format.h>
#include <turbojpeg.h>

#include <memory>
#include <opencv2/core.hpp>
#include <ostream>
#include <stdexcept>
#include <string_view>

#include "hyperex/capture/png_picture.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"

namespace hyperex::capture {
namespace {
namespace fs = std::filesystem;

constexpr int kJpegQuality = 95;

void write_bytes(const fs::path& file, std::string_view bytes) {
  write_file_atomically(
      file, [&](std::ostream& out) { out.write(bytes.data(), std::streamsize(bytes.size())); });
}

void write_jpeg(const fs::path& file, const cv::Mat& bgr) {
  const std::unique_ptr<void, int (*)(void*)> encoder(tjInitCompress(), tjDestroy);
  unsigned char* made = nullptr;
  unsigned long size = 0;
  const int failed =
      tjCompress2(encoder.get(), bgr.data, bgr.cols, int(bgr.step), bgr.rows, TJPF_BGR, &made,
                  &size, TJSAMP_420, kJpegQuality, TJFLAG_ACCURATEDCT);
  const std::unique_ptr<unsigned char, void (*)(unsigned char*)> bytes(made, tjFree);
  if (failed) throw InputError(file, tjGetErrorStr2(encoder.get()));
  write_bytes(file, {reinterpret_cast<const char*>(made), size});
}

}  // namespace

TumWriter::TumWriter(fs::path folder, const Intrinsics& camera, double depth_per_metre)
    : folder_(std::move(folder)), camera_(camera), depth_per_metre_(depth_per_metre) {
  for (const char* pictures : {"rgb", "depth"}) {
    std::error_code error;
    fs::create_directories(folder_ / pictures, error);
    if (error) throw InputError(folder_ / pictures, "cannot be created (" + error.message() + ")");
  }
}

void TumWriter::add(const Frame& frame) {
  const cv::Size size(camera_.width_px, camera_.height_px);
  if (!frame.valid || frame.colour.size() != size || frame.depth_m.size() != size)
    throw std::invalid_argument("TumWriter: expected colour and depth of the camera's size");
  const std::string time = fmt::format("{:.6f}", frame.time_s);
  const std::string colour = "rgb/" + time + ".jpg", depth = "depth/" + time + ".png";
  cv::Mat stored;
  frame.depth_m.convertTo(stored, CV_16U, depth_per_metre_);
  write_jpeg(folder_ / colour, frame.colour);
  write_bytes(folder_ / depth, png_of_grey(stored));
  colours_ += time + " " + colour + "\n";
  depths_ += time + " " + depth + "\n";
  pairs_ += time + " " + colour + " " + time + " " + depth + "\n";
}

void TumWriter::finish() {
  write_bytes(folder_ / "rgb.txt", colours_);
  write_bytes(folder_ / "depth.txt", depths_);
  write_bytes(folder_ / "associations.txt", pairs_);
  write_bytes(folder_ / "camera.toml",
              fmt::format("width = {}\nheight = {}\nfx = {}\nfy = {}\ncx = {}\ncy = {}\n"
                          "depth_scale = {}\n",
                          camera_.width_px, camera_.height_px, camera_.fx_px, camera_.fy_px,
                          camera_.cx_px, camera_.cy_px, depth_per_metre_));
}

}  // namespace hyperex::capture
