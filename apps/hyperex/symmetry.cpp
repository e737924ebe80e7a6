// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/symmetry.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "commands.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "symmetry_picture.hpp"

namespace hyperex::cli {
namespace {

struct Options {
  std::filesystem::path motion, out, picture;
  double floor = 1e-6, accuracy_mm = 0;
  std::string unit;
};

std::string cell(double value) {
  return std::isnan(value) ? fmt::format("{:>10}", "-") : fmt::format("{:10.5f}", value);
}

void print_table(const metrics::SymmetryCurve& curve) {
  std::cout << fmt::format("{:>10} {:>10} {:>10} {:>10}\n", "time (s)", "xi_L", "xi_R", "S (ln)");
  for (size_t i = 0; i < curve.time_s.size(); ++i)
    std::cout << fmt::format("{:10.4f} {} {} {}\n", curve.time_s[i], cell(curve.xi_left[i]),
                             cell(curve.xi_right[i]), cell(curve.s[i]));
  std::cout << fmt::format("floor: |xi_L - xi_R| = {:.3g}, S = {:.3f}\n", curve.floor,
                           std::log(curve.floor));
}

void run(const Options& options) {
  std::optional<io::LengthUnit> unit;
  if (!options.unit.empty()) unit = io::length_unit(options.unit);
  const motion::Motion motion = motion::read_motion(options.motion, unit);
  const double floor = options.accuracy_mm > 0
                           ? metrics::floor_from_accuracy(motion, options.accuracy_mm * 1e-3)
                           : options.floor;
  const metrics::SymmetryCurve curve = metrics::symmetry_of(motion, floor);
  for (const std::string& stand_in : curve.stand_ins)
    std::cerr << "stand-in for " << stand_in << '\n';
  if (!options.picture.empty())
    render::write_png(options.picture,
                      draw(curve, "Symmetry of " + options.motion.filename().string()));
  if (options.out.empty())
    print_table(curve);
  else
    metrics::write_symmetry_csv(options.out, curve);
}

}  // namespace

void add_symmetry(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "symmetry",
      "Symmetry of a motion: the relative change of the distances from each mouth corner to its "
      "side's eye, lid, nose wing and lip (xi_L, xi_R), and S = ln |xi_L - xi_R|.");
  command->add_option("MOTION", options->motion, "Named points over time, CSV or TRC")->required();
  command->add_option("--out", options->out, "Write CSV (time_s, xi_L, xi_R, S_ln, floor) here");
  command->add_option("--picture", options->picture, "Write a plot (PNG) here");
  auto* floor = command
                    ->add_option("--floor", options->floor,
                                 "Least |xi_L - xi_R| told apart; S stops at its logarithm")
                    ->capture_default_str();
  command
      ->add_option("--accuracy-mm", options->accuracy_mm,
                   "Set the floor by the accuracy of the points (standard deviation, mm)")
      ->check(CLI::PositiveNumber)
      ->excludes(floor);
  command->add_option("--unit", options->unit, "Unit of the motion, where it should not be guessed")
      ->check(CLI::IsMember({"mm", "cm", "m"}));
  command->footer("Example:\n  hyperex symmetry out/a/motion.csv --out symmetry.csv");
  command->callback([options] { run(*options); });
}

}  // namespace hyperex::cli
