// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Arrays of a .vtu file, unpacked as VTK does: by declared offset and block table.
#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <regex>
#include <string>
#include <vector>

namespace hyperex::test {

/// The values of the array of this name in the bytes of a file; empty where there is none. The name
/// is written as in XML and in a regular expression.
template <class T>
std::vector<T> unpacked(const std::string& file, const std::string& name) {
  std::smatch match;
  const std::string marker = "<AppendedData encoding=\"raw\">\n_";
  const std::string head = file.substr(0, file.find(marker));
  const std::regex line("Name=\"" + name + "\"[^>]*offset=\"([0-9]+)\"");
  if (!std::regex_search(head, match, line)) return {};
  const std::size_t at = head.size() + marker.size() + std::stoul(match[1]);
  const auto word = [&](std::size_t k) {
    std::uint64_t value;
    std::memcpy(&value, file.data() + at + 8 * k, 8);
    return value;
  };
  const std::uint64_t blocks = word(0);
  std::size_t from = at + 8 * (3 + blocks);
  std::string bytes;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    uLongf length = b + 1 == blocks && word(2) ? word(2) : word(1);
    std::string block(length, '\0');
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(block.data()), &length,
                         reinterpret_cast<const Bytef*>(file.data()) + from, word(3 + b)),
              Z_OK);
    EXPECT_EQ(length, block.size());
    bytes += block;
    from += word(3 + b);
  }
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

}  // namespace hyperex::test
