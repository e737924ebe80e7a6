// SPDX-License-Identifier: GPL-3.0-or-later
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "commands.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/interrupt.hpp"
#include "hyperex/core/printable.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/core/remarks.hpp"
#include "hyperex/core/standard_streams.hpp"
#include "hyperex/motion/option_error.hpp"
#include "hyperex/scene/keys.hpp"
#include "unexpected.hpp"

namespace {

// Prints one line per problem, each beginning with the program's name.
void print_error(const std::string& message) {
  hyperex::wait_if_interrupted();
  const std::string text = hyperex::first_lines(hyperex::printable(message));
  size_t begin = 0;
  while (begin <= text.size()) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    std::cerr << "hyperex: " << text.substr(begin, end - begin) << '\n';
    begin = end + 1;
  }
}

/// Flag "%*": the message made printable, so that it is safe for a terminal.
class PrintableMessage : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&,
              spdlog::memory_buf_t& to) override {
    const std::string text =
        hyperex::first_lines(hyperex::printable({message.payload.data(), message.payload.size()}));
    to.append(text.data(), text.data() + text.size());
  }
  std::unique_ptr<custom_flag_formatter> clone() const override {
    return std::make_unique<PrintableMessage>();
  }
};

void log_to_standard_error() {
  spdlog::set_default_logger(spdlog::stderr_color_mt("hyperex"));
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<PrintableMessage>('*').set_pattern("%^%l%$: %*");
  spdlog::set_formatter(std::move(formatter));
  hyperex::listen_to_remarks([](hyperex::Remark kind, const std::string& sentence) {
    spdlog::log(kind == hyperex::Remark::warning ? spdlog::level::warn : spdlog::level::info, "{}",
                sentence);
  });
}

void add_subcommands(CLI::App& program) {
  hyperex::cli::add_new(program);
  hyperex::cli::add_sample(program);
  hyperex::cli::add_run(program);
  hyperex::cli::add_check(program);
  hyperex::cli::add_studio(program);
  hyperex::cli::add_sweep(program);
  hyperex::cli::add_landmarks(program);
  hyperex::cli::add_mesh(program);
  hyperex::cli::add_ct(program);
  hyperex::cli::add_compare(program);
  hyperex::cli::add_symmetry(program);
  hyperex::cli::add_visits(program);
  hyperex::cli::add_estimate(program);
  hyperex::cli::add_track(program);
  hyperex::cli::add_rig(program);
  hyperex::cli::add_presets(program);
  hyperex::cli::add_scene_reference(program);
  hyperex::cli::add_notes_reference(program);
}

// "/root/m.csv: Permission denied"
std::string words_of(const std::filesystem::filesystem_error& error) {
  const std::string path = error.path1().string();
  return (path.empty() ? "" : path + ": ") + error.code().message();
}

// For a misspelt command, CLI11 reports only that a command is required. This names the unknown
// one.
void refuse_unknown_command(const CLI::App& program, int argc, char** argv) {
  if (argc >= 2 && argv[1][0] == '-') return;
  std::vector<std::string> names;
  std::string list;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
    if (argc >= 2 && command->check_name(argv[1])) return;
    if (command->get_group().empty()) continue;
    names.push_back(command->get_name());
    list += (list.empty() ? "" : ", ") + command->get_name();
  }
  if (argc < 2)
    throw hyperex::InputError(
        "expected a subcommand (" + list +
        "); to see a face move: hyperex studio; with a scan and a recording of your own: hyperex "
        "new SCAN MOTION; all subcommands with an example: hyperex --help");
  const std::string near = hyperex::scene::nearest(argv[1], names);
  throw hyperex::InputError(
      {{},
       0,
       "",
       hyperex::scene::show(argv[1]),
       "a subcommand (" + list + ")" + (near.empty() ? "" : "; did you mean " + near + "?")});
}

// The stages of a run allocate and free the same large arrays repeatedly. By default, glibc returns
// each array to the system and requests it again, page by page. That took a tenth of a run's time.
void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  mallopt(M_TOP_PAD, 32 << 20);
#endif
}

// The exit status of the command: 0, 2 for wrong input, 1 for a failed computation.
int status_of(CLI::App& program, int argc, char** argv) {
  try {
    refuse_unknown_command(program, argc, argv);
    program.parse(argc, argv);
    return 0;
  } catch (const CLI::Success& done) {  // --help, --version
    return program.exit(done);
  } catch (const CLI::ExtrasError&) {  // its own words have the arguments in reverse order
    print_error(hyperex::cli::unexpected(program));
    return 2;
  } catch (const CLI::ParseError& error) {
    print_error(error.what());
    return 2;
  } catch (const hyperex::motion::OptionError& error) {
    print_error(error.sentence("motion." + error.option() + " of a scene"));
    return 2;
  } catch (const hyperex::InputError& error) {
    print_error(error.what());
    return 2;
  } catch (const std::filesystem::filesystem_error& error) {
    print_error(words_of(error));
    return 2;
  } catch (const std::bad_alloc&) {
    print_error("there is not enough memory for this");
    return 1;
  } catch (const std::system_error& error) {
    const bool thread = error.code() == std::errc::resource_unavailable_try_again;
    print_error(thread ? "there is not enough memory for this: no thread could be started"
                       : error.what());
    return 1;
  } catch (const std::exception& error) {
    print_error(error.what());
    return 1;
  }
}

/// By `ulimit -v`.
bool addresses_are_limited() {
  rlimit space{};
  return getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY;
}

}  // namespace

int main(int argc, char** argv) {
  hyperex::end_cleanly_without_memory();
  keep_freed_memory();
  hyperex::open_standard_streams();
  // With SIGXFSZ ignored, exceeding a file size limit becomes a failed write with a message instead
  // of the end of the program. With SIGPIPE ignored, the same holds for a pipe whose reader has
  // closed it.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  hyperex::end_cleanly_when_interrupted();
  // Standard output is for results only; log messages go to standard error.
  log_to_standard_error();
  hyperex::Progress::silence(false);
  // If spdlog fails to write a message, this is not reported to the user.
  spdlog::set_error_handler([](const std::string&) {});
  CLI::App program{
      "Recorded expressions, re-enacted on scanned faces through simulated soft tissue.",
      "hyperex"};
  program.set_version_flag("--version", hyperex::cli::version_text,
                           "The release, its commit and its libraries");
  program.require_subcommand(1);
  program.footer("Run hyperex SUBCOMMAND --help for its options and an example.");
  add_subcommands(program);
  const int status = status_of(program, argc, argv);
  const hyperex::Printed printed = hyperex::flush_standard_output();
  // After memory has run out, some libraries may wait for their threads for ever at exit. OpenBLAS
  // also does so where a limit on addresses leaves too few for its buffer.
  if (status == 1 || (status != 0 && addresses_are_limited())) std::_Exit(status);
  if (status != 0 || printed.whole) return status;
  if (!printed.reader_left)
    print_error("standard output: the results could not be printed (" + printed.why + ")");
  return 1;
}
