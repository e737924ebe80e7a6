// SPDX-License-Identifier: GPL-3.0-or-later
// write_report_fixtures FOLDER: reports and models of the made-up face and pages of its tracking,
// for the tests in web/tests.
#include <filesystem>
#include <iostream>
#include <tuple>

#include "hyperex/report/glb.hpp"
#include "hyperex/report/html_report.hpp"
#include "hyperex/report/tracked_glb.hpp"
#include "hyperex/report/tracking_page.hpp"
#include "unit/report/made_up_face.hpp"
#include "unit/report/made_up_tracking.hpp"

namespace {
using namespace hyperex::report;

void write_variants_page(const std::filesystem::path& folder) {
  const auto face = testing::made_up_face(testing::Surface::plain);
  const auto modes = displacement_modes(face.performance.skin_displacement_m);
  std::vector<testing::MadeUpVariant> made;
  for (int i = 0; i < testing::made_up_variants; ++i)
    made.push_back(testing::made_up_variant(face, i));
  ReportInput input{face.performance, face.scan, modes, &face.symmetry};
  input.title = "A made-up face, variants";
  input.tissue = testing::made_up_tissue(face);
  input.uncertainty = testing::made_up_uncertainty(face);
  const auto mirror = testing::made_up_mirror(face);
  input.mirror = &mirror;
  nlohmann::json table = nlohmann::json::array();
  const auto row = [&](const std::string& name, double share) {
    table.push_back({{"name", name},
                     {"greatest_displacement_mm", 25 * share},
                     {"greatest_distance_mm", 25 * (1 - share)},
                     {"rms_distance_at_peak_mm", 12 * (1 - share)},
                     {"displacement_there_mm", 20 * share},
                     {"base_displacement_there_mm", 20},
                     {"farthest_near", share < 1 ? "cheilion_R" : ""},
                     {"mean_change_at_peak_mm", -10 * (1 - share)},
                     {"mean_displacement_L_mm", 5},
                     {"mean_displacement_R_mm", 5 * share},
                     {"asymmetry_rms_mm", 3 * (1 - share)},
                     {"added_xi_difference", 0.1 * (1 - share)},
                     {"share_within_25_mm_of_mouth",
                      share < 1 ? nlohmann::json(0.25) : nlohmann::json(nullptr)},
                     {"lag_ms", 1.5 / share},
                     {"hysteresis", 0.01},
                     {"symmetry_integral_s", 0.02 * (2 - share)}});
  };
  row("base", 1);
  for (const auto& variant : made) {
    input.variants.push_back(testing::reported(face, variant));
    row(variant.name, variant.name == "the same again" ? 1 : 0.8);
    table.back()["changes"] = {{"tissue.region", {{{"name", "cheek_R"}, {"young_factor", 10}}}}};
    table.back()["inverted_tets"] = 0;
  }
  input.summary = {
      {"title", "variants"},
      {"variants",
       {{"driven_point", "ibug68_8"}, {"response_point", "cheilion_L"}, {"table", table}}}};
  write_html_report(folder / "variants.html", input);
}
}  // namespace

int main(int argc, char** argv) {
  using namespace hyperex::report;
  using testing::Surface;
  if (argc != 2) {
    std::cerr << "usage: write_report_fixtures FOLDER\n";
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  for (const auto& [name, surface] : {std::pair{"plain", Surface::plain},
                                      {"coloured", Surface::coloured},
                                      {"textured", Surface::textured}}) {
    const auto face = testing::made_up_face(surface);
    const auto modes = displacement_modes(face.performance.skin_displacement_m);
    const auto teeth = testing::made_up_teeth();
    const auto* shown = surface == Surface::coloured ? &teeth : nullptr;
    auto seeing = face.performance;
    if (shown) testing::add_inner_eye_corners(seeing);
    write_glb(folder / (std::string(name) + ".glb"), seeing, face.scan, {.teeth = shown});
    const nlohmann::json summary = {
        {"title", "made-up face"},
        {"dt_s", 0.002},
        {"frames", face.performance.frame_time_s.size()},
        {"seconds", {{"mesh", 1.25}, {"simulate", 12.5}}},
        {"mesh_quality", {{"dihedral_deg", {{"least", 8.1}, {"most", 163.2}}}}}};
    ReportInput input{face.performance, face.scan, modes, &face.symmetry, summary};
    input.notes = {"The lips of the scan were joined and were cut along the line shown."};
    input.title = std::string("A made-up face, ") + name;
    input.teeth = shown;
    write_html_report(folder / (std::string(name) + ".html"), input);
  }
  for (const auto& [name, frames, with_depth] :
       {std::tuple{"tracking", 2000, true}, std::tuple{"tracking_colour_only", 90, false}})
    write_tracking_page(folder / (std::string(name) + ".html"),
                        {hyperex::expression::canonical_model(),
                         testing::made_up_tracking(frames, with_depth),
                         "recordings/made-up face/",
                         92,
                         {"A sentence of the source."}});
  write_variants_page(folder);
  write_tracked_glb(folder / "tracked.glb", hyperex::expression::canonical_model(),
                    testing::made_up_tracking(90), {500, 500, 320, 240, 640, 480});
  return 0;
}
