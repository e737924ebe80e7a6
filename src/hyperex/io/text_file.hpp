// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string_view>

namespace hyperex::io {

/// Throws InputError if `bytes`, the contents of `file`, are no text in ASCII or UTF-8: a PDF, a
/// spreadsheet, a picture, an archive or text in UTF-16, known by their first bytes, or another
/// file with a byte 0 among the first 4096. The message says what the file is.
void refuse_other_than_text(const std::filesystem::path& file, std::string_view bytes);

}  // namespace hyperex::io
