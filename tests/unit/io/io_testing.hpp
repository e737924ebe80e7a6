// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Files for tests: a folder of their own, small meshes, and the check of an InputError's line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "hyperex/core/error.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex::io::testing {
namespace fs = std::filesystem;

/// A test with a folder that disappears afterwards.
class FileTest : public ::testing::Test {
 protected:
  FileTest()
      : folder_(fs::temp_directory_path() /
                ("hyperex_io_" + std::to_string(::getpid()) + "_" +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder_);
  }
  ~FileTest() override { fs::remove_all(folder_); }

  fs::path path(const std::string& name) const { return folder_ / name; }
  fs::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }

 private:
  fs::path folder_;
};

/// `call` throws an InputError of one line that begins with the file's name and holds `part`.
template <class Call>
void expect_refused(const fs::path& file, const std::string& part, const Call& call) {
  try {
    call();
    ADD_FAILURE() << "accepted; expected an error with \"" << part << "\"";
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_THAT(what, ::testing::StartsWith(file.string()));
    EXPECT_THAT(what, ::testing::HasSubstr(part));
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
  }
}

/// A bulging sheet of n x n squares, 160 x 200 x 30 mm, as a face's size is; metres.
inline TriMesh sheet(int n) {
  TriMesh mesh;
  mesh.points.resize((n + 1) * (n + 1), 3);
  mesh.triangles.resize(2 * n * n, 3);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = double(i) / n - 0.5, y = double(j) / n - 0.5;
      mesh.points.row(j * (n + 1) + i) << 0.16 * x, 0.20 * y, 0.06 * (0.5 - x * x - y * y);
    }
  int t = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.triangles.row(t++) << a, b, d;
      mesh.triangles.row(t++) << a, d, c;
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

inline std::string file_bytes(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace hyperex::io::testing
