// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <string>
#include <thread>

namespace hyperex::test {

/// Runs `work` with a terminal as standard error, which programs that it starts inherit. Returns
/// what the terminal was told.
template <class Work>
std::string on_terminal(Work work) {
  int ours = -1, theirs = -1;
  EXPECT_EQ(::openpty(&ours, &theirs, nullptr, nullptr, nullptr), 0);
  std::string text;
  // A terminal that nobody reads is full after 4 kB.
  std::thread reader([&] {
    char part[4096];
    for (ssize_t n; (n = ::read(ours, part, sizeof part)) > 0;) text.append(part, std::size_t(n));
  });
  const int before = ::dup(2);
  ::dup2(theirs, 2);
  work();
  ::dup2(before, 2);
  ::close(before);
  ::close(theirs);  // the last one: reading ends
  reader.join();
  ::close(ours);
  return text;
}

}  // namespace hyperex::test
