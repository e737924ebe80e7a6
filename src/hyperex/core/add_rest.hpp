// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <fmt/format.h>

#include <string>
#include <vector>

namespace hyperex {

/// Adds "and 3 more" to the names of the first of `all` things, where there are more.
inline void add_rest(std::vector<std::string>& named, std::size_t all) {
  if (all > named.size()) named.push_back(fmt::format("and {} more", all - named.size()));
}

}  // namespace hyperex
