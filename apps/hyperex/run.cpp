// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "hyperex/core/kept_results.hpp"
#include "hyperex/core/memory.hpp"
#include "hyperex/core/printable.hpp"
#include "hyperex/run/run_scene.hpp"

namespace hyperex::cli {
namespace {

struct RunOptions {
  std::filesystem::path scene, out;
  std::vector<std::string> overrides;
  bool verify = false, no_cache = false, no_variants = false;
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

double number_in(const nlohmann::ordered_json& json, const char* key) {
  return json.contains(key) && json[key].is_number() ? json[key].get<double>() : 0;
}

/// Whether the corners' difference counts, and what the larger floor comes from.
std::string floor_clause(const nlohmann::ordered_json& corners, double apart_mm) {
  const double floor_mm = number_in(corners, "floor_mm");
  if (floor_mm <= 0) return "";
  const bool of_jitter =
      number_in(corners, "jitter_floor_mm") > number_in(corners, "mesh_floor_mm");
  return fmt::format(": {} the floor of {} mm ({})",
                     corners.value("undecided", false) ? "undecided, below" : "more than",
                     floor_mm < 0.095 || std::abs(apart_mm - floor_mm) < 0.1
                         ? fmt::format("{:.2f}", floor_mm)
                         : fmt::format("{:.1f}", floor_mm),
                     of_jitter ? "jitter" : "mesh");
}

/// An error of the head's pose moves both corners: a shift along both their ways parts them by
/// nothing, a turn or a shift to one side does. No floor holds that, so it is said where it is
/// larger than the floor.
std::string head_clause(const nlohmann::ordered_json& summary,
                        const nlohmann::ordered_json& corners) {
  const double shift_mm = number_in(summary, "head_shift_uncertainty_mm");
  if (shift_mm <= number_in(corners, "floor_mm") || shift_mm < 0.05) return "";
  return fmt::format(
      "; not in it: the head's pose, uncertain by up to {:.1f} mm and {:.1f} degrees (95 %), of "
      "which a turn or a shift to one side would part them too",
      shift_mm, number_in(summary, "head_turn_uncertainty_deg"));
}

/// "corners of the mouth: left 3.8 mm, right 12.7 mm, 8.9 mm apart"; empty where they are not
/// known.
std::string corners_line(const nlohmann::ordered_json& summary) {
  const auto& symmetry = summary["symmetry"];
  if (!symmetry.contains("commissure")) return "";
  const auto& corners = symmetry["commissure"];
  if (!corners.contains("excursion_mm") || !corners["excursion_mm"]["L"].is_number()) return "";
  const double left = corners["excursion_mm"]["L"], right = corners["excursion_mm"]["R"];
  std::string line =
      fmt::format("corners of the mouth: left {:.1f} mm, right {:.1f} mm, {:.1f} mm apart", left,
                  right, std::abs(left - right));
  return line + floor_clause(corners, std::abs(left - right)) + head_clause(summary, corners) +
         "\n";
}

/// Of the greatest excursion: "9.7 to 7.9 mm, 1.8 mm less (+- 0.2)"; `band`: not a number where it
/// is not known.
std::string change_text(double from, double to, double band) {
  const double change = to - from;
  if (std::abs(change) < 0.05) return fmt::format("{:.1f} mm, unchanged", to);
  if (std::abs(change) < band)
    return fmt::format("{:.1f} to {:.1f} mm, undecided (+- {:.1f})", from, to, band);
  return fmt::format("{:.1f} to {:.1f} mm, {:.1f} mm {}", from, to, std::abs(change),
                     change < 0 ? "less" : "more") +
         (std::isnan(band) ? "" : fmt::format(" (+- {:.1f})", band));
}

/// Where the greatest excursions differ by much less than the paths do: "; up to 3.7 mm from base
/// at 1.93 s".
std::string path_text(double change, double band, double from_base_mm, double time_s) {
  const double least = std::fmax(0.3, std::isnan(band) ? 0 : band);
  if (!(from_base_mm > least) || from_base_mm < 1.5 * std::abs(change)) return "";
  return fmt::format(", but up to {:.1f} mm from base at {:.2f} s", from_base_mm, time_s);
}

/// What each variant makes of the corners of the mouth, a line each.
std::string variant_lines(const nlohmann::ordered_json& summary) {
  std::string lines;
  if (!summary.contains("variants")) return lines;
  const auto& table = summary["variants"]["table"];
  for (std::size_t i = 1; i < table.size(); ++i) {
    const auto side = [&](const std::string& corner) {
      const auto &from = table[0][corner + "_mm"], &to = table[i][corner + "_mm"],
                 &band = table[i][corner + "_band_mm"];
      if (!from.is_number() || !to.is_number()) return std::string("not known");
      const double before = from.get<double>(), now = to.get<double>();
      const double band_mm = band.is_number() ? band.get<double>() : std::nan("");
      return change_text(before, now, band_mm) +
             path_text(now - before, band_mm,
                       number_in(table[i], (corner + "_from_base_mm").c_str()),
                       number_in(table[i], (corner + "_from_base_s").c_str()));
    };
    lines += fmt::format("  {}: corner of the mouth left {}; right {}\n",
                         table[i]["name"].get<std::string>(), side("commissure_L"),
                         side("commissure_R"));
  }
  if (!lines.empty())
    lines +=
        "  (each corner's greatest distance from rest; +-: what one other mesh and 95 % of the "
        "recording's jitter could make)\n";
  return lines;
}

void run(const RunOptions& options) {
  take_library_memory();
  auto overrides = options.overrides;
  if (options.verify) overrides.push_back("solver.verify=true");
  scene::Scene scene = scene::read_scene(options.scene, overrides);
  if (options.no_variants) scene.variants.clear();
  if (!options.no_cache) scene.kept = KeptResults(user_cache_folder());
  const auto summary = run::run_scene(scene, options.out);
  std::cout << fmt::format(
      "{} frames, {} steps, largest displacement {:.1f} mm, lips {:.1f} mm apart, {:.1f} s in all\n"
      "{}{}{}"
      "written to {}:\n",
      summary["frames"].get<int>(), summary["steps"].get<int>(),
      summary["max_displacement_mm"].get<double>(), summary["lip_opening_mm"].get<double>(),
      summary["seconds"]["total"].get<double>(), solver_line(summary), corners_line(summary),
      variant_lines(summary), printable(options.out.string()));
  const std::pair<const char*, const char*> files[] = {
      {"report.html", "open it in a browser"},
      {"contact_sheet.png", "the face at a glance"},
      {"performance.glb", "Blender, three.js"},
      {"frames.pvd", "ParaView"},
      {"skin_peak.ply", "the skin at its peak"},
      {"motion.csv", "landmarks over time"},
      {"symmetry.csv", "S(t)"},
      {"variants.png", "where and how far the variants differ"},
      {"variants_symmetry.png", "S(t) of all variants"},
      {"variants.csv", "the variants as a table; each has its folder in variants/"},
      {"variants_excursions.csv",
       "how far each point of either side travels, with and without the change"},
      {"activations.csv", "what the muscles did"},
      {"muscles.png", "where they lie"},
      {"excursions.csv", "how far and how fast either side moves"},
      {"asymmetry.png", "the face against its reflection"},
      {"summary.json", "counts, times, options"}};
  for (const auto& [name, use] : files)
    if (std::filesystem::exists(options.out / name))
      std::cout << fmt::format("  {:<22} {}\n", name, use);
}

}  // namespace

void add_run(CLI::App& program) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command =
      program.add_subcommand("run", "Re-enact a recorded expression on a scanned face");
  command->add_option("SCENE", options->scene, "Scene file (docs/scene.md)")->required();
  command
      ->add_option("--out", options->out,
                   "Folder for the outputs: new, empty, or from an earlier run. It is written "
                   "completely or not at all")
      ->required();
  command->add_option("--set", options->overrides, "Override a key of the scene; can be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_flag("--verify", options->verify,
                    "Run the full model too and report the true error of the reduced one");
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
