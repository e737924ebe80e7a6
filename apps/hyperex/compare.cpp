// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cctype>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "commands.hpp"
#include "compare_picture.hpp"
#include "hyperex/anatomy/landmarks.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/output_file.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/metrics/baseline.hpp"
#include "hyperex/metrics/regions.hpp"
#include "hyperex/metrics/surface_distance.hpp"

namespace hyperex::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::filesystem::path a, b, landmarks, rest, picture;
  bool corresponding = false, json = false, baseline = false;
  std::string unit;
};

struct Surfaces {
  TriMesh a, b, rest;       // rest: that of --rest, else a
  Eigen::Index scored = 0;  // the first so many vertices of a
  std::vector<std::string> notes;
};

// Reads the files and keeps what is to be said of their units.
class Reader {
 public:
  explicit Reader(const std::string& unit) : unit_(io::length_unit(unit)) {}
  TriMesh read(const std::filesystem::path& file) {
    if (unit_) return io::read_mesh(file, *unit_);
    io::Scan scan = io::read_scan(file);
    notes_.push_back(fmt::format("{}: unit {}", file.string(), io::unit_note(scan)));
    if (scan.unit_guessed) guessed_.insert(scan.unit);
    return std::move(scan.mesh);
  }
  std::vector<std::string> notes() const {
    std::vector<std::string> all = notes_;
    if (guessed_.size() > 1)
      all.push_back(
          "warning: the units that were guessed differ; if the files are in one unit, state it "
          "with --unit");
    return all;
  }

 private:
  std::optional<io::LengthUnit> unit_;
  std::vector<std::string> notes_;
  std::set<io::LengthUnit> guessed_;
};

// A distance between surfaces of quite another size means that a unit is wrong.
void check_sizes(const Options& options, const Surfaces& surfaces) {
  constexpr double most = 5;
  const double a = io::across(surfaces.a.points);
  const auto check = [&](const std::filesystem::path& file, const TriMesh& mesh) {
    const double size = io::across(mesh.points);
    if (size <= most * a && a <= most * size) return;
    throw InputError(
        file, fmt::format("is {:.4g} mm across and {} is {:.4g} mm{}: expected surfaces of about "
                          "one size; are both in the same unit?",
                          1e3 * size, options.a.string(), 1e3 * a,
                          options.unit.empty() ? "" : fmt::format(" in {}", options.unit)));
  };
  check(options.b, surfaces.b);
  check(options.rest.empty() ? options.a : options.rest, surfaces.rest);
}

// An STL repeats each corner; joined again, vertices are numbered by their first appearance, and
// where two of them touch they are one.
void refuse_stl(const Options& options) {
  for (const auto& file : {options.a, options.b}) {
    std::string extension = file.extension().string();
    for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
    if (extension == ".stl")
      throw InputError(file,
                       "is an STL, which does not number its vertices: --corresponding needs "
                       "PLY, OBJ or glTF; without it the closest points are compared");
  }
}

// Scored by corresponding vertices, all three must begin with the vertices at rest.
void check_counts(const Options& options, Surfaces& surfaces) {
  const Eigen::Index a = surfaces.a.points.rows(), b = surfaces.b.points.rows();
  if (options.rest.empty()) {
    if (a != b)
      throw InputError(options.b, fmt::format("has {} vertices and {} has {}: to be compared by "
                                              "corresponding vertices they need as many; give the "
                                              "scan at rest (--rest) if one has some appended",
                                              b, options.a.string(), a));
    surfaces.scored = a;
    return;
  }
  surfaces.scored = surfaces.rest.points.rows();
  for (const auto& [file, count] : {std::pair{options.a, a}, std::pair{options.b, b}}) {
    if (count < surfaces.scored)
      throw InputError(file, fmt::format("has {} vertices, fewer than the {} of the scan at rest "
                                         "{}: they do not correspond",
                                         count, surfaces.scored, options.rest.string()));
    if (count > surfaces.scored)
      std::cerr << fmt::format(
          "{}: {} vertices beyond the {} of the scan at rest are taken as appended and left out\n",
          file.string(), count - surfaces.scored, surfaces.scored);
  }
}

Surfaces read_surfaces(const Options& options) {
  if (options.corresponding) refuse_stl(options);
  Surfaces surfaces;
  Reader reader(options.unit);
  surfaces.a = reader.read(options.a);
  surfaces.b = reader.read(options.b);
  surfaces.rest = options.rest.empty() ? surfaces.a : reader.read(options.rest);
  surfaces.notes = reader.notes();
  check_sizes(options, surfaces);
  if (options.corresponding) {
    check_counts(options, surfaces);
    return surfaces;
  }
  surfaces.scored = surfaces.a.points.rows();
  if (!options.rest.empty() && surfaces.rest.points.rows() != surfaces.scored)
    surfaces.scored = std::min(surfaces.scored, surfaces.rest.points.rows());
  if (!options.rest.empty() && surfaces.scored < surfaces.rest.points.rows())
    throw InputError(
        options.a,
        fmt::format("has {} vertices, fewer than the {} of the scan at rest {}", surfaces.scored,
                    surfaces.rest.points.rows(), options.rest.string()));
  return surfaces;
}

Eigen::VectorXd distances(const Options& options, const Surfaces& surfaces, const Points& moved) {
  return options.corresponding
             ? metrics::distance_to_corresponding(moved, surfaces.b.points, surfaces.scored)
             : metrics::distance_to_surface(moved.topRows(surfaces.scored), surfaces.b);
}

struct Row {
  std::string region;
  metrics::DistanceStatistics statistics;
};

std::vector<Row> rows_of(const Eigen::VectorXd& distance, const metrics::Regions& regions) {
  std::vector<Row> rows = {{"surface", metrics::statistics_of(distance)}};
  for (const metrics::Region& region : regions.regions)
    rows.push_back({region.name, metrics::statistics_of(distance, region.vertices)});
  return rows;
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
  for (const Row& row : rows) json[row.region] = json_of(row.statistics);
  for (const BaselineRows& baseline : baselines)
    for (size_t i = 0; i < rows.size(); ++i) {
      Json& entry = json["baseline"][baseline.key][rows[i].region];
      entry = json_of(baseline.rows[i].statistics);
      if (baseline.rows[i].statistics.mean_mm > 0)
        entry["ratio_of_means"] = rows[i].statistics.mean_mm / baseline.rows[i].statistics.mean_mm;
    }
  std::cout << json.dump(2) << '\n';
}

void print_table(const Options& options, const std::vector<Row>& rows,
                 const std::vector<BaselineRows>& baselines) {
  std::cout << (options.corresponding ? "Distance between corresponding vertices, mm\n"
                                      : "Distance from A to the closest point of B, mm\n");
  std::cout << fmt::format("{:<10} {:>8} {:>8} {:>8} {:>8} {:>8} {:>9}\n", "region", "mean",
                           "median", "rms", "p95", "max", "vertices");
  for (const auto& [region, s] : rows)
    std::cout << fmt::format("{:<10} {:8.3f} {:8.3f} {:8.3f} {:8.3f} {:8.3f} {:9}\n", region,
                             s.mean_mm, s.median_mm, s.rms_mm, s.p95_mm, s.max_mm, s.count);
  if (baselines.empty()) return;
  std::cout << "\nMeasured against (mean, mm; in brackets A's mean as a fraction of it)\n"
            << fmt::format("{:<20}", "");
  for (const Row& row : rows) std::cout << fmt::format(" {:>14}", row.region);
  std::cout << fmt::format("\n{:<20}", "A");
  for (const Row& row : rows) std::cout << fmt::format(" {:>6.2f}{:8}", row.statistics.mean_mm, "");
  for (const BaselineRows& baseline : baselines) {
    std::cout << fmt::format("\n{:<20}", baseline.name);
    for (size_t i = 0; i < rows.size(); ++i) {
      const double mean = baseline.rows[i].statistics.mean_mm;
      const std::string ratio =
          mean > 0 ? fmt::format("({:.2f})", rows[i].statistics.mean_mm / mean) : "";
      std::cout << fmt::format(" {:>6.2f} {:>7}", mean, ratio);
    }
  }
  std::cout << '\n';
}

// The face alone is framed where it is known.
void write_picture(const Options& options, const Surfaces& surfaces, const io::Landmarks& landmarks,
                   const metrics::Regions& regions, const Eigen::VectorXd& distance) {
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
  std::cerr << "picture: " << options.picture.string() << '\n';
}

void run(const Options& options) {
  if (options.baseline &&
      (!options.corresponding || options.rest.empty() || options.landmarks.empty()))
    throw InputError(InputProblem{"compare", 0, "--baseline", "",
                                  "--corresponding, --rest SCAN and --landmarks L.json beside it"});
  check_outputs({options.picture}, {options.a, options.b, options.rest, options.landmarks});
  check_output_kinds({png_output(options.picture)});
  const Surfaces surfaces = read_surfaces(options);
  io::Landmarks landmarks;
  metrics::Regions regions;
  if (!options.landmarks.empty()) {
    landmarks = io::read_landmarks(options.landmarks);
    regions = metrics::regions_of(surfaces.rest.points.topRows(surfaces.scored), landmarks);
  }
  for (const auto& notes : {surfaces.notes, regions.notes})
    for (const std::string& note : notes) std::cerr << note << '\n';
  if (const auto unknown = anatomy::unknown_landmarks(landmarks); !unknown.empty())
    std::cerr << anatomy::unknown_landmarks_note(unknown) << '\n';
  const Eigen::VectorXd distance = distances(options, surfaces, surfaces.a.points);
  const std::vector<Row> rows = rows_of(distance, regions);
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
  auto options = std::make_shared<Options>();
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
      "Also score two baselines: no motion, and radial-basis warps of the scan at rest by the true "
      "displacement of the landmarks (with --corresponding, --rest and --landmarks)");
  command->footer(
      "Example:\n  hyperex compare --corresponding --rest scan.ply out/a/skin_peak.ply truth.ply "
      "--landmarks landmarks.json --picture distance.png");
  command->callback([options] { run(*options); });
}

}  // namespace hyperex::cli
