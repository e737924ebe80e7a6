// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/read_in_child.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <functional>
#include <memory>
#include <new>
#include <stdexcept>
#include <type_traits>

namespace hyperex::ct {
namespace {

constexpr int kGood = 0, kRefused = 1, kNoMemory = 2;

/// What a child wrote contradicts itself: the file that it read has spoilt its memory.
struct Spoilt {};

/// A file in memory alone, which both processes have open.
class SharedFile {
 public:
  SharedFile() : file_(::fdopen(::memfd_create("hyperex_ct", MFD_CLOEXEC), "w+b")) {
    if (!file_) throw std::runtime_error("no file in memory can be made");
  }
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    put(&value, sizeof value);
  }
  template <class T>
  void put(const std::vector<T>& values) {
    put(values.size());
    put(values.data(), sizeof(T) * values.size());
  }
  void flush() {
    if (std::fflush(file_.get()) != 0) throw std::bad_alloc();
  }
  void rewind() { std::rewind(file_.get()); }
  template <class T>
  void get(T& value) {
    get(&value, sizeof value);
  }
  template <class T>
  void get(std::vector<T>& values, std::size_t wanted) {
    std::size_t count = 0;
    get(count);
    if (count != wanted) throw Spoilt();
    values.resize(count);
    get(values.data(), sizeof(T) * count);
  }

 private:
  void put(const void* from, std::size_t bytes) {
    if (std::fwrite(from, 1, bytes, file_.get()) != bytes) throw std::bad_alloc();
  }
  void get(void* to, std::size_t bytes) {
    if (std::fread(to, 1, bytes, file_.get()) != bytes) throw Spoilt();
  }
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
};

void put(SharedFile& to, const DicomPixels& pixels) {
  to.put(pixels.columns), to.put(pixels.rows), to.put(pixels.is_signed);
  to.put(pixels.slope), to.put(pixels.intercept), to.put(pixels.bytes);
}
void get(SharedFile& from, DicomPixels& pixels) {
  from.get(pixels.columns), from.get(pixels.rows), from.get(pixels.is_signed);
  from.get(pixels.slope), from.get(pixels.intercept);
  from.get(pixels.bytes, std::size_t(2) * pixels.columns * pixels.rows);
}
void put(SharedFile& to, const ItkVolume& volume) {
  to.put(volume.grid), to.put(volume.origin_mm), to.put(volume.direction);
  to.put(volume.dimensions), to.put(volume.components), to.put(volume.values);
}
void get(SharedFile& from, ItkVolume& volume) {
  from.get(volume.grid), from.get(volume.origin_mm), from.get(volume.direction);
  from.get(volume.dimensions), from.get(volume.components);
  const auto& size = volume.grid.size;
  from.get(volume.values, std::size_t(size[0]) * size[1] * size[2]);
}

/// The child's part: never returns, and leaves the parent's files, remarks and locks alone.
template <class T>
[[noreturn]] void work_as_child(SharedFile& file, const std::function<std::optional<T>()>& work,
                                pid_t parent, const sigset_t& signals) {
  for (int signal = 1; signal < NSIG; ++signal) std::signal(signal, SIG_DFL);
  ::pthread_sigmask(SIG_SETMASK, &signals, nullptr);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::prctl(PR_SET_DUMPABLE, 0);  // a dump would hold a patient's values
  if (::getppid() != parent) ::_exit(kRefused);
  // Remarks of libraries, which may hold names.
  if (const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC); nowhere >= 0)
    ::dup2(nowhere, STDOUT_FILENO), ::dup2(nowhere, STDERR_FILENO);
  try {
    const std::optional<T> read = work();
    if (!read) ::_exit(kRefused);
    put(file, *read);
    file.flush();
  } catch (const std::bad_alloc&) {
    ::_exit(kNoMemory);
  } catch (const std::exception&) {
    ::_exit(kRefused);
  }
  ::_exit(kGood);
}

template <class T>
std::optional<T> in_child(const std::function<std::optional<T>()>& work) {
  itk_library();  // loaded before the fork, so that the parent reports if it is missing
  SharedFile file;
  sigset_t all, before;
  sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  const pid_t parent = ::getpid(), child = ::fork();
  if (child == 0) work_as_child(file, work, parent, before);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (child < 0) throw std::runtime_error("no process can be made to read the CT");
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw std::runtime_error("the process that reads the CT is lost");
  // The system ends what takes too much memory.
  if ((WIFEXITED(status) && WEXITSTATUS(status) == kNoMemory) ||
      (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL))
    throw std::bad_alloc();
  if (!WIFEXITED(status) || WEXITSTATUS(status) != kGood) return std::nullopt;
  file.rewind();
  try {
    T out;
    get(file, out);
    return out;
  } catch (const Spoilt&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<DicomPixels> pixels_in_child(const std::string& bytes) {
  return in_child<DicomPixels>([&] { return itk_library().pixels_of(bytes); });
}

std::optional<ItkVolume> volume_in_child(const std::string& file, bool nifti) {
  return in_child<ItkVolume>([&] { return itk_library().read_volume(file, nifti); });
}

}  // namespace hyperex::ct
