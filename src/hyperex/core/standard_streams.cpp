// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/standard_streams.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>

namespace hyperex {

void open_standard_streams() {
  // The least free number is given each time.
  for (int file = 0; file >= 0 && file <= STDERR_FILENO;) {
    file = ::open("/dev/null", O_RDWR);
    if (file > STDERR_FILENO) ::close(file);
  }
}

Printed flush_standard_output() {
  // An earlier failure has left its mark on the stream, but no reason.
  const bool failed_before = !std::cout || std::ferror(stdout) != 0;
  std::cout.clear();
  std::clearerr(stdout);
  errno = 0;
  std::cout.flush();
  std::fflush(stdout);
  int error = errno;
  const bool failed = failed_before || !std::cout || std::ferror(stdout) != 0;
  if (!failed) return {};
  // Nothing is left to send: whether the reader has closed the pipe is then found by poll().
  pollfd output{STDOUT_FILENO, POLLOUT, 0};
  if (error == 0 && ::poll(&output, 1, 0) > 0 && (output.revents & POLLERR)) error = EPIPE;
  return {false, error == EPIPE, error != 0 ? std::strerror(error) : "part of it was lost"};
}

}  // namespace hyperex
