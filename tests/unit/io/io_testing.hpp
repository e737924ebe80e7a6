// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Files for tests: a folder of their own, small meshes, and the check of an InputError's line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "hyperex/core/error.hpp"
#include "hyperex/geometry/types.hpp"
#include "support/refusal.hpp"
#include "support/sheet_mesh.hpp"
#include "support/test_file.hpp"

namespace hyperex::io::testing {
namespace fs = std::filesystem;

/// A test with a folder that disappears afterwards.
class FileTest : public ::testing::Test {
 protected:
  fs::path path(const std::string& name) const { return folder_ / name; }
  fs::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }

 private:
  const TestFolder folder_;
};

/// `call` throws an InputError of one line that begins with the file's name and holds `part`.
template <class Call>
void expect_refused(const fs::path& file, const std::string& part, const Call& call) {
  const std::string what = test::refusal(call);
  EXPECT_THAT(what, ::testing::StartsWith(file.string()));
  EXPECT_THAT(what, ::testing::HasSubstr(part));
  EXPECT_EQ(what.find('\n'), std::string::npos) << what;
}

/// A sound file with any one byte changed is refused or read, nothing else.
inline void read_flipped(const std::string& bytes, const std::vector<int>& flips,
                         const std::function<void(const std::string&)>& read) {
  for (std::size_t at = 0; at < bytes.size(); ++at)
    for (const int flip : flips) {
      std::string changed = bytes;
      changed[at] = static_cast<char>(changed[at] ^ flip);
      test::refusal([&] { read(changed); });
    }
}

/// A bulging sheet of n x n squares, 160 x 200 x 30 mm, as a face's size is; metres.
inline TriMesh sheet(int n) {
  TriMesh mesh = test::sheet_mesh({n, n}, {1, 1}).mesh;
  for (auto point : mesh.points.rowwise()) {
    const double x = point.x() - 0.5, y = point.y() - 0.5;
    point << 0.16 * x, 0.20 * y, 0.06 * (0.5 - x * x - y * y);
  }
  return mesh;
}

/// Bytes that begin as a PNG does; the readers look no further.
inline std::string png_bytes() {
  return std::string("\x89PNG\r\n\x1a\n") + "not really a picture";
}

inline fs::path shared_data() {
  return fs::path(HYPEREX_SHARED_DIR) / "data";
}

}  // namespace hyperex::io::testing
