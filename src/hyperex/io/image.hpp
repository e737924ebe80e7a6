// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "hyperex/io/scan.hpp"

namespace hyperex::io {

/// PNG or JPEG by their first bytes; nothing for any other kind of picture.
std::optional<Image> recognise_image(std::vector<std::uint8_t> bytes);

/// The texture beside a scan. A scan is of use without it, so a file that is missing or of
/// another kind is a warning in the log, not an error.
std::optional<Image> load_texture(const std::filesystem::path& scan,
                                  const std::filesystem::path& texture);

}  // namespace hyperex::io
