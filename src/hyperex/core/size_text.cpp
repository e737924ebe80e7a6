// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/size_text.hpp"

#include <fmt/format.h>

namespace hyperex {

std::string size_text(double bytes) {
  if (bytes < 1e6) return "less than 1 MB";
  if (bytes < 1e8) return fmt::format("{:.0f} MB", bytes / 1e6);
  return bytes < 1e10 ? fmt::format("{:.2f} GB", bytes / 1e9)
                      : fmt::format("{:.0f} GB", bytes / 1e9);
}

}  // namespace hyperex
