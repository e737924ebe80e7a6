// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hyperex::study {

struct Command {
  std::vector<std::string> words;    ///< the program first
  std::filesystem::path folder;      ///< that it works in
  std::vector<int> processors = {};  ///< that it may use; empty: all
};

/// `word` as a shell reads it back.
std::string quoted_for_shell(const std::string& word);

/// As one would type it in a shell: "cd FOLDER && PROGRAM ...".
std::string shell_line(const Command& command);

/// The processors that this process may use.
std::vector<int> own_processors();

/// A program in a process of its own, both its streams written into a log, which is locked as long
/// as the program lives. It is ended (SIGTERM) when this process ends in whatever way.
class Child {
 public:
  /// Nothing where another process holds the log. Throws InputError where the log cannot be
  /// written, is none of these logs, or no process can be made. Call, and keep alive, the thread
  /// that outlives the child.
  static std::optional<Child> start(const Command& command, const std::filesystem::path& log);
  Child(Child&& other) noexcept;
  Child& operator=(Child&& other) noexcept;
  ~Child();  ///< ends it and waits for its end

  /// Its exit status as in the shell: 128 + signal where a signal ended it. Nothing while it runs.
  std::optional<int> ended();
  void end();  ///< sends SIGTERM
  /// One more line in the log, the last one.
  void say(const std::string& line) const;

 private:
  Child(pid_t process, int log) : process_(process), log_(log) {}
  pid_t process_ = -1;  ///< -1: it has ended
  int log_ = -1, status_ = 0;
};

}  // namespace hyperex::study
