// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cctype>
#include <filesystem>
#include <string>

namespace hyperex {

/// A to Z as small letters, all else as it is.
inline std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// What a file's name ends in, with the point and in small letters: ".ply".
inline std::string ending_of(const std::filesystem::path& file) {
  return lower_case(file.extension().string());
}

}  // namespace hyperex
