// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/face/ibug.hpp"

#include <algorithm>
#include <charconv>

namespace hyperex::face {
namespace {

constexpr std::string_view prefix = "ibug68_";

}  // namespace

std::string ibug(int k) {
  return std::string(prefix) + std::to_string(k);
}

const std::vector<std::string>& all_ibug() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (int k = 0; k < 68; ++k) list.push_back(ibug(k));
    return list;
  }();
  return names;
}

std::optional<int> ibug_number(std::string_view name) {
  if (!name.starts_with(prefix)) return std::nullopt;
  int k = -1;
  std::from_chars(name.data() + prefix.size(), name.data() + name.size(), k);
  if (k < 0 || k > 67 || name != all_ibug()[std::size_t(k)]) return std::nullopt;
  return k;
}

std::string full_name(const std::string& name) {
  const std::string digits = name.starts_with("p") ? name.substr(1) : name;
  const bool number = !digits.empty() && digits.size() <= 2 &&
                      std::ranges::all_of(digits, [](char c) { return c >= '0' && c <= '9'; });
  return number ? ibug(std::stoi(digits)) : name;
}

}  // namespace hyperex::face
