// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "commands.hpp"
#include "compare_picture.hpp"
#include "compare_surfaces.hpp"
#include "hyperex/anatomy/landmarks.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/output_file.hpp"
#include "hyperex/core/printable.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/landmark_errors.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/metrics/baseline.hpp"
#include "hyperex/metrics/error_budget.hpp"
#include "hyperex/metrics/regions.hpp"
#include "hyperex/metrics/surface_distance.hpp"

namespace hyperex::cli {
namespace {

using Json = nlohmann::ordered_json;

Eigen::VectorXd distances(const CompareOptions& options, const ComparedSurfaces& surfaces,
                          const Points& moved) {
  return options.corresponding
             ? metrics::distance_to_corresponding(moved, surfaces.b.points, surfaces.scored)
             : metrics::distance_to_surface(moved.topRows(surfaces.scored), surfaces.b);
}

struct Row {
  std::string region;
  metrics::DistanceStatistics statistics;
  /// Errors of the mean, since the region's place depends on landmarks. Empty for the whole
  /// surface.
  std::optional<metrics::ErrorBudget> errors = {};
};

std::vector<Row> rows_of(const Eigen::VectorXd& distance, const metrics::Regions& regions) {
  std::vector<Row> rows = {{"surface", metrics::statistics_of(distance)}};
  for (const metrics::Region& region : regions.regions)
    rows.push_back({region.name, metrics::statistics_of(distance, region.vertices)});
  return rows;
}

/// Adds what errors of the landmarks make of each region's mean.
void add_errors(std::vector<Row>& rows, const Eigen::VectorXd& distance, const Points& rest,
                const io::Landmarks& landmarks) {
  constexpr int kDraws = 8;
  std::map<std::string, std::vector<double>> squares;
  std::mt19937 random(1);
  for (int draw = 0; draw < kDraws; ++draw) {
    const metrics::Regions moved =
        metrics::regions_of(rest, face::with_errors(landmarks, face::kLandmarkError_m, random));
    for (const Row& row : rows)
      if (const metrics::Region* region = moved.find(row.region))
        squares[row.region].push_back(std::pow(
            metrics::statistics_of(distance, region->vertices).mean_mm - row.statistics.mean_mm,
            2));
  }
  for (Row& row : rows)
    if (const auto found = squares.find(row.region); found != squares.end()) {
      const auto& all = found->second;
      row.errors.emplace().add(metrics::ErrorPart::landmarks,
                               std::accumulate(all.begin(), all.end(), 0.0) / double(all.size()),
                               double(all.size()));
    }
}

struct BaselineRows {
  std::string name, key;
  std::vector<Row> rows;
};

Json json_of(const metrics::DistanceStatistics& s) {
  return {{"mean_mm", s.mean_mm},
          {"median_mm", s.median_mm},
          {"rms_mm", s.rms_mm},
          {"p95_mm", s.p95_mm},
          {"max_mm", s.max_mm}};
}

void print_json(const std::vector<Row>& rows, const std::vector<BaselineRows>& baselines) {
  Json json;
  for (const Row& row : rows) {
    json[row.region] = json_of(row.statistics);
    if (row.errors) json[row.region]["mean_half_width_95_mm"] = row.errors->half_width_95();
  }
  for (const BaselineRows& baseline : baselines)
    for (size_t i = 0; i < rows.size(); ++i) {
      Json& entry = json["baseline"][baseline.key][rows[i].region];
      entry = json_of(baseline.rows[i].statistics);
      if (baseline.rows[i].statistics.mean_mm > 0)
        entry["ratio_of_means"] = rows[i].statistics.mean_mm / baseline.rows[i].statistics.mean_mm;
    }
  std::cout << json.dump(2) << '\n';
}

void print_table(const CompareOptions& options, const std::vector<Row>& rows,
                 const std::vector<BaselineRows>& baselines) {
  std::cout << (options.corresponding ? "Distance between corresponding vertices, mm\n"
                                      : "Distance from A to the closest point of B, mm\n");
  const bool errors =
      std::ranges::any_of(rows, [](const Row& row) { return row.errors.has_value(); });
  std::cout << fmt::format("{:<10} {:>8} {:>8} {:>8} {:>8} {:>8} {:>9}{}\n", "region", "mean",
                           "median", "rms", "p95", "max", "vertices", errors ? "  +- of mean" : "");
  for (const auto& [region, s, error] : rows)
    std::cout << fmt::format("{:<10} {:8.3f} {:8.3f} {:8.3f} {:8.3f} {:8.3f} {:9}{}\n", region,
                             s.mean_mm, s.median_mm, s.rms_mm, s.p95_mm, s.max_mm, s.count,
                             error ? fmt::format("  {:10.3f}", error->half_width_95()) : "");
  if (errors)
    std::cout
        << "+-: 95 %, what landmarks 1.5 mm off make of a region's mean; the surfaces count as "
           "exact\n";
  if (baselines.empty()) return;
  std::cout << "\nMeasured against (mean, mm; in brackets A's mean as a fraction of it)\n"
            << fmt::format("{:<23}", "");
  for (const Row& row : rows) std::cout << fmt::format(" {:>14}", row.region);
  std::cout << fmt::format("\n{:<23}", "A");
  for (const Row& row : rows) std::cout << fmt::format(" {:>6.2f}{:8}", row.statistics.mean_mm, "");
  for (const BaselineRows& baseline : baselines) {
    std::cout << fmt::format("\n{:<23}", baseline.name);
    for (size_t i = 0; i < rows.size(); ++i) {
      const double mean = baseline.rows[i].statistics.mean_mm;
      const std::string ratio =
          mean > 0 ? fmt::format("({:.2f})", rows[i].statistics.mean_mm / mean) : "";
      std::cout << fmt::format(" {:>6.2f} {:>7}", mean, ratio);
    }
  }
  std::cout << '\n';
}

// If the region "face" is known, the picture is filled with it alone.
void write_picture(const CompareOptions& options, const ComparedSurfaces& surfaces,
                   const io::Landmarks& landmarks, const metrics::Regions& regions,
                   const Eigen::VectorXd& distance) {
  const metrics::Region* face = regions.find("face");
  const metrics::DistanceStatistics s =
      face ? metrics::statistics_of(distance, face->vertices) : metrics::statistics_of(distance);
  ComparePicture picture{.surface = surfaces.a, .distance_m = distance};
  if (face) picture.framed = face->vertices;
  if (const auto frame = face::face_frame_of_corners(landmarks))
    picture.face_from_scan = frame->face_from_scan();
  picture.title =
      fmt::format("{} and {}", options.a.filename().string(), options.b.filename().string());
  picture.note = fmt::format("{}; {}: mean {:.2f} mm, 95 % below {:.2f} mm",
                             options.corresponding ? "distance between corresponding vertices"
                                                   : "distance to the closest point",
                             face ? "over the face" : "over the surface", s.mean_mm, s.p95_mm);
  picture.top_mm = s.p95_mm;
  render::write_png(options.picture, draw(picture));
  std::cerr << "picture: " << printable(options.picture.string()) << '\n';
}

void run(const CompareOptions& options) {
  if (options.baseline &&
      (!options.corresponding || options.rest.empty() || options.landmarks.empty()))
    throw InputError(InputProblem{"compare", 0, "--baseline", "",
                                  "--corresponding, --rest SCAN and --landmarks L.json beside it"});
  check_outputs({options.picture}, {options.a, options.b, options.rest, options.landmarks});
  check_output_kinds({png_output(options.picture)});
  const ComparedSurfaces surfaces = read_surfaces(options);
  io::Landmarks landmarks;
  metrics::Regions regions;
  if (!options.landmarks.empty()) {
    landmarks = io::read_landmarks(options.landmarks);
    regions = metrics::regions_of(surfaces.rest.points.topRows(surfaces.scored), landmarks);
  }
  for (const auto& notes : {surfaces.notes, regions.notes})
    for (const std::string& note : notes) std::cerr << note << '\n';
  if (const auto unknown = anatomy::unknown_landmarks(landmarks); !unknown.empty())
    std::cerr << anatomy::unknown_landmarks_note(unknown).text << '\n';
  const Eigen::VectorXd distance = distances(options, surfaces, surfaces.a.points);
  std::vector<Row> rows = rows_of(distance, regions);
  if (!landmarks.empty())
    add_errors(rows, distance, surfaces.rest.points.topRows(surfaces.scored), landmarks);
  std::vector<BaselineRows> baselines;
  if (options.baseline)
    for (const auto& baseline : metrics::baselines(surfaces.rest, surfaces.b.points, landmarks))
      baselines.push_back({baseline.name, baseline.key,
                           rows_of(distances(options, surfaces, baseline.moved), regions)});
  if (!options.picture.empty()) write_picture(options, surfaces, landmarks, regions, distance);
  if (options.json)
    print_json(rows, baselines);
  else
    print_table(options, rows, baselines);
}

}  // namespace

void add_compare(CLI::App& program) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* command = program.add_subcommand(
      "compare",
      "Distance from surface A to surface B, or between vertices of the same index: overall and by "
      "region of the face, as a table, JSON or a coloured picture.");
  command->add_option("A", options->a, "Surface that is scored (PLY, OBJ, STL, glTF)")->required();
  command->add_option("B", options->b, "Surface that it is measured against")->required();
  command->add_option("--landmarks", options->landmarks,
                      "Landmarks of the scan at rest, for the regions");
  command->add_flag("--corresponding", options->corresponding,
                    "Between vertices of the same index, not to the closest point");
  command->add_option("--rest", options->rest,
                      "Scan at rest, on which the regions are defined (default: A). Vertices of A "
                      "or B beyond its number are ignored");
  command->add_flag("--json", options->json, "Print only JSON on standard output");
  command->add_option("--picture", options->picture,
                      "Write a coloured picture of the distance here (.png)");
  command->add_option("--unit", options->unit, "Unit of the surfaces (default: guessed by size)")
      ->check(CLI::IsMember({"mm", "cm", "m"}));
  command->add_flag(
      "--baseline", options->baseline,
      "Also score baselines: no motion, and radial-basis warps and blend shapes that the true "
      "displacement of the landmarks moves (with --corresponding, --rest and --landmarks)");
  command->footer(
      "Example:\n  hyperex compare --corresponding --rest scan.ply out/a/skin_peak.ply truth.ply "
      "--landmarks landmarks.json --picture distance.png");
  command->callback([options] { run(*options); });
}

}  // namespace hyperex::cli
