// SPDX-License-Identifier: GPL-3.0-or-later
#include "session_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
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
  return {};
}

/// A lock between processes.
class Lock {
 public:
  explicit Lock(const fs::path& file)
      : file_(open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600)) {
    if (file_ >= 0) flock(file_, LOCK_EX);
  }
  ~Lock() {
    if (file_ >= 0) close(file_);
  }
  Lock(const Lock&) = delete;

 private:
  int file_;
};

}  // namespace

SessionFolder::SessionFolder() {
  const fs::path folder = state_folder();
  std::error_code error;
  if (!folder.empty()) fs::create_directories(folder, error);
  if (folder.empty() || error) {
    make_among_temporary_files();
    return;
  }
  // Readable by this user only: uploads are faces.
  fs::permissions(folder, fs::perms::owner_all, error);
  const Lock lock(folder / ".lock");  // against studios that start at the same time
  fs::file_time_type youngest = fs::file_time_type::min();
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (!entry.is_directory(error)) continue;
    const InUse abandoned(entry.path());
    if (!abandoned.held()) continue;
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
  if (!error) fs::permissions(path_, fs::perms::owner_all, error);
  if (error)
    throw InputError(path_, "cannot be made (" + error.message() +
                                "): expected a place for the "
                                "studio's files; set XDG_STATE_HOME to another one");
  in_use_ = std::make_unique<InUse>(path_);
}

/// Without a home: readable by this user only, and not offered to a later studio.
void SessionFolder::make_among_temporary_files() {
  std::string name = (fs::temp_directory_path() / "hyperex-studio-XXXXXX").string();
  if (!mkdtemp(name.data()))
    throw InputError(name,
                     "cannot be made: expected a place for the studio's files; set "
                     "XDG_STATE_HOME to another one");
  path_ = name;
  in_use_ = std::make_unique<InUse>(path_);
}

SessionFolder::~SessionFolder() {
  if (left_) return;
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace hyperex::studio
