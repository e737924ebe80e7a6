// SPDX-License-Identifier: GPL-3.0-or-later
#include "session_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>

#include "hyperex/core/error.hpp"
#include "token.hpp"

namespace hyperex::studio {
namespace fs = std::filesystem;

namespace {

constexpr auto kForgottenAfter = std::chrono::hours(24 * 30);

fs::path state_folder() {
  const auto absolute = [](const char* name) {
    const char* value = std::getenv(name);
    return value && fs::path(value).is_absolute() ? fs::path(value) : fs::path();
  };
  if (const fs::path state = absolute("XDG_STATE_HOME"); !state.empty())
    return state / "hyperex" / "studio";
  if (const fs::path home = absolute("HOME"); !home.empty())
    return home / ".local" / "state" / "hyperex" / "studio";
  return fs::temp_directory_path() / fmt::format("hyperex-studio-{}", getuid());
}

}  // namespace

SessionFolder::SessionFolder() {
  fs::path folder = state_folder();
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    folder = fs::temp_directory_path() / fmt::format("hyperex-studio-{}", getuid());
    fs::create_directories(folder, error);
  }
  // Of this user alone: uploads are faces.
  fs::permissions(folder, fs::perms::owner_all, error);
  fs::file_time_type youngest = fs::file_time_type::min();
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (!entry.is_directory(error) || InUse(entry.path()).taken()) continue;
    const fs::path scene = entry.path() / "scene.toml";
    const bool there = fs::is_regular_file(scene, error);
    const auto written = fs::last_write_time(there ? scene : entry.path(), error);
    if (!there || fs::file_time_type::clock::now() - written > kForgottenAfter) {
      fs::remove_all(entry.path(), error);
    } else if (written > youngest) {
      youngest = written;
      rescued_ = entry.path();
    }
  }
  path_ = folder / new_token().substr(0, 12);
  fs::create_directory(path_, error);
  if (error)
    throw InputError(path_, "cannot be made (" + error.message() +
                                "): expected a folder for what "
                                "the studio keeps; XDG_STATE_HOME names another place");
  in_use_ = std::make_unique<InUse>(path_);
}

SessionFolder::~SessionFolder() {
  if (left_) return;
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace hyperex::studio
