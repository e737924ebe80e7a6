// SPDX-License-Identifier: GPL-3.0-or-later
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <csignal>
#include <exception>
#include <iostream>
#include <string>

#include "commands.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/interrupt.hpp"

namespace {

// One line a problem, each with the program's name.
void print_error(const std::string& text) {
  hyperex::wait_if_interrupted();
  size_t begin = 0;
  while (begin <= text.size()) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    std::cerr << "hyperex: " << text.substr(begin, end - begin) << '\n';
    begin = end + 1;
  }
}

}  // namespace

int main(int argc, char** argv) {
  // A file that may grow no further is then a failed write, told in words, not the end.
  std::signal(SIGXFSZ, SIG_IGN);
  hyperex::end_cleanly_when_interrupted();
  // Standard output is for results alone: what is said on the way goes beside it.
  spdlog::set_default_logger(spdlog::stderr_color_mt("hyperex"));
  spdlog::set_pattern("%^%l%$: %v");
  CLI::App program{
      "Recorded expressions, re-enacted on scanned faces through simulated soft tissue.",
      "hyperex"};
  program.set_version_flag("--version", "hyperex " HYPEREX_VERSION);
  program.require_subcommand(1);
  program.footer("hyperex SUBCOMMAND --help tells more, with an example.");
  hyperex::cli::add_run(program);
  hyperex::cli::add_check(program);
  hyperex::cli::add_landmarks(program);
  hyperex::cli::add_mesh(program);
  hyperex::cli::add_compare(program);
  hyperex::cli::add_symmetry(program);
  hyperex::cli::add_track(program);
  hyperex::cli::add_presets(program);
  hyperex::cli::add_scene_reference(program);
  try {
    program.parse(argc, argv);
    return 0;
  } catch (const CLI::Success& done) {  // --help, --version
    return program.exit(done);
  } catch (const CLI::ParseError& error) {
    print_error(error.what());
    return 2;
  } catch (const hyperex::InputError& error) {
    print_error(error.what());
    return 2;
  } catch (const std::exception& error) {
    print_error(error.what());
    return 1;
  }
}
