// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <iostream>
#include <memory>

#include "commands.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/output_file.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/visits/compare_visits.hpp"
#include "hyperex/visits/summary.hpp"
#include "hyperex/visits/visit_figures.hpp"
#include "hyperex/visits/visits_page.hpp"
#include "hyperex/visits/visits_table.hpp"

namespace hyperex::cli {
namespace {
namespace fs = std::filesystem;

struct VisitsOptions {
  fs::path file, out, table;
};

void check_outputs_of(const VisitsOptions& options, const visits::VisitsFile& file) {
  std::vector<fs::path> inputs{options.file};
  for (const visits::VisitEntry& visit : file.visits) {
    inputs.insert(inputs.end(), visit.recordings.begin(), visit.recordings.end());
    for (const auto& scan : {visit.rest_scan, visit.peak_scan})
      if (scan) inputs.insert(inputs.end(), {scan->file, scan->landmarks});
  }
  check_outputs({options.out, options.table}, inputs);
  check_output_kinds({{options.out, {".html"}, "<!doctype html>", {"<title>Hyperex visits"}},
                      {options.table, {".csv"}, visits::kTableBegins}});
}

std::string cell(const visits::VisitValue& value) {
  const std::string text = visits::figure(value.value);
  return value.measured ? text + " +- " + visits::figure(value.measured->high - value.value) : text;
}

std::string interval(const visits::Change& change) {
  const int digits = visits::digits_of(change);
  return change.all ? fmt::format("{:>8} to {:>6}", visits::signed_figure(change.all->low, digits),
                                  visits::signed_figure(change.all->high, digits))
                    : "not known";
}

/// The first and the last visit beside each other.
void print_table(const visits::Comparison& comparison) {
  const auto& entries = comparison.file.visits;
  const bool several = entries.size() > 1;
  std::cout << fmt::format("{:<56} {:>16}", "", entries.front().label);
  if (several)
    std::cout << fmt::format(" {:>16} {:>10} {:>18}  {}", entries.back().label, "change", "95 %",
                             "beyond");
  std::cout << '\n';
  for (const visits::MeasureOverVisits& one : comparison.measures) {
    const std::string name =
        fmt::format("{}{}{} ({})", one.measure.words, one.measure.side.empty() ? "" : ", ",
                    one.measure.side, one.measure.unit);
    const auto text = [](const auto& value) { return value ? cell(*value) : std::string("-"); };
    std::cout << fmt::format("{:<56} {:>16}", name, text(one.values.front()));
    if (several) std::cout << fmt::format(" {:>16}", text(one.values.back()));
    if (const auto& change = one.changes.back())
      std::cout << fmt::format(
          " {:>10} {:>18}  {}", visits::signed_figure(change->value, visits::digits_of(*change)),
          interval(*change), verdict_words(comparison, one, entries.size() - 1));
    else if (one.values.front() && one.values.back() && several)
      std::cout << fmt::format(" {:>12}", "not compared");
    std::cout << '\n';
  }
}

visits::Comparison measured(const visits::VisitsFile& file) {
  std::size_t count = 0;
  for (const visits::VisitEntry& visit : file.visits) count += visit.recordings.size();
  Progress progress("measuring recordings", long(count));
  return visits::compare_visits(file, [&](std::size_t done) { progress.update(long(done)); });
}

void run(const VisitsOptions& options) {
  const visits::VisitsFile file = visits::read_visits(options.file);
  check_outputs_of(options, file);
  const visits::Comparison comparison = measured(file);
  for (const std::string& choice : visits::choices(comparison)) std::cerr << choice << '\n';
  for (const std::string& doubt : visits::doubts(comparison)) spdlog::warn("{}", doubt);
  for (const std::string& remark : visits::remarks(comparison)) spdlog::warn("{}", remark);
  print_table(comparison);
  std::cout << '\n';
  for (const std::string& sentence : visits::summary(comparison)) std::cout << sentence << '\n';
  std::cout << visits::repetition_sentence(comparison) << '\n';
  std::cout << "+-: 95 %, by measurement alone. This is no medical device: the figures describe "
               "motions and diagnose nothing.\n";
  if (!options.table.empty()) visits::write_visits_table(options.table, comparison);
  if (!options.out.empty()) visits::write_visits_page(options.out, comparison);
}

}  // namespace

void add_visits(CLI::App& program) {
  auto options = std::make_shared<VisitsOptions>();
  CLI::App* command = program.add_subcommand(
      "visits",
      "What changed between visits: one patient's expression, recorded on several days, measured "
      "at its peak. Each change has a 95 % interval and says whether it is beyond what measurement "
      "and the repetition of an expression make (docs/visits.md). Where FILE names no "
      "rigid_points, the points beside the landmarks that keep still in every recording hold the "
      "head, the same at all visits; where there are none, the landmarks do. No medical device.");
  command
      ->add_option("FILE", options->file,
                   "The visits (TOML): patient, expression, and tables [[visit]] with date and "
                   "recordings (CSV or TRC)")
      ->required();
  command->add_option("--out", options->out,
                      "Write a page here (.html): what changed, faces, curves, table; it prints on "
                      "one page of A4");
  command->add_option("--table", options->table, "Write all figures of all visits here (.csv)");
  command->footer("Example:\n  hyperex visits patient.toml --out patient.html --table patient.csv");
  command->callback([options] { run(*options); });
}

}  // namespace hyperex::cli
