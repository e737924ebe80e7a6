// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hyperex::study {

struct Command {
  std::vector<std::string> words;    ///< the program, then its arguments
  std::filesystem::path folder;      ///< the working directory
  std::vector<int> processors = {};  ///< the processors that it may use; empty: all
};

/// `word` quoted such that a shell reads it as one word.
std::string quoted_for_shell(const std::string& word);

/// The command as one would type it in a shell: "cd FOLDER && PROGRAM ...".
std::string shell_line(const Command& command);

/// The processors that this process may use.
std::vector<int> own_processors();

/// A program in a process of its own. Both its output streams go to a log, which is locked as long
/// as the program runs. The program is ended (SIGTERM) when this process ends for any reason.
class Child {
 public:
  /// Nothing where another process holds the log. Throws InputError where the log cannot be
  /// written, the file is not a log of a case, or no process can be created. The thread that calls
  /// this must live longer than the child, since the system ends the child with that thread.
  static std::optional<Child> start(const Command& command, const std::filesystem::path& log);
  Child(Child&& other) noexcept;
  Child& operator=(Child&& other) noexcept;
  ~Child();  ///< ends the program and waits for its end

  /// Its exit status as in a shell: 128 + signal where a signal ended it. Nothing while it runs.
  std::optional<int> ended();
  void end();  ///< sends SIGTERM
  /// Appends a line to the log, the last one.
  void say(const std::string& line) const;

 private:
  Child(pid_t process, int log) : process_(process), log_(log) {}
  pid_t process_ = -1;  ///< -1: it has ended
  int log_ = -1, status_ = 0;
};

}  // namespace hyperex::study
