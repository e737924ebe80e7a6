// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <vector>

#include "hyperex/core/error.hpp"
#include "hyperex/core/interrupt.hpp"
#include "hyperex/core/temporary.hpp"

namespace hyperex {
namespace fs = std::filesystem;

namespace {

[[noreturn]] void cannot_write(const fs::path& path, const std::string& why) {
  throw InputError(path, "cannot be written (" + why + ")");
}

/// The standard stream that `path` leads to, or -1: renaming a file into the place of what a shell
/// has opened would part the two.
int standard_stream(const fs::path& path) {
  struct stat wanted {
  }, open{};
  if (::stat(path.c_str(), &wanted) != 0) return -1;
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    if (::fstat(stream, &open) == 0 && open.st_dev == wanted.st_dev && open.st_ino == wanted.st_ino)
      return stream;
  return -1;
}

/// Whether `path` is a device, a pipe or a standard stream: it accepts bytes but cannot be replaced
/// by another file.
bool is_written_through(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_directory(status) &&
         (!fs::is_regular_file(status) || standard_stream(path) >= 0);
}

void write_through(const fs::path& path, const std::function<void(std::ostream&)>& write) {
  std::ostringstream buffer;                // whole before anything is sent
  buffer.exceptions(std::ostream::badbit);  // a lack of memory is thrown on
  write(buffer);
  const std::string bytes = std::move(buffer).str();
  const int stream = standard_stream(path);
  const int file =
      stream >= 0 ? ::dup(stream) : ::open(path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC);
  if (file < 0) cannot_write(path, std::strerror(errno));
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t some = ::write(file, bytes.data() + sent, bytes.size() - sent);
    if (some < 0 && errno == EINTR) continue;
    if (some <= 0) {
      const std::string why = some < 0 ? std::strerror(errno) : "it takes no more";
      ::close(file);
      cannot_write(path, why);
    }
    sent += std::size_t(some);
  }
  ::close(file);
}

/// A file under another name or by a link is the same file.
bool are_same(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::exists(a, error) && fs::exists(b, error)) return fs::equivalent(a, b, error);
  return fs::weakly_canonical(fs::absolute(a, error), error) ==
         fs::weakly_canonical(fs::absolute(b, error), error);
}

/// Throws where `file`, what `path` leads to, could not be made or replaced.
void check_right(const fs::path& path, const fs::path& file) {
  std::error_code error;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error))
    throw InputError(path, "cannot be written: there is no folder " + folder.string());
  const fs::path there = fs::exists(file, error) ? file : folder;
  if (::access(there.c_str(), W_OK) != 0) cannot_write(path, std::strerror(errno));
}

/// A file that is open for reading. A C++ stream would report a lack of memory as the end of the
/// file.
class OpenFile {
 public:
  explicit OpenFile(const fs::path& path)
      : path_(path), descriptor_(::open(path.c_str(), O_RDONLY | O_NOCTTY | O_CLOEXEC)) {
    if (descriptor_ < 0) fail();
  }
  ~OpenFile() { ::close(descriptor_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  /// Reads at most `count` bytes. Returns 0 at the end.
  std::size_t read(char* to, std::size_t count) const {
    while (true) {
      const ssize_t some = ::read(descriptor_, to, count);
      if (some >= 0) return std::size_t(some);
      if (errno != EINTR) fail();
    }
  }

 private:
  [[noreturn]] void fail() const {
    throw InputError(path_, fmt::format("cannot be read ({})", std::strerror(errno)));
  }

  fs::path path_;
  int descriptor_;
};

/// Reads a pipe up to a limit, because its data may never end.
std::string read_pipe(const fs::path& path, const OpenFile& file) {
  constexpr std::size_t most = std::size_t(1) << 30;
  std::string bytes;
  std::vector<char> part(1 << 16);
  while (const std::size_t count = file.read(part.data(), part.size())) {
    bytes.append(part.data(), count);
    if (bytes.size() > most) throw InputError(path, "gives more than 1 GiB; expected a file");
  }
  return bytes;
}

/// Reads to the end, also where the size is stated wrongly, as by the system's own tables.
std::string read_to_end(const OpenFile& file, std::size_t stated_size) {
  std::string bytes(stated_size + 1, '\0');
  std::size_t size = 0;
  while (const std::size_t count = file.read(bytes.data() + size, bytes.size() - size)) {
    size += count;
    if (size == bytes.size()) bytes.resize(2 * size);
  }
  bytes.resize(size);
  return bytes;
}
}  // namespace

fs::path followed_links(const fs::path& path) {
  constexpr int most = 40;  // as the system has it
  std::error_code error;
  if (fs::is_directory(path, error))
    throw InputError(path, "is a folder; expected the name of a file");
  fs::path file = path;
  for (int links = 0; fs::is_symlink(fs::symlink_status(file, error)); ++links) {
    if (links == most) throw InputError(path, "is a link that leads in a circle");
    file = file.parent_path() / fs::read_symlink(file, error);
    if (error) cannot_write(path, error.message());
  }
  return file;
}

void check_outputs(const std::vector<fs::path>& outputs, const std::vector<fs::path>& inputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const fs::path& path = outputs[i];
    if (path.empty()) continue;
    if (is_written_through(path)) continue;
    const fs::path file = followed_links(path);
    check_right(path, file);
    for (const fs::path& input : inputs)
      if (!input.empty() && are_same(file, input))
        throw InputError(path, "is read too; expected another file to write to");
    for (std::size_t k = 0; k < i; ++k)
      if (!outputs[k].empty() && !is_written_through(outputs[k]) &&
          are_same(file, followed_links(outputs[k])))
        throw InputError(path, "is named for two outputs; expected a file each");
    remove_leftovers(file, file.has_parent_path() ? file.parent_path() : fs::path("."));
  }
}

void write_file_atomically(const fs::path& path, const std::function<void(std::ostream&)>& write) {
  if (is_written_through(path)) return write_through(path, write);
  const fs::path file = followed_links(path);
  std::error_code error, ignored;
  const fs::file_status before = fs::status(file, error);
  if (fs::exists(before) && ::access(file.c_str(), W_OK) != 0)
    cannot_write(path, std::strerror(errno));
  const TemporaryPath listed(temporary_beside(file));
  const fs::path& temporary = listed.path();
  const auto fail = [&](const std::string& why) {
    fs::remove(temporary, ignored);
    cannot_write(path, why);
  };
  {
    errno = 0;
    std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
    if (!stream) fail(std::strerror(errno));
    const InUse in_use(temporary);
    try {
      write(stream);
    } catch (...) {
      stream.close();
      fs::remove(temporary, ignored);
      throw;
    }
    stream.flush();
    if (!stream) fail(errno ? std::strerror(errno) : "the disk may be full");
  }
  if (fs::exists(before)) fs::permissions(temporary, before.permissions(), ignored);
  fs::rename(temporary, file, error);
  if (error) fail(error.message());
}

std::string read_file(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) throw InputError(path, "no such file");
  if (fs::is_directory(path, error)) throw InputError(path, "is a folder; expected a file");
  const bool pipe = fs::is_fifo(path, error);
  if (!pipe && !fs::is_regular_file(path, error))
    throw InputError(path, "is a device; expected a file");
  const OpenFile file(path);
  return pipe ? read_pipe(path, file) : read_to_end(file, fs::file_size(path));
}

}  // namespace hyperex
