// SPDX-License-Identifier: GPL-3.0-or-later
#include "upload_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

namespace hyperex::studio {

bool is_upload_name(std::string_view name) {
  if (name.empty() || name.size() > 100 || name.front() == '.' || name.front() == ' ') return false;
  try {
    static_cast<void>(nlohmann::json(std::string(name)).dump());
  } catch (const nlohmann::json::exception&) {
    return false;  // not UTF-8
  }
  for (std::size_t i = 1; i < name.size(); ++i)  // C1 controls
    if (name[i - 1] == '\xc2' && static_cast<unsigned char>(name[i]) < 0xa0) return false;
  return std::all_of(name.begin(), name.end(), [](char c) {
    const auto u = static_cast<unsigned char>(c);
    return u >= 0x80 || std::isalnum(u) || std::string_view(" -_.()").find(c) != std::string::npos;
  });
}

std::optional<std::string> percent_decoded(std::string_view text) {
  const auto digit = [](char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
  };
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      out += text[i];
      continue;
    }
    if (i + 2 >= text.size() || digit(text[i + 1]) < 0 || digit(text[i + 2]) < 0)
      return std::nullopt;
    out += static_cast<char>(16 * digit(text[i + 1]) + digit(text[i + 2]));
    i += 2;
  }
  return out;
}

std::string unused_name(const std::filesystem::path& folder, const std::string& name) {
  const std::filesystem::path path = name;
  std::string free = name;
  for (int i = 2; std::filesystem::exists(folder / free); ++i)
    free = fmt::format("{}-{}{}", path.stem().string(), i, path.extension().string());
  return free;
}

}  // namespace hyperex::studio
