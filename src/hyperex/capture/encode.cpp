// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/encode.hpp"

#include <turbojpeg.h>

#include <memory>
#include <stdexcept>

namespace hyperex::capture {

std::vector<std::uint8_t> jpeg_bytes(std::span<const std::uint8_t> rgb, int width_px, int height_px,
                                     int quality) {
  if (width_px < 1 || height_px < 1 ||
      rgb.size() != 3 * std::size_t(width_px) * std::size_t(height_px))
    throw std::invalid_argument("jpeg_bytes: the bytes are not those of a picture of this size");
  const std::unique_ptr<void, int (*)(void*)> encoder(tjInitCompress(), tjDestroy);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  const int failed = tjCompress2(encoder.get(), rgb.data(), width_px, 0, height_px, TJPF_RGB,
                                 &bytes, &size, TJSAMP_420, quality, 0);
  const std::unique_ptr<unsigned char, void (*)(unsigned char*)> held(bytes, tjFree);
  if (failed != 0) throw std::runtime_error("turbojpeg could not compress a picture");
  return {bytes, bytes + size};
}

}  // namespace hyperex::capture
