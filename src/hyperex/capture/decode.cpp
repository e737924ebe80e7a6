// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/decode.hpp"

#include <turbojpeg.h>
#include <zlib.h>

#include <cstdio>
#include <fstream>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <string_view>
#include <vector>

#include "hyperex/capture/camera_file.hpp"

namespace hyperex::capture {
namespace {
namespace fs = std::filesystem;
using Bytes = std::vector<unsigned char>;

bool begins_with(const Bytes& bytes, std::string_view magic) {
  return bytes.size() >= magic.size() &&
         std::equal(magic.begin(), magic.end(), bytes.begin(),
                    [](char a, unsigned char b) { return static_cast<unsigned char>(a) == b; });
}

/// PNG checks itself, chunk by chunk. Done here first, as libpng prints its complaints itself.
bool is_torn_png(const Bytes& bytes) {
  constexpr std::string_view magic = "\x89PNG\r\n\x1A\n";
  if (!begins_with(bytes, "\x89PNG")) return false;
  const auto number = [&](std::size_t at) {
    return std::size_t{bytes[at]} << 24 | std::size_t{bytes[at + 1]} << 16 |
           std::size_t{bytes[at + 2]} << 8 | std::size_t{bytes[at + 3]};
  };
  // A chunk: its length, its four letters, so many bytes, the check sum of letters and bytes.
  for (std::size_t at = magic.size(); at + 12 <= bytes.size();) {
    const std::size_t length = number(at);
    if (length > bytes.size() - at - 12) return true;
    const unsigned char* letters = bytes.data() + at + 4;
    if (crc32(0, letters, static_cast<uInt>(length + 4)) != number(at + 8 + length)) return true;
    if (std::equal(letters, letters + 4, "IEND")) return false;
    at += 12 + length;
  }
  return true;
}

/// A byte or two too many before the end: what webcams write day in, day out, and no tear.
bool is_harmless(const std::string& warning) {
  unsigned count = 0, marker = 0;
  return std::sscanf(warning.c_str(), "Corrupt JPEG data: %u extraneous bytes before marker 0x%x",
                     &count, &marker) == 2 &&
         count <= 4 && marker == 0xd9;
}

/// OpenCV keeps quiet about torn JPEG data and fills up with grey, libjpeg-turbo itself does not.
Decoded decode_jpeg(const Bytes& bytes, const std::string& name) {
  const std::unique_ptr<void, int (*)(void*)> decoder(tjInitDecompress(), tjDestroy);
  int width = 0, height = 0, subsampling = 0, colours = 0;
  if (tjDecompressHeader3(decoder.get(), bytes.data(), bytes.size(), &width, &height, &subsampling,
                          &colours) != 0)
    return {{}, name + ": torn or no JPEG (" + tjGetErrorStr2(decoder.get()) + ")"};
  cv::Mat picture(height, width, CV_8UC3);
  if (tjDecompress2(decoder.get(), bytes.data(), bytes.size(), picture.data, width,
                    static_cast<int>(picture.step), height, TJPF_BGR, 0) != 0 &&
      !is_harmless(tjGetErrorStr2(decoder.get())))
    return {{}, name + ": torn picture (" + tjGetErrorStr2(decoder.get()) + ")"};
  return {picture, {}};
}

Decoded decode(const fs::path& file, int flags) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  std::error_code ignored;
  if (!stream || !fs::is_regular_file(file, ignored)) return {{}, file.string() + ": no such file"};
  Bytes bytes(static_cast<std::size_t>(stream.tellg()));
  stream.seekg(0).read(reinterpret_cast<char*>(bytes.data()),
                       static_cast<std::streamsize>(bytes.size()));
  if (!stream) return {{}, file.string() + ": cannot be read"};
  if (bytes.empty()) return {{}, file.string() + ": empty file"};
  if ((flags & cv::IMREAD_COLOR) != 0 && begins_with(bytes, "\xFF\xD8"))
    return decode_jpeg(bytes, file.string());
  if (is_torn_png(bytes)) return {{}, file.string() + ": torn picture (cut short or damaged)"};
  try {
    cv::Mat picture = cv::imdecode(bytes, flags);
    if (!picture.empty()) return {picture, {}};
  } catch (const cv::Exception&) {  // sizes beyond reason in a torn header
  }
  return {{}, file.string() + ": torn picture, or of no known format"};
}

bool has_size(const cv::Mat& picture, const Intrinsics& expected) {
  return picture.cols == expected.width_px && picture.rows == expected.height_px;
}

std::string wrong_size(const fs::path& file, const cv::Mat& picture, const Intrinsics& expected) {
  return file.string() + ": " + size_text(picture.cols, picture.rows) +
         " pixels, but the camera has " + size_text(expected.width_px, expected.height_px);
}

}  // namespace

Decoded decode_colour(const fs::path& file, const Intrinsics& expected) {
  Decoded decoded = decode(file, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  if (decoded.fault.empty() && !has_size(decoded.picture, expected))
    return {{}, wrong_size(file, decoded.picture, expected)};
  return decoded;
}

Decoded decode_depth(const fs::path& file, const Intrinsics& expected, double depth_per_metre) {
  Decoded decoded = decode(file, cv::IMREAD_UNCHANGED);
  if (!decoded.fault.empty()) return decoded;
  if (decoded.picture.type() != CV_16UC1)
    return {{}, file.string() + ": expected depth as a 16-bit picture of one channel"};
  if (!has_size(decoded.picture, expected))
    return {{}, wrong_size(file, decoded.picture, expected)};
  if (cv::countNonZero(decoded.picture) == 0)
    return {{}, file.string() + ": depth without a single reading"};
  cv::Mat depth_m;
  decoded.picture.convertTo(depth_m, CV_32F, 1 / depth_per_metre);
  return {depth_m, {}};
}

}  // namespace hyperex::capture
