// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <thread>

#include "commands.hpp"
#include "hyperex/core/interrupt.hpp"
#include "hyperex/core/printable.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/scene/override.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/study/run_cases.hpp"
#include "hyperex/study/scheduler_scripts.hpp"
#include "hyperex/study/study_folder.hpp"
#include "hyperex/study/study_table.hpp"

namespace hyperex::cli {
namespace {
namespace fs = std::filesystem;
using study::State;

struct SweepOptions {
  fs::path study, out;
  std::string one;
  int jobs = 0;  ///< 0: default_jobs()
  bool list = false, collect = false, slurm = false, snakemake = false;
};

/// Prints a line. On a terminal it first erases the progress bar that may be there.
void say(const std::string& line) {
  std::fputs(fmt::format("{}{}\n", ::isatty(2) ? "\r\x1b[K" : "", printable(line)).c_str(), stderr);
}

std::string cases_words(std::size_t count) {
  return fmt::format("{} case{}", count, count == 1 ? "" : "s");
}

study::Study read(const SweepOptions& options) {
  study::Study study = study::read_study(options.study);
  if (!options.out.empty()) study.out = options.out;
  return study;
}

std::vector<study::PlannedCase> plan(const study::Study& study) {
  Progress progress("reading the cases", long(study.cases.size()));
  return study::plan_cases(study, [&](std::size_t done) { progress.update(long(done)); });
}

void check(const study::Study& study, const std::vector<std::size_t>& cases) {
  Progress progress("checking the inputs", long(cases.size()));
  study::check_inputs(study, cases, [&](std::size_t done) { progress.update(long(done)); });
}

/// Index of the case given by --case: a number counted from 1, a name, or a folder name.
std::size_t index_of(const study::Study& study, const std::vector<study::PlannedCase>& planned,
                     const std::string& one) {
  const bool number = one.find_first_not_of("0123456789") == std::string::npos;
  for (std::size_t i = 0; i < study.cases.size(); ++i)
    if (number ? std::to_string(i + 1) == one
               : study.cases[i].name == one || planned[i].files.folder.filename() == one)
      return i;
  throw InputError({"--case", 0, "", '"' + one + '"',
                    fmt::format("a number from 1 to {} or a name of a case, as --list shows them",
                                study.cases.size())});
}

/// The cases that are not finished yet, among all or only the one named by `one`.
std::vector<std::size_t> to_run(const study::Study& study,
                                const std::vector<study::PlannedCase>& planned,
                                const std::string& one) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < planned.size(); ++i) all.push_back(i);
  if (!one.empty()) all = {index_of(study, planned, one)};
  std::erase_if(
      all, [&](std::size_t i) { return study::state_of(planned[i].files) == State::finished; });
  return all;
}

void print_list(const study::Study& study, const std::vector<study::PlannedCase>& planned) {
  for (std::size_t i = 0; i < planned.size(); ++i)
    std::cout << fmt::format("{:>5}  {:<8}  {}  {}\n", i + 1,
                             to_string(study::state_of(planned[i].files)),
                             planned[i].hash.substr(0, 10), printable(study.cases[i].name));
}

study::Called called(const SweepOptions& options, const study::Study& study) {
  const auto whole = [](const fs::path& path) { return fs::absolute(path).lexically_normal(); };
  return {fs::read_symlink("/proc/self/exe"), whole(options.study), whole(study.out)};
}

/// Waits for cases that other processes are running. Returns one line for each that did not finish.
std::vector<std::string> wait_for_others(const study::Study& study,
                                         const std::vector<study::PlannedCase>& planned,
                                         const std::vector<std::size_t>& cases,
                                         const StopOnRequest& stop) {
  std::vector<std::string> unfinished;
  for (const std::size_t i : cases) {
    State state = study::state_of(planned[i].files);
    for (; state == State::running && !stop.requested(); state = study::state_of(planned[i].files))
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
    const std::string& name = study.cases[i].name;
    if (state == State::finished)
      say("finished  " + name + ", by another process");
    else
      unfinished.push_back(name + " was begun by another process and did not finish");
  }
  return unfinished;
}

/// Runs the cases and prints one line for each. Returns one line for each that failed.
std::vector<std::string> run_all(const study::Study& study,
                                 const std::vector<study::PlannedCase>& planned,
                                 const std::vector<std::size_t>& cases, int jobs,
                                 const StopOnRequest& stop) {
  std::vector<std::string> wrong;
  std::vector<std::size_t> elsewhere;
  std::size_t done = 0;
  Progress progress("running the cases", long(cases.size()));
  study::RunOptions run;
  run.program = fs::read_symlink("/proc/self/exe");
  run.jobs = jobs > 0 ? jobs : std::min(study::default_jobs(), int(cases.size()));
  run.stop = [&] { return stop.requested(); };
  run.waiting = [&](std::size_t count) { progress.update(long(count)); };
  run.ended = [&](std::size_t i, const study::Outcome& outcome) {
    const std::string& name = study.cases[i].name;
    ++done;
    if (outcome.state == State::finished) {
      say(fmt::format("finished  {} ({} of {}, {:.1f} s)", name, done, cases.size(),
                      outcome.seconds));
    } else if (outcome.state == State::failed) {
      wrong.push_back(
          fmt::format("{} failed: {} ({})", name, outcome.message, planned[i].files.log.string()));
      say("failed    " + name + ": " + outcome.message);
    } else if (outcome.state == State::running) {
      elsewhere.push_back(i);
      say("running   " + name + ", by another process");
    }
  };
  study::run_cases(study, planned, cases, run);
  const std::vector<std::string> unfinished = wait_for_others(study, planned, elsewhere, stop);
  wrong.insert(wrong.end(), unfinished.begin(), unfinished.end());
  return wrong;
}

[[noreturn]] void end_interrupted(int signal, const std::vector<State>& states) {
  say(fmt::format("{} of {} finished; the same command goes on with the others",
                  std::count(states.begin(), states.end(), State::finished),
                  cases_words(states.size())));
  std::raise(signal);
  while (true) wait_if_interrupted();
}

void print_end(const study::Study& study, const std::vector<State>& states, std::size_t before) {
  const auto count = [&](State state) { return std::count(states.begin(), states.end(), state); };
  std::cout << fmt::format("{}: {} finished, {} failed, {} not run", cases_words(states.size()),
                           count(State::finished), count(State::failed),
                           count(State::not_run) + count(State::running));
  if (before > 0) std::cout << fmt::format("; {} had been finished before", before);
  std::cout << fmt::format(
      "\nwritten to {}:\n  {:<12} one row per case: changed keys, measures\n"
      "  {:<12} one folder per case, as hyperex run writes it\n"
      "  {:<12} the command and the messages of each case\n",
      printable(study.out.string()), "study.csv", "cases/", "logs/");
}

/// In every case, the driven points follow the recording whatever the tissue is. Their curves are
/// then equal in all cases, which might be mistaken for a result.
void warn_of_own_forces(const study::Study& study) {
  const study::Case& first = study.cases.front();
  const bool tissue = std::any_of(first.cells.begin(), first.cells.end(), [](const auto& cell) {
    return cell.first.rfind("tissue", 0) == 0 || cell.first.rfind("support.", 0) == 0;
  });
  if (tissue && scene::read_scene_with(study.scene, first.overrides).variants.empty())
    spdlog::warn(
        "each case is a run of its own, in which the driven points follow the recording whatever "
        "the tissue; to see what the same forces do in other tissue, give the scene variants "
        "(docs/studies.md)");
}

void run(const SweepOptions& options, const study::Study& study,
         const std::vector<study::PlannedCase>& planned) {
  study::check_study_folder(study.out);
  const std::vector<std::size_t> cases = to_run(study, planned, options.one);
  const std::size_t before = (options.one.empty() ? planned.size() : 1) - cases.size();
  check(study, cases);
  if (options.one.empty()) warn_of_own_forces(study);
  study::make_study_folder(study.out);
  const bool all = options.one.empty();
  std::vector<State> states;
  if (all) states = study::write_table(study, planned);
  std::vector<std::string> wrong;
  int signal = 0;
  if (!cases.empty()) {
    const StopOnRequest stop;
    wrong = run_all(study, planned, cases, options.jobs, stop);
    if (stop.requested()) signal = stop.signal();
    if (all) states = study::write_table(study, planned);
  }
  if (signal != 0) {
    if (!all) states = {study::state_of(planned[index_of(study, planned, options.one)].files)};
    end_interrupted(signal, states);
  }
  if (all)
    print_end(study, states, before);
  else if (before > 0)
    say("finished before: " + planned[index_of(study, planned, options.one)].files.folder.string());
  if (wrong.empty()) return;
  std::string text =
      fmt::format("{} did not finish; the same command runs them again", cases_words(wrong.size()));
  for (const std::string& line : wrong) text += "\n" + line;
  throw std::runtime_error(text);
}

void sweep(const SweepOptions& options) {
  const study::Study study = read(options);
  const std::vector<study::PlannedCase> planned = plan(study);
  if (options.list) {
    print_list(study, planned);
  } else if (options.slurm) {
    std::cout << study::slurm_script(called(options, study), planned.size());
  } else if (options.snakemake) {
    std::cout << study::snakefile(called(options, study), planned);
  } else if (options.collect) {
    study::make_study_folder(study.out);
    print_end(study, study::write_table(study, planned), 0);
  } else {
    run(options, study, planned);
  }
}

}  // namespace

void add_sweep(CLI::App& program) {
  auto options = std::make_shared<SweepOptions>();
  CLI::App* command = program.add_subcommand("sweep",
                                             "Run a parameter study: one scene with many values of "
                                             "its keys, and one table of the results");
  command->add_option("STUDY", options->study, "Study file (docs/studies.md)")->required();
  command->add_option(
      "--out", options->out,
      "Folder of the study: new, empty, or from an earlier sweep (default: as the study states)");
  command
      ->add_option("--jobs", options->jobs,
                   "Cases at a time (default: as many as processors and memory allow)")
      ->check(CLI::Range(1, 1024));
  std::vector<CLI::Option*> ways = {
      command->add_flag("--list", options->list, "Print number, state, hash and name of each case"),
      command->add_option("--case", options->one,
                          "Run only this case, given by number or name, and make no table"),
      command->add_flag("--collect", options->collect,
                        "Run nothing; make the table of the finished cases"),
      command->add_flag("--slurm", options->slurm, "Print a script that runs the study with Slurm"),
      command->add_flag("--snakemake", options->snakemake,
                        "Print a Snakefile that runs the study with Snakemake")};
  for (CLI::Option* a : ways)
    for (CLI::Option* b : ways)
      if (a != b) a->excludes(b);
  command->footer("Example: hyperex sweep examples/study.toml --jobs 2");
  command->callback([options] { sweep(*options); });
}

}  // namespace hyperex::cli
