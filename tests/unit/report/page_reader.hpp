// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hyperex::report::testing {

/// What the script element of that id holds.
inline std::string element(const std::string& page, const std::string& id) {
  const auto tag = page.find("<script id=\"" + id + "\"");
  const auto begin = page.find('>', tag) + 1;
  return page.substr(begin, page.find("</script>", begin) - begin);
}

inline std::vector<std::uint8_t> from_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  unsigned bits = 0, held = 0;
  for (const char c : text) {
    const auto value = digits.find(c);
    if (value == std::string::npos) break;
    bits = bits << 6 | static_cast<unsigned>(value);
    if ((held += 6) >= 8) bytes.push_back(static_cast<std::uint8_t>(bits >> (held -= 8)));
  }
  return bytes;
}

template <typename T>
std::vector<T> stretch(const std::vector<std::uint8_t>& bytes, const nlohmann::json& at) {
  std::vector<T> out(at.at("count").get<std::size_t>());
  EXPECT_LE(at.at("offset").get<std::size_t>() + out.size() * sizeof(T), bytes.size());
  if (!out.empty())  // memcpy takes no null
    std::memcpy(out.data(), bytes.data() + at.at("offset").get<std::size_t>(),
                out.size() * sizeof(T));
  return out;
}

}  // namespace hyperex::report::testing
