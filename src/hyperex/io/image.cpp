// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/io/image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "hyperex/core/error.hpp"
#include "hyperex/core/named_file.hpp"
#include "hyperex/core/remarks.hpp"

namespace hyperex::io {
namespace {
constexpr std::array<std::uint8_t, 8> png_start{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr std::array<std::uint8_t, 3> jpeg_start{0xff, 0xd8, 0xff};

template <class Start>
bool starts_with(const std::vector<std::uint8_t>& bytes, const Start& start) {
  return bytes.size() > start.size() && std::equal(start.begin(), start.end(), bytes.begin());
}
}  // namespace

std::optional<Image> recognise_image(std::vector<std::uint8_t> bytes) {
  if (starts_with(bytes, png_start)) return Image{std::move(bytes), "image/png"};
  if (starts_with(bytes, jpeg_start)) return Image{std::move(bytes), "image/jpeg"};
  return std::nullopt;
}

std::optional<Image> load_texture(const std::filesystem::path& scan,
                                  const std::filesystem::path& texture) {
  // Scanner software for Windows writes backslashes.
  std::string name = texture.string();
  std::replace(name.begin(), name.end(), '\\', '/');
  try {
    const std::filesystem::path path = named_file(scan.parent_path(), name);
    const std::string bytes = read_regular_file(path);
    auto image = recognise_image({bytes.begin(), bytes.end()});
    if (!image)
      remark(Remark::warning,
             fmt::format("{}: texture {} is neither PNG nor JPEG; going on without it",
                         scan.string(), path.string()));
    return image;
  } catch (const InputError& error) {
    remark(Remark::warning,
           fmt::format("{}: going on without its texture: {}", scan.string(), error.what()));
    return std::nullopt;
  }
}

}  // namespace hyperex::io
