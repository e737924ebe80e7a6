// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/output_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>

#include "hyperex/core/error.hpp"
#include "hyperex/core/lower_case.hpp"

namespace hyperex {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kHead_bytes = 4 << 20;

std::string head_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError(path, "is there and cannot be read; choose another name");
  std::string head(kHead_bytes, '\0');
  stream.read(head.data(), std::streamsize(head.size()));
  head.resize(std::size_t(stream.gcount()));
  return head;
}

bool is_of_kind(const OutputFile& output, const std::string& head) {
  if (output.begins.empty() && output.holds.empty()) return false;
  return head.starts_with(output.begins) &&
         std::ranges::all_of(output.holds, [&](const std::string& text) {
           return head.find(text) != std::string::npos;
         });
}

void check(const OutputFile& output) {
  std::error_code error;
  const fs::file_status there = fs::status(output.path, error);
  if (fs::exists(there) && !fs::is_regular_file(there)) return;
  // /dev/stdout denotes a file that the user's shell has opened.
  if (const std::string path = output.path.string();
      path.starts_with("/dev/") || path.starts_with("/proc/"))
    return;
  const std::string name = lower_case(output.path.filename().string());
  if (std::ranges::none_of(output.extensions,
                           [&](const std::string& end) { return name.ends_with(end); }))
    throw InputError(output.path, fmt::format("expected a name that ends in {}",
                                              fmt::join(output.extensions, " or ")));
  if (!fs::exists(there) || fs::file_size(output.path, error) == 0) return;
  if (!is_of_kind(output, head_of(output.path)))
    throw InputError(output.path,
                     "is there already and is not known to be an earlier output of this kind; "
                     "remove it or choose another name");
}

}  // namespace

OutputFile png_output(const fs::path& path) {
  return {path, {".png"}, "\x89PNG", {std::string("Software\0Hyperex", 16)}};
}

void check_output_kinds(const std::vector<OutputFile>& outputs) {
  for (const OutputFile& output : outputs)
    if (!output.path.empty()) check(output);
}

}  // namespace hyperex
