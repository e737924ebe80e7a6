// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "hyperex/io/scan.hpp"

namespace hyperex::io {

/// Recognises PNG or JPEG by the first bytes; nothing for any other kind of image.
std::optional<Image> recognise_image(std::vector<std::uint8_t> bytes);

/// The texture file of a scan. A scan can be used without it, so a missing or unsupported file
/// gives a warning in the log, not an error.
std::optional<Image> load_texture(const std::filesystem::path& scan,
                                  const std::filesystem::path& texture);

}  // namespace hyperex::io
