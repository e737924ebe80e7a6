// SPDX-License-Identifier: GPL-3.0-or-later
// tracking_scores_study --data FOLDER --out FILE.md: writes a page of tables with the errors of
// tracking, as recorded and under bad conditions, and the errors of landmarks found on scans.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/quantile.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/tracking/scan/scan_landmarks.hpp"
#include "support/tracking_trial.hpp"
#include "support/turned_scan.hpp"

namespace hyperex::bench {
namespace {
namespace fs = std::filesystem;

struct Options {
  fs::path data, out;
  std::string machine, commit;
  bool no_scans = false;
};

/// Folders with a recording and its truth, by name.
std::vector<fs::path> recordings(const fs::path& folder) {
  std::vector<fs::path> found;
  if (fs::is_directory(folder))
    for (const auto& entry : fs::directory_iterator(folder))
      if (fs::exists(entry.path() / "truth_pose.csv")) found.push_back(entry.path());
  if (found.empty()) throw InputError(folder, "holds no recording with truth_pose.csv");
  std::sort(found.begin(), found.end());
  return found;
}

std::string pair(const tracking::Quantiles& q, int digits) {
  return std::isnan(q.median) ? "-" : fmt::format("{0:.{2}f} / {1:.{2}f}", q.median, q.p95, digits);
}

std::string number(const std::optional<double>& value, int digits) {
  return value && std::isfinite(*value) ? fmt::format("{:.{}f}", *value, digits) : "-";
}

std::string row(const std::string& name, const test::TrialResult& result) {
  const tracking::Score& s = result.score;
  std::string frames = fmt::format("{} of {}", s.lost, s.frames);
  if (result.spoiled)
    frames += fmt::format("; {} spoiled, {} given up", result.spoiled, result.given_up);
  return fmt::format("| `{}` | {} | {} | {} | {} | {} | {} |\n", name, frames,
                     pair(s.rotation_deg, 2), pair(s.translation_mm, 2), pair(s.deformation_mm, 2),
                     number(s.jaw_correlation, 4), number(s.rest_jitter_mm, 3));
}

constexpr const char* kTableHead =
    "\n| recording | frames lost | rotation, deg | translation, mm | deformation, mm | jaw | "
    "jitter "
    "at rest, mm |\n|---|---|---|---|---|---|---|\n";

/// One table per condition.
std::string trial_tables(const std::vector<fs::path>& folders, const expression::FaceModel& model,
                         std::size_t conditions) {
  std::string page;
  for (std::size_t c = 0; c < conditions; ++c) {
    std::string rows;
    test::Trial trial;
    for (const fs::path& folder : folders) {
      trial = test::standard_trials(tracking::read_truth(folder).time_s.size())[c];
      rows += row(folder.filename().string(), test::run_trial(folder, model, trial.degradation));
    }
    fmt::print(stderr, "{}, {}\n", model.name, trial.name);
    page += fmt::format("\n### {}\n{}{}{}", trial.name, trial.what, trial.what.empty() ? "" : "\n",
                        kTableHead + rows);
  }
  return page;
}

struct KnownScan {
  const char *scan, *landmarks;
};

/// All rotations of a scan: medians and worst errors, with their range over the rotations.
std::string scan_rows(const fs::path& data, const KnownScan& known) {
  const io::Scan scan = io::read_scan(data / known.scan);
  const io::Landmarks truth = io::read_landmarks(data / known.landmarks);
  struct Kind {
    const char* name;
    int first_ibug;
    std::vector<double> medians, worst;
  } kinds[] = {{"51 inner iBUG points", 17, {}, {}}, {"all that are known", 0, {}, {}}};
  int failed = 0;
  for (int k = -1; k < 24; ++k) {  // -1: not rotated
    const Eigen::Matrix3d turn = k < 0 ? Eigen::Matrix3d::Identity() : test::slanting_turn(k);
    try {
      const auto found = tracking::find_scan_landmarks(test::turned(scan.mesh, turn),
                                                       tracking::picture_colours(scan), known.scan);
      for (Kind& kind : kinds) {
        const auto errors = test::errors_mm(found.landmarks, truth, turn, kind.first_ibug);
        if (errors.empty()) continue;
        kind.medians.push_back(median(errors));
        kind.worst.push_back(errors.back());
      }
    } catch (const InputError&) {
      ++failed;
    }
  }
  std::string rows;
  const auto range = [](const std::vector<double>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return fmt::format("{:.1f} to {:.1f}", *low, *high);
  };
  for (const Kind& kind : kinds)
    if (!kind.medians.empty())
      rows += fmt::format("| `{}` | {} | {} of 25 | {} | {} |\n", known.scan, kind.name, failed,
                          range(kind.medians), range(kind.worst));
  return rows.empty() ? fmt::format("| `{}` | | {} of 25 | - | - |\n", known.scan, failed) : rows;
}

std::string scan_table(const fs::path& data) {
  const KnownScan all[] = {{"ict/subject_A_neutral_scan.ply", "ict/subject_A_landmarks.json"},
                           {"real/humface.ply", "real/humface_landmarks.json"}};
  std::string rows;
  for (const KnownScan& known : all) {
    if (!fs::exists(data / known.scan)) continue;
    rows += scan_rows(data, known);
    fmt::print(stderr, "{}, in all turns\n", known.scan);
  }
  return rows;
}

void run(const Options& options) {
  const std::vector<fs::path> folders = recordings(options.data / "rgbd");
  const fs::path candide_file = options.data / "candide/candide3.wfm";
  std::optional<expression::FaceModel> candide;
  if (fs::exists(candide_file)) candide = expression::candide_model(candide_file.string());
  std::string page = fmt::format(
      "# Scores of tracking\n\nWritten by `cmake --build build/release --target tracking_scores` "
      "at "
      "commit {}: every number\nbelow comes from that run, none is typed. {}.\n\n"
      "Medians / 95th percentiles against the truth, by `hyperex track --score` "
      "([tracking](tracking.md)). Rotation and\ntranslation of the head and deformation of lips "
      "and "
      "chin are relative to the first frame. *Jaw* is the correlation of\nthe jaw's unit with the "
      "true `jawOpen`; jitter is taken over frames in which nothing moves. *Spoiled* frames show "
      "the\nface elsewhere or not at all and are not scored; *given up* are those of them that the "
      "tracker marks as not valid.\n\n## Canonical face\n",
      options.commit, options.machine);
  page += trial_tables(folders, expression::canonical_model(), test::standard_trials(0).size());
  if (candide)
    page += "\n## CANDIDE-3\n" + trial_tables(folders, *candide, 2);  // as recorded, colour only
  if (!options.no_scans)
    if (const std::string rows = scan_table(options.data); !rows.empty())
      page +=
          "\n## Landmarks on scans\nEach scan as it is and in 24 turns by right angles with 20 "
          "degrees more, its colours used where it has any;\nleast and greatest over the turns.\n\n"
          "| scan | points | no face found | median, mm | worst point, mm "
          "|\n|---|---|---|---|---|\n" +
          rows;
  write_file_atomically(options.out, [&](std::ostream& out) { out << page; });
}

}  // namespace
}  // namespace hyperex::bench

int main(int argc, char** argv) {
  hyperex::bench::Options options;
  CLI::App program("Scores of tracking and of landmarks on scans, as a page");
  program.add_option("--data", options.data, "Folder with rgbd/, ict/, real/ and candide/")
      ->required();
  program.add_option("--out", options.out, "The page (.md)")->required();
  program.add_option("--commit", options.commit)->required();
  program.add_option("--machine", options.machine)->required();
  program.add_flag("--no-scans", options.no_scans, "Recordings alone (the scans take minutes)");
  CLI11_PARSE(program, argc, argv);
  try {
    hyperex::bench::run(options);
  } catch (const std::exception& error) {
    std::cerr << "tracking_scores: " << error.what() << '\n';
    return 1;
  }
}
