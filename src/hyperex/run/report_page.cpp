// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/report_page.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hyperex/core/printable.hpp"
#include "hyperex/core/run_together.hpp"
#include "hyperex/muscles/muscle_lines.hpp"
#include "hyperex/muscles/muscle_shapes.hpp"
#include "hyperex/scene/file_names.hpp"
#include "hyperex/simulate/load/held_load.hpp"

namespace hyperex::run {
namespace {
using nlohmann::json;

std::string text_of(const json& value) {
  if (value.is_string()) return value.get<std::string>();
  std::string text;
  const auto append = [&](const std::string& part, const char* between) {
    text += (text.empty() ? "" : between) + part;
  };
  if (value.is_object())
    for (const auto& [key, item] : value.items()) append(key + " = " + text_of(item), ", ");
  else if (value.is_array())
    for (const json& item : value) append(text_of(item), item.is_object() ? "; " : ", ");
  else
    text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  return text;
}

/// The values of a parameter at the vertices of a face, in the unit of scene files.
Eigen::VectorXd values_of(const scene::Scene& scene, const tissue::TissueField* field,
                          int parameter, Eigen::Index vertices) {
  const double si = tissue::parameter_info(parameter).si;
  if (field) return field->skin[parameter] / si;
  return Eigen::VectorXd::Constant(vertices, uniform_parameters(scene.tissue)[parameter] / si);
}

/// Maps of the parameters that differ from place to place in any face: a list of the same keys for
/// base, first, and for each variant.
std::vector<std::vector<report::SkinMap>> tissue_maps(const Results& r,
                                                      const std::vector<VariantRun>& variants) {
  std::vector<std::vector<report::SkinMap>> faces(1 + variants.size());
  for (int q = 0; q < tissue::parameter_count; ++q) {
    const auto varies = [&](const tissue::TissueField* field) { return field && field->varies(q); };
    bool any = varies(r.tissue);
    for (const VariantRun& run : variants) any = any || varies(run.field ? &*run.field : nullptr);
    if (!any) continue;
    const tissue::ParameterInfo& info = tissue::parameter_info(q);
    const std::string title = info.title;  // "Young's modulus (kPa)"
    const auto bracket = title.find(" (");
    report::SkinMap map{.key = info.key, .name = title.substr(0, bracket)};
    if (bracket != title.npos) map.unit = title.substr(bracket + 2, title.size() - bracket - 3);
    map.least = INFINITY;
    map.greatest = -INFINITY;
    const Eigen::Index vertices = r.simulation.performance.skin_rest.points.rows();
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const VariantRun* run = f > 0 ? &variants[f - 1] : nullptr;
      const tissue::TissueField* field = run ? (run->field ? &*run->field : nullptr) : r.tissue;
      map.values = values_of(run ? run->scene : r.scene, field, q, vertices);
      map.least = std::min(map.least, map.values.minCoeff());
      map.greatest = std::max(map.greatest, map.values.maxCoeff());
      faces[f].push_back(map);
    }
    for (auto& maps : faces) {
      maps.back().least = map.least;
      maps.back().greatest = map.greatest;
    }
  }
  return faces;
}

report::SkinMap uncertainty_map(const Results& r) {
  report::SkinMap map{.key = "uncertainty", .name = "Expected error", .unit = "mm"};
  if (!r.uncertainty) return map;
  map.values = r.uncertainty->distance_mm.cast<double>();
  map.greatest = map.values.maxCoeff();
  return map;
}

report::DisplacementModes difference_of(const simulate::Performance& run,
                                        const simulate::Performance& base) {
  std::vector<PointsF> difference;
  for (std::size_t f = 0; f < base.skin_displacement_m.size(); ++f)
    difference.push_back(run.skin_displacement_m[f] - base.skin_displacement_m[f]);
  return report::displacement_modes(difference);
}

std::vector<report::ReportMuscle> muscles_of(const Results& r) {
  std::vector<report::ReportMuscle> muscles;
  if (r.simulation.performance.muscles.names.empty()) return muscles;
  const muscles::MuscleTable table = r.scene.muscles.table();
  const auto lines = muscles::muscle_lines(table, r.mesh, r.inputs.landmarks);
  auto shapes = muscles::muscle_shapes(lines, table, r.mesh, r.inputs.landmarks);
  for (std::size_t m = 0; m < lines.size(); ++m)
    muscles.push_back({lines[m].name, table[std::size_t(lines[m].row)].latin,
                       std::move(shapes[m].line), std::move(shapes[m].sheet)});
  return muscles;
}

/// The scene's own, or what was moved by what.
std::string title_of(const Results& r) {
  if (!r.scene.title.empty()) return r.scene.title;
  std::filesystem::path recording(r.inputs.motion.motion.source);
  if (!recording.has_filename()) recording = recording.parent_path();
  return printable(fmt::format("{}, moved by {}", r.inputs.scan.file.filename().string(),
                               recording.filename().string()));
}

}  // namespace

std::vector<std::string> change_texts(const json& changes) {
  std::vector<std::string> texts;
  for (const auto& [key, value] : changes.items())
    texts.push_back(key + (value.is_structured() ? ": " : " = ") + text_of(value));
  return texts;
}

ReplayPage::ReplayPage(const Results& r, const std::vector<VariantRun>& variants, json summary)
    : input_{.performance = r.simulation.performance,
             .scan = r.inputs.scan,
             .modes = r.modes,
             .symmetry = &r.symmetry.curve,
             .summary = std::move(summary),
             .notes = texts_of(r.notes),
             .title = title_of(r),
             .tissue = {},
             .uncertainty = uncertainty_map(r),
             .variants = {},
             .mirror = &*r.symmetry.map,
             .muscles = muscles_of(r),
             .teeth = r.teeth,
             .backing = r.backing,
             .skin_tone = r.scene.output.skin_tone} {
  const simulate::Performance& p = r.simulation.performance;
  auto tissue = tissue_maps(r, variants);
  input_.tissue = std::move(tissue.front());
  std::vector<report::DisplacementModes> differences(variants.size());
  run_each(variants.size(), [&](std::size_t i) {
    differences[i] = difference_of(variants[i].simulation.performance, p);
  });
  for (std::size_t i = 0; i < variants.size(); ++i)
    input_.variants.push_back(
        {.name = variants[i].scene.title,
         .changes = change_texts(scene::echoed_changes(r.scene, r.scene.variants[i].changes)),
         .performance = variants[i].simulation.performance,
         .difference = std::move(differences[i]),
         .symmetry = &variants[i].symmetry.curve,
         .tissue = std::move(tissue[i + 1]),
         .group_activation = simulate::group_sums(variants[i].simulation.performance.muscles,
                                                  p.muscles.groups, r.scene.muscles.table())});
}

void write_report(const Results& r, const std::vector<VariantRun>& variants,
                  const nlohmann::ordered_json& summary, const std::filesystem::path& directory) {
  report::write_html_report(directory / "report.html",
                            ReplayPage(r, variants, json(summary)).input());
}

}  // namespace hyperex::run
