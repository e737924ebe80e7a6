// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/temporary.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdint>
#include <optional>
#include <vector>

#include "hyperex/core/remarks.hpp"

namespace hyperex {
namespace fs = std::filesystem;
namespace {

/// For the dots, the process, the extension and the ".going" of an interruption.
constexpr std::size_t kReserved = 40;
constexpr std::size_t kHash = 17;  // '~' and 16 digits

std::uint64_t fnv_1a(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const unsigned char c : text) hash = (hash ^ c) * 0x100000001b3;
  return hash;
}

/// The name of `target`, cut where a temporary name around it would be too long.
std::string short_name(const fs::path& target) {
  std::string name = target.filename().string();
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  const long most = ::pathconf(folder.c_str(), _PC_NAME_MAX);
  const std::size_t room = (most > 100 ? std::size_t(most) : 255) - kReserved;
  if (name.size() <= room) return name;
  std::size_t cut = room - kHash;  // not within a UTF-8 character
  while (cut > 0 && (static_cast<unsigned char>(name[cut]) & 0xC0) == 0x80) --cut;
  return name.substr(0, cut) + fmt::format("~{:016x}", fnv_1a(name));
}

std::string temporary_name(const fs::path& target, const std::string& extension) {
  return fmt::format(".{}.{}.{}", short_name(target), static_cast<long>(::getpid()), extension);
}

struct Leftover {
  pid_t process;
  bool aside;  ///< an earlier output on its way out, whole
};

/// What `name` says, where it is a temporary name of `target`.
std::optional<Leftover> parse(const fs::path& target, const std::string& name) {
  const std::string start = "." + short_name(target) + ".";
  if (!name.starts_with(start)) return {};
  const char* const end = name.data() + name.size();
  pid_t process = 0;
  const auto number = std::from_chars(name.data() + start.size(), end, process);
  if (number.ec != std::errc() || process <= 0) return {};
  const std::string_view rest(number.ptr, std::size_t(end - number.ptr));
  const bool aside = rest == ".old" || rest == ".old.going";
  if (!aside && rest != ".tmp" && !rest.starts_with(".tmp.")) return {};
  return Leftover{process, aside};
}

std::string program_of(const std::string& process) {
  std::error_code error;
  std::string name = fs::read_symlink("/proc/" + process + "/exe", error).filename().string();
  const std::string gone = " (deleted)";  // replaced by a newer one while it ran
  if (name.ends_with(gone)) name.resize(name.size() - gone.size());
  return name;
}

/// A process of that number runs this program, or may do.
bool may_be_ours(pid_t process) {
  if (process == ::getpid()) return true;
  if (::kill(process, 0) != 0 && errno == ESRCH) return false;
  const std::string program = program_of(std::to_string(process));
  return program.empty() || program == program_of("self");
}

}  // namespace

fs::path temporary_beside(const fs::path& target, const std::string& extension) {
  return target.parent_path() / temporary_name(target, extension);
}

fs::path temporary_within(const fs::path& folder, const std::string& extension) {
  return folder / temporary_name(folder, extension);
}

bool is_temporary_of(const fs::path& target, const std::string& name) {
  return parse(target, name).has_value();
}

InUse::InUse(const fs::path& path)
    : file_(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC)) {
  if (file_ < 0) return;
  held_ = ::flock(file_, LOCK_EX | LOCK_NB) == 0;
  taken_ = !held_ && errno == EWOULDBLOCK;
}

InUse::InUse(InUse&& other) noexcept
    : file_(other.file_), held_(other.held_), taken_(other.taken_) {
  other.file_ = -1;
}

InUse::~InUse() {
  if (file_ >= 0) ::close(file_);
}

bool InUse::is_at(const fs::path& path) const {
  struct stat marked {
  }, there{};
  if (file_ < 0 || ::fstat(file_, &marked) != 0) return true;  // its state is unknown
  return ::lstat(path.c_str(), &there) == 0 && there.st_dev == marked.st_dev &&
         there.st_ino == marked.st_ino;
}

void remove_leftovers(const fs::path& target, const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> found;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (is_temporary_of(target, at->path().filename().string())) found.push_back(at->path());
  for (const fs::path& path : found) {
    const Leftover left = *parse(target, path.filename().string());
    // The lock decides, also where another machine or container has other process numbers. The
    // number protects files that a living process has made and not yet locked.
    if (may_be_ours(left.process) || !InUse(path).held()) continue;
    if (left.aside && !fs::exists(fs::symlink_status(target, error))) {
      fs::rename(path, target, error);
      if (!error)
        remark(Remark::note,
               fmt::format("{}: an earlier output, given its name again", target.string()));
      continue;
    }
    fs::remove_all(path, error);
    if (!error)
      remark(Remark::note, fmt::format("removed {}, which a killed run had left", path.string()));
  }
}

}  // namespace hyperex
