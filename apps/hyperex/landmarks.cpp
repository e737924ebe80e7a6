// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/io/landmarks.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "commands.hpp"
#include "hyperex/anatomy/scan_doubts.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/memory.hpp"
#include "hyperex/core/output_file.hpp"
#include "hyperex/core/printable.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/tracking/scan/scan_landmarks.hpp"

namespace hyperex::cli {
namespace {

struct LandmarksOptions {
  std::filesystem::path scan, out, picture;
  std::string unit;
};

std::string text(const Vec3& v) {
  return fmt::format("({:.2f}, {:.2f}, {:.2f})", v.x(), v.y(), v.z());
}

void run(const LandmarksOptions& options) {
  check_outputs({options.out, options.picture}, {options.scan});
  const bool for_slicer = options.out.string().ends_with(".mrk.json");
  check_output_kinds({{options.out,
                       {".json"},
                       "{",
                       for_slicer ? std::vector<std::string>{"\"markups\""}
                                  : std::vector<std::string>{"\"points\"", "\"units\""}},
                      png_output(options.picture)});
  take_library_memory();
  const auto unit = options.unit.empty() ? std::nullopt : io::length_unit(options.unit);
  const io::Scan scan = io::read_scan(options.scan, unit);
  if (scan.unit_guessed)
    std::cerr << fmt::format("{}: unit {}\n", printable(options.scan.string()),
                             io::unit_note(scan));
  const auto colours = tracking::picture_colours(scan);
  const auto found = tracking::find_scan_landmarks(scan.mesh, colours, options.scan.string());
  if (found.without_colours)
    std::cerr << fmt::format("{}: its colours hide the face, which was found without them\n",
                             printable(options.scan.string()));
  for (const std::optional<std::string>& doubt :
       {anatomy::flat_problem(found.landmarks),
        anatomy::half_missing(found.landmarks, found.landmarks, scan.mesh)})
    if (doubt) spdlog::warn("{}: {}", options.scan.string(), *doubt);
  if (!options.picture.empty())
    render::write_png(options.picture, tracking::draw_scan_landmarks(
                                           scan.mesh, colours, found,
                                           "Landmarks of " + options.scan.filename().string()));
  try {
    io::write_landmarks(options.out, found.landmarks, scan.unit);
  } catch (...) {
    std::error_code ignored;
    if (!options.picture.empty()) std::filesystem::remove(options.picture, ignored);
    throw;
  }
  const Eigen::Matrix3d& scan_from_face = found.scan_from_canonical.rotation;
  std::cout << fmt::format(
      "{} landmarks from {} pictures, which lie {:.1f} mm (median) from where all agree\n"
      "the face looks along {}, its top is along {}\n"
      "written to {}; {}\n",
      found.landmarks.size(), found.views, 1e3 * found.spread_m, text(scan_from_face.col(2)),
      text(scan_from_face.col(1)), printable(options.out.string()),
      options.picture.empty() ? "--picture FILE.png draws them"
                              : "look at " + printable(options.picture.string()));
}

}  // namespace

void add_landmarks(CLI::App& program) {
  auto options = std::make_shared<LandmarksOptions>();
  CLI::App* command =
      program.add_subcommand("landmarks",
                             "Find the landmarks of a scan in any orientation: the 68 iBUG points "
                             "and anatomical points (docs/landmarks.md)");
  command->add_option("SCAN", options->scan, "PLY, OBJ, STL, glTF or GLB, with or without colour")
      ->required();
  command->add_option("--out", options->out, "Where to write them (.json)")->required();
  command->add_option("--picture", options->picture, "Draw them on the scan (.png) here");
  command->add_option("--unit", options->unit, "Unit of the scan (default: guessed)")
      ->check(CLI::IsMember({"mm", "cm", "m"}));
  command->footer(
      "Example: hyperex landmarks scan.ply --out scan_landmarks.json --picture scan_landmarks.png");
  command->callback([options] { run(*options); });
}

}  // namespace hyperex::cli
