// SPDX-License-Identifier: GPL-3.0-or-later
// STL, ascii and binary. It stores the corners of each triangle separately; equal corners are
// joined.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <unordered_map>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/io/number.hpp"
#include "hyperex/io/raw_mesh.hpp"

namespace hyperex::io {
namespace {
static_assert(std::endian::native == std::endian::little);

constexpr std::size_t header_bytes = 84, facet_bytes = 50;

using Corner = std::array<double, 3>;
struct CornerHash {
  std::size_t operator()(const Corner& corner) const {
    std::size_t hash = 0;
    for (const double x : corner)
      hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15ull + (hash >> 29);
    return hash;
  }
};

/// Assigns a vertex to each distinct corner, in the order of first appearance.
class Joiner {
 public:
  explicit Joiner(const std::filesystem::path& file) : file_(file) {}

  void add(Corner corner) {
    for (double& x : corner) {
      if (!std::isfinite(x))
        throw InputError(file_, fmt::format("facet {} (counted from 0) has a corner ({}, {}, {}); "
                                            "expected three finite numbers",
                                            corners_ / 3, corner[0], corner[1], corner[2]));
      x += 0.0;  // -0 and 0 denote the same place
    }
    const auto [place, is_new] = index_.try_emplace(corner, std::int64_t(vertices_.size()));
    if (is_new) vertices_.push_back(corner);
    raw_.corner.push_back(place->second);
    if (++corners_ % 3 == 0) raw_.end_face();
  }

  RawMesh finish() {
    raw_.points.resize(static_cast<Eigen::Index>(vertices_.size()), 3);
    for (std::size_t i = 0; i < vertices_.size(); ++i)
      raw_.points.row(i) << vertices_[i][0], vertices_[i][1], vertices_[i][2];
    return std::move(raw_);
  }

 private:
  const std::filesystem::path& file_;
  RawMesh raw_;
  std::vector<Corner> vertices_;
  std::unordered_map<Corner, std::int64_t, CornerHash> index_;
  std::size_t corners_ = 0;
};

RawMesh read_binary(const std::filesystem::path& file, const std::string& bytes,
                    std::uint32_t count) {
  Joiner joiner(file);
  for (std::uint32_t f = 0; f < count; ++f) {
    const char* facet = bytes.data() + header_bytes + facet_bytes * f;
    std::array<float, 12> numbers;  // the normal, then three corners
    std::memcpy(numbers.data(), facet, sizeof numbers);
    for (int k = 3; k < 12; k += 3) joiner.add({numbers[k], numbers[k + 1], numbers[k + 2]});
  }
  return joiner.finish();
}

RawMesh read_ascii(const std::filesystem::path& file, const std::string& bytes) {
  Joiner joiner(file);
  Lines lines(bytes);
  std::string_view line;
  int corners = -1;  // corners of the current facet; -1 outside a facet
  bool ended = false;
  const auto fail = [&](std::string_view found, const char* expected) {
    throw InputError({file, lines.number(), "", quotable(found), expected});
  };
  while (lines.next(line)) {
    const auto word = words(line);
    if (word.empty()) continue;
    if (word[0] == "vertex") {
      Corner corner{};
      if (corners < 0) fail(line, "a vertex inside a facet only");
      if (word.size() != 4) fail(line, "\"vertex\" and three numbers");
      for (int k = 0; k < 3; ++k) {
        const auto x = parse_number(word[k + 1]);
        if (!x) fail(word[k + 1], "a number");
        corner[k] = *x;
      }
      joiner.add(corner);
      ++corners;
    } else if (word[0] == "facet") {
      if (corners >= 0) fail(line, "the end of the facet before");
      corners = 0;
    } else if (word[0] == "endfacet") {
      if (corners != 3) fail(line, "three vertices in a facet");
      corners = -1;
    } else if (word[0] == "endsolid") {
      ended = true;
    } else if (word[0] == "solid") {
      ended = false;
    } else if (word[0] != "outer" && word[0] != "endloop") {
      fail(line, "a line of an STL file");
    }
  }
  if (!ended || corners >= 0)
    throw InputError(file,
                     fmt::format("is torn: ends at line {} without \"endsolid\"", lines.number()));
  return joiner.finish();
}

}  // namespace

RawMesh read_stl(const std::filesystem::path& file) {
  const std::string bytes = read_file(file);
  std::uint32_t count = 0;
  if (bytes.size() >= header_bytes) std::memcpy(&count, bytes.data() + 80, 4);
  const std::uint64_t needed = header_bytes + std::uint64_t(facet_bytes) * count;
  // Some programs begin binary files with "solid" too, so the file size is checked first.
  if (bytes.size() >= header_bytes && bytes.size() == needed)
    return read_binary(file, bytes, count);
  const bool text = bytes.find('\0') == std::string::npos;
  if (text && bytes.starts_with("solid")) return read_ascii(file, bytes);
  if (bytes.size() < header_bytes)
    throw InputError(file, fmt::format("is no STL file: {} bytes, not beginning with \"solid\"; "
                                       "expected at least {}",
                                       bytes.size(), header_bytes));
  if (bytes.size() < needed)
    throw InputError(file, fmt::format("is torn, or no STL file: its header says {} facets, which "
                                       "need {} bytes; the file has {}",
                                       count, needed, bytes.size()));
  return read_binary(file, bytes, count);
}

}  // namespace hyperex::io
