// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/decode.hpp"

#include <turbojpeg.h>

#include <cstdio>
#include <fstream>
#include <memory>
#include <opencv2/core.hpp>

#include "hyperex/capture/camera_file.hpp"
#include "hyperex/capture/png_picture.hpp"

// OpenCV's imgcodecs is not used: it loads some 120 shared libraries, and it fills truncated JPEG
// data with grey without reporting it.
namespace hyperex::capture {
namespace {
namespace fs = std::filesystem;
using Bytes = std::span<const unsigned char>;

/// Limits the memory that a corrupt header can request.
constexpr double kMostPixels = 1 << 28;

bool begins_with(Bytes bytes, std::string_view magic) {
  return bytes.size() >= magic.size() &&
         std::equal(magic.begin(), magic.end(), bytes.begin(),
                    [](char a, unsigned char b) { return static_cast<unsigned char>(a) == b; });
}

/// Up to four superfluous bytes before the end. Webcams often write these; the picture is intact.
bool is_harmless(const std::string& warning) {
  unsigned count = 0, marker = 0;
  return std::sscanf(warning.c_str(), "Corrupt JPEG data: %u extraneous bytes before marker 0x%x",
                     &count, &marker) == 2 &&
         count <= 4 && marker == 0xd9;
}

Decoded decode_jpeg(Bytes bytes, const std::string& name) {
  const std::unique_ptr<void, int (*)(void*)> decoder(tjInitDecompress(), tjDestroy);
  int width = 0, height = 0, subsampling = 0, colours = 0;
  if (tjDecompressHeader3(decoder.get(), bytes.data(), bytes.size(), &width, &height, &subsampling,
                          &colours) != 0)
    return {{}, name + ": torn or no JPEG (" + tjGetErrorStr2(decoder.get()) + ")"};
  if (double(width) * height > kMostPixels)
    return {{}, name + ": " + size_text(width, height) + " pixels are beyond reason"};
  cv::Mat picture(height, width, CV_8UC3);
  if (tjDecompress2(decoder.get(), bytes.data(), bytes.size(), picture.data, width,
                    static_cast<int>(picture.step), height, TJPF_BGR, 0) != 0 &&
      !is_harmless(tjGetErrorStr2(decoder.get())))
    return {{}, name + ": torn picture (" + tjGetErrorStr2(decoder.get()) + ")"};
  return {picture, {}};
}

Decoded decode_png(Bytes bytes, PngAs as, const std::string& name) {
  PngPicture png = read_png(bytes, as, kMostPixels);
  if (!png.fault.empty())
    return {{}, name + ": torn picture (cut short or damaged: " + png.fault + ")"};
  return {std::move(png.picture), {}};
}

/// The bytes of a file. If they cannot be read, sets `fault`.
std::vector<unsigned char> read_bytes(const fs::path& file, std::string& fault) {
  // This is checked first, because opening a pipe would block.
  std::error_code ignored;
  std::ifstream stream;
  if (fs::is_regular_file(file, ignored)) stream.open(file, std::ios::binary | std::ios::ate);
  if (!stream.is_open()) {
    fault = file.string() + ": no such file";
    return {};
  }
  std::vector<unsigned char> bytes(static_cast<std::size_t>(stream.tellg()));
  stream.seekg(0).read(reinterpret_cast<char*>(bytes.data()),
                       static_cast<std::streamsize>(bytes.size()));
  if (!stream)
    fault = file.string() + ": cannot be read";
  else if (bytes.empty())
    fault = file.string() + ": empty file";
  return bytes;
}

/// The size stated in the header; empty if the header cannot be read (decoding then reports it).
cv::Size size_of(Bytes bytes) {
  if (is_png(bytes)) return png_size(bytes);
  const std::unique_ptr<void, int (*)(void*)> decoder(tjInitDecompress(), tjDestroy);
  int width = 0, height = 0, subsampling = 0, colours = 0;
  if (begins_with(bytes, "\xFF\xD8") &&
      tjDecompressHeader3(decoder.get(), bytes.data(), bytes.size(), &width, &height, &subsampling,
                          &colours) == 0)
    return {width, height};
  return {};
}

/// Checked before a picture is decoded, because a small file may expand to any number of equal
/// pixels.
std::string fault_of_size(const fs::path& file, Bytes bytes, const Intrinsics& expected) {
  const cv::Size size = size_of(bytes);
  if (size.empty() || (size.width == expected.width_px && size.height == expected.height_px))
    return {};
  return file.string() + ": " + size_text(size.width, size.height) +
         " pixels, but the camera has " + size_text(expected.width_px, expected.height_px);
}

}  // namespace

Decoded decode_colour(Bytes bytes, const std::string& name) {
  if (begins_with(bytes, "\xFF\xD8")) return decode_jpeg(bytes, name);
  if (is_png(bytes)) return decode_png(bytes, PngAs::bgr, name);
  return {{}, name + ": torn picture, or neither JPEG nor PNG"};
}

Decoded decode_colour(const fs::path& file, const Intrinsics& expected) {
  Decoded decoded;
  const auto bytes = read_bytes(file, decoded.fault);
  if (decoded.fault.empty()) decoded.fault = fault_of_size(file, bytes, expected);
  if (decoded.fault.empty()) decoded = decode_colour(bytes, file.string());
  return decoded;
}

Decoded decode_depth(const fs::path& file, const Intrinsics& expected, double depth_per_metre) {
  constexpr const char* kind = ": expected depth as a 16-bit picture of one channel";
  Decoded decoded;
  const auto bytes = read_bytes(file, decoded.fault);
  if (!decoded.fault.empty()) return decoded;
  if (begins_with(bytes, "\xFF\xD8")) return {{}, file.string() + kind};
  if (!is_png(bytes)) return {{}, file.string() + ": torn picture, or no PNG"};
  decoded.fault = fault_of_size(file, bytes, expected);
  if (!decoded.fault.empty()) return decoded;
  decoded = decode_png(bytes, PngAs::stored_grey, file.string());
  if (!decoded.fault.empty()) return decoded;
  if (decoded.picture.type() != CV_16UC1) return {{}, file.string() + kind};
  if (cv::countNonZero(decoded.picture) == 0)
    return {{}, file.string() + ": depth without a single reading"};
  cv::Mat depth_m;
  decoded.picture.convertTo(depth_m, CV_32F, 1 / depth_per_metre);
  return {depth_m, {}};
}

}  // namespace hyperex::capture
