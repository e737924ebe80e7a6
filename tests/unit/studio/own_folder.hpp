// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include "support/test_file.hpp"

namespace hyperex::studio::test {

/// An empty folder while it lives.
class OwnFolder {
 public:
  OwnFolder() : path_(test_file("folder")) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directory(path_);
  }
  ~OwnFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  OwnFolder(const OwnFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace hyperex::studio::test
