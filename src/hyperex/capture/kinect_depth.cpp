// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/kinect_depth.hpp"

#include <array>
#include <cmath>

namespace hyperex::capture {
namespace {
constexpr int no_reading = 2047;
constexpr double farthest_m = 10;  // beyond, one step of the raw value is at least half a metre

const std::array<float, 2048>& table() {
  static const std::array<float, 2048> metres = [] {
    std::array<float, 2048> t{};
    for (int raw = 0; raw < 2048; ++raw)
      t[static_cast<std::size_t>(raw)] = static_cast<float>(kinect_depth_m(raw));
    return t;
  }();
  return metres;
}

}  // namespace

double kinect_depth_m(int raw) {
  using K = NominalKinect;
  if (raw < 0 || raw >= no_reading) return 0;
  const double shift_m = ((raw - 800) / 4.0 - 0.375) * K::pixel_m;
  if (shift_m >= K::emitter_m) return 0;
  const double z_m = K::reference_m * (1 + shift_m / (K::emitter_m - shift_m));
  return z_m <= farthest_m ? z_m : 0;
}

cv::Mat registered_nominally(const cv::Mat& raw, const Intrinsics& colour) {
  using K = NominalKinect;
  cv::Mat depth_m(colour.height_px, colour.width_px, CV_32FC1, cv::Scalar(0));
  const double cx = (raw.cols - 1) / 2.0, cy = (raw.rows - 1) / 2.0;
  for (int v = 0; v < raw.rows; ++v) {
    const ushort* row = raw.ptr<ushort>(v);
    const long y = std::lround(colour.fy_px * (v - cy) / K::depth_f_px + colour.cy_px);
    if (y < 0 || y >= depth_m.rows) continue;
    float* out = depth_m.ptr<float>(static_cast<int>(y));
    for (int u = 0; u < raw.cols; ++u) {
      const float z = table()[std::min<ushort>(row[u], no_reading)];
      if (z == 0) continue;
      const long x =
          std::lround(colour.fx_px * ((u - cx) / K::depth_f_px + K::baseline_m / z) + colour.cx_px);
      if (x < 0 || x >= depth_m.cols) continue;
      if (out[x] == 0 || z < out[x]) out[x] = z;
    }
  }
  return depth_m;
}

}  // namespace hyperex::capture
