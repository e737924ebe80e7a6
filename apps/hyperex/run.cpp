// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/kept_results.hpp"
#include "hyperex/core/memory.hpp"
#include "hyperex/core/printable.hpp"
#include "hyperex/run/activations.hpp"
#include "hyperex/run/corner_words.hpp"
#include "hyperex/run/expected_error_words.hpp"
#include "hyperex/run/run_scene.hpp"
#include "hyperex/run/setting_words.hpp"
#include "hyperex/run/surgery.hpp"

namespace hyperex::cli {
namespace {

struct RunOptions {
  std::filesystem::path scene;
  std::optional<std::filesystem::path> out;
  std::vector<std::string> overrides;
  bool verify = false, no_cache = false, no_variants = false, error_budget = false;
};

std::string solver_line(const nlohmann::ordered_json& summary) {
  if (!summary.contains("basis_size")) return "";
  std::string line = fmt::format("reduced model of {} unknowns for {}, estimated error {:.1e}",
                                 summary["basis_size"].get<int>(), summary["free_dofs"].get<int>(),
                                 summary["estimated_error"].get<double>());
  if (summary.contains("verified_error"))
    line += fmt::format(", measured against the full model {:.1e}",
                        summary["verified_error"].get<double>());
  return line + " of the largest displacement\n";
}

/// The intervals of the corners of the mouth, a line each.
std::string budget_lines(const nlohmann::ordered_json& summary) {
  if (!summary.contains("error_budget")) return "";
  std::string lines;
  for (const auto& sentence : summary["error_budget"]["sentences"])
    lines += sentence.get<std::string>() + '\n';
  return lines;
}

/// What the file is for, and how far it is from the motion where its largest size allows no less.
std::string use_of_glb(const nlohmann::ordered_json& summary) {
  const std::string programs = "Blender, three.js";
  if (!summary.contains("glb")) return programs;
  const auto& output = summary["options"]["output"];
  const double error_mm = summary["glb"]["largest_error_mm"].get<double>(),
               wanted_mm = output["glb_tolerance_mm"].get<double>();
  if (error_mm <= wanted_mm) return programs;
  return fmt::format("{}; the motion to {:.2f} mm; for {:g} mm set output.glb_max_mb above {:g}",
                     programs, error_mm, wanted_mm, output["glb_max_mb"].get<double>());
}

void run(const RunOptions& options) {
  take_library_memory();
  auto overrides = options.overrides;
  if (options.verify) overrides.push_back("solver.verify=true");
  if (options.error_budget) overrides.push_back("output.error_budget=true");
  scene::Scene scene = scene::read_scene(options.scene, overrides);
  // This is checked after the scene, because errors in the scene are more important.
  if (!options.out)
    throw InputError("--out is required: the folder for the outputs, as in --out out/" +
                     options.scene.stem().string());
  if (options.no_variants) scene::leave_out_variants(scene);
  if (!options.no_cache) scene.kept = KeptResults(user_cache_folder());
  const auto summary = run::run_scene(scene, *options.out);
  std::cout << fmt::format(
      "{} frames, {} steps, largest displacement {:.1f} mm, lips at most {:.1f} mm apart, {:.1f} s "
      "in all\n"
      "{}{}{}{}{}{}{}{}{}"
      "written to {}:\n",
      summary["frames"].get<int>(), summary["steps"].get<int>(),
      summary["max_displacement_mm"].get<double>(), summary["lip_opening_mm"].get<double>(),
      summary["seconds"]["total"].get<double>(), solver_line(summary), run::contact_line(summary),
      run::corners_line(summary), run::rescaled_line(summary), run::variant_lines(summary),
      run::surgery_lines(summary), run::expected_error_line(summary),
      run::activations_line(summary), budget_lines(summary), printable(options.out->string()));
  const std::pair<const char*, std::string> files[] = {
      {"report.html", "open it in a browser"},
      {"contact_sheet.png", "the face at a glance"},
      {"performance.glb", use_of_glb(summary)},
      {"frames.pvd", "ParaView"},
      {"skin_peak.ply", "the skin at its peak"},
      {"motion.csv", "landmarks over time"},
      {"symmetry.csv", "S(t): whether both sides stretch alike"},
      {"variants.png", "where and how far the variants differ"},
      {"variants_symmetry.png", "S(t) of all variants: whether both sides stretch alike"},
      {"variants.csv", "the variants as a table; each has its folder in variants/"},
      {"variants_excursions.csv",
       "how far each point of either side travels, with and without the change"},
      {"error_budget.csv", "how certain each excursion and each change is, and why"},
      {"activations.csv", "what the muscles did"},
      {"muscles.png", "where they lie"},
      {"gaze.csv", "how the eyes turn"},
      {"excursions.csv", "how far and how fast either side moves"},
      {"asymmetry.png", "the face against its reflection"},
      {"summary.json", "counts, times, options"}};
  for (const auto& [name, use] : files)
    if (std::filesystem::exists(*options.out / name))
      std::cout << fmt::format("  {:<23} {}\n", name, use);
}

}  // namespace

void add_run(CLI::App& program) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command =
      program.add_subcommand("run", "Re-enact a recorded expression on a scanned face");
  command->add_option("SCENE", options->scene, "Scene file (docs/scene.md)")->required();
  command->add_option("--out", options->out,
                      "Folder for the outputs, required: new, empty, or from an earlier run. It is "
                      "written completely or not at all");
  command->add_option("--set", options->overrides, "Override a key of the scene; can be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_flag("--verify", options->verify,
                    "Run the full model too and report the true error of the reduced one");
  command->add_flag("--error-budget", options->error_budget,
                    "State a 95 % interval for every excursion and every change, with its parts "
                    "(docs/uncertainty.md); runs the face twelve times more. As "
                    "output.error_budget of the scene");
  command->add_flag("--no-variants", options->no_variants,
                    "Run the scene without its variants, which take as long as it does each");
  command->add_flag("--no-cache", options->no_cache,
                    "Compute landmarks, tracked motion and meshes again. Without this option, "
                    "earlier results of the same program on the same files are taken from "
                    "$XDG_CACHE_HOME/hyperex (or ~/.cache/hyperex, at most 256 MB)");
  command->footer(
      "Example: hyperex run examples/demo.toml --out out/demo --set tissue.young_kpa=300");
  command->callback([options] { run(*options); });
}

}  // namespace hyperex::cli
