// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/html_report.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "hyperex/face/point_words.hpp"
#include "hyperex/metrics/variant_difference.hpp"
#include "hyperex/report/geometry_sections.hpp"
#include "hyperex/report/page_data.hpp"
#include "hyperex/report/page_template.hpp"
#include "hyperex/simulate/load/known_activation.hpp"

namespace hyperex::report {
namespace {

using Eigen::Index;
using nlohmann::json;

json motion_section(const ReportInput& input, BinaryBlock& block) {
  json motion = modes_section(input.modes, block);
  motion["time_s"] = input.performance.frame_time_s;
  motion["peak_frame"] = input.performance.peak_frame;
  motion["max_displacement_mm"] =
      1e3 * metrics::greatest_displacement_m(input.performance.skin_displacement_m);
  if (json gaze = gaze_section(input.performance, block); !gaze.is_null())
    motion["gaze"] = std::move(gaze);
  return motion;
}

json symmetry_section(const metrics::SymmetryCurve* curve) {
  if (!curve) return nullptr;
  return {{"time_s", curve->time_s},
          {"xi_left", curve->xi_left},
          {"xi_right", curve->xi_right},
          {"s", curve->s},
          {"floor", curve->floor},
          {"noise", curve->floors()},
          {"jitter_noise", curve->noise},
          {"mesh_noise", curve->mesh_noise},
          {"jitter_mm", 1e3 * curve->jitter_m}};
}

json map_section(const SkinMap& map, BinaryBlock& block) {
  const double span = map.greatest - map.least;
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(map.values.size()));
  std::transform(map.values.begin(), map.values.end(), bytes.begin(), [&](double value) {
    const double share = span > 0 ? (value - map.least) / span : 0;
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0., 1.)));
  });
  return {{"key", map.key},     {"name", map.name},         {"unit", map.unit},
          {"least", map.least}, {"greatest", map.greatest}, {"values", block.add(bytes)}};
}

json tissue_section(const std::vector<SkinMap>& maps, BinaryBlock& block) {
  json section = json::array();
  for (const SkinMap& map : maps) section.push_back(map_section(map, block));
  return section;
}

/// A row of `course` in four digits: a page of a long recording stays small.
std::vector<double> row_of(const Eigen::MatrixXd& course, Index row) {
  std::vector<double> values;
  for (Index k = 0; k < course.cols(); ++k)
    values.push_back(std::round(1e4 * course(row, k)) / 1e4);
  return values;
}

/// Rows of the left and the right of each group that has both, of names that end in _L and _R.
std::vector<std::pair<Index, Index>> pairs_of(const std::vector<std::string>& groups) {
  std::vector<std::pair<Index, Index>> pairs;
  for (std::size_t l = 0; l < groups.size(); ++l) {
    const std::string& name = groups[l];
    if (!name.ends_with("_L")) continue;
    const auto found =
        std::find(groups.begin(), groups.end(), name.substr(0, name.size() - 1) + "R");
    if (found != groups.end()) pairs.emplace_back(Index(l), found - groups.begin());
  }
  return pairs;
}

json muscle_groups(const simulate::MuscleCourse& muscles) {
  json groups = json::array();
  for (const auto& [left, right] : pairs_of(muscles.groups)) {
    const std::string& name = muscles.groups[std::size_t(left)];
    json group = {{"name", name.substr(0, name.size() - 2)}};
    const auto add = [&](const char* side, Index row) {
      Index most = 0;
      if (muscles.group_activation.cols() > 0)
        muscles.group_activation.row(row).cwiseAbs().maxCoeff(&most);
      group[side] = row_of(muscles.group_activation, row);
      group[std::string("sigma_") + side] = muscles.group_sigma(row, most);
      group[std::string("note_") + side] = simulate::group_words(muscles, row, most);
    };
    add("left", left);
    add("right", right);
    groups.push_back(std::move(group));
  }
  return groups;
}

/// A variant's activations, of the groups of the scene's own muscle_groups() in their order.
json variant_muscles(const std::vector<std::string>& groups, const Eigen::MatrixXd& activation) {
  json out = json::array();
  if (activation.rows() != Index(groups.size()) || activation.cols() == 0) return out;
  for (const auto& [left, right] : pairs_of(groups))
    out.push_back({{"left", row_of(activation, left)}, {"right", row_of(activation, right)}});
  return out;
}

/// For each line a text with one character per sample of the scene's own muscles: 1 where the
/// recording distinguishes the muscle's activation from 0, else 0. The text is empty for a muscle
/// that `course` lacks, and there are no texts where `course` has other samples.
json active_muscles(const ReportInput& input, const simulate::MuscleCourse& course) {
  json texts = json::array();
  const auto samples = Index(input.performance.muscles.time_s.size());
  if (course.time_s != input.performance.muscles.time_s) return texts;
  if (course.activation.cols() != samples || course.sigma.cols() != samples) return texts;
  for (const ReportMuscle& line : input.muscles) {
    const auto found = std::find(course.names.begin(), course.names.end(), line.name);
    std::string text;
    for (Index k = 0; found != course.names.end() && k < samples; ++k) {
      const auto row = Index(found - course.names.begin());
      text +=
          simulate::differs_from_zero(course.activation(row, k), course.sigma(row, k)) ? '1' : '0';
    }
    texts.push_back(text);
  }
  return texts;
}

json variants_section(const ReportInput& input, BinaryBlock& block) {
  const auto& own = input.performance.skin_displacement_m;
  json section = json::array();
  for (const ReportVariant& variant : input.variants) {
    const auto& displacement = variant.performance.skin_displacement_m;
    double difference_m = 0;
    std::size_t most = 0;
    for (std::size_t f = 0; f < own.size(); ++f) {
      const double here_m =
          own[f].rows() ? double((displacement[f] - own[f]).rowwise().norm().maxCoeff()) : 0;
      if (here_m <= difference_m) continue;
      difference_m = here_m;
      most = f;
    }
    section.push_back(
        {{"name", variant.name},
         {"changes", variant.changes},
         {"difference", modes_section(variant.difference, block)},
         {"max_displacement_mm", 1e3 * metrics::greatest_displacement_m(displacement)},
         {"max_difference_mm", 1e3 * difference_m},
         {"max_difference_frame", most},
         {"symmetry", symmetry_section(variant.symmetry)},
         {"landmarks", positions_of(variant.performance.landmarks, block)},
         {"muscles", variant_muscles(input.performance.muscles.groups, variant.group_activation)},
         {"active_muscles", active_muscles(input, variant.performance.muscles)},
         {"tissue", tissue_section(variant.tissue, block)}});
  }
  return section;
}

json points_json(const Points& points) {
  json rows = json::array();
  for (Index i = 0; i < points.rows(); ++i)
    rows.push_back({points(i, 0), points(i, 1), points(i, 2)});
  return rows;
}

json landmark_section(const motion::Motion& landmarks, BinaryBlock& block) {
  return {{"names", landmarks.names},
          {"time_s", landmarks.time_s},
          {"positions", positions_of(landmarks, block)}};
}

/// The plain names of all points that the page names: landmarks, and pairs of the excursions.
json point_words_of(const ReportInput& input) {
  json words = json::object();
  const auto add = [&](const std::string& name) { words[name] = face::point_words(name); };
  for (const std::string& name : input.performance.landmarks.names) add(name);
  for (const std::string& name : input.performance.driven_names) add(name);
  const auto pairs = json::json_pointer("/symmetry/excursions");
  if (input.summary.contains(pairs))
    for (const json& pair : input.summary.at(pairs)) add(pair.value("point", std::string()));
  return words;
}

json muscle_section(const ReportInput& input) {
  const simulate::MuscleCourse& muscles = input.performance.muscles;
  json lines = json::array();
  for (const ReportMuscle& muscle : input.muscles) {
    lines.push_back(
        {{"name", muscle.name}, {"latin", muscle.latin}, {"points", points_json(muscle.line)}});
    if (muscle.sheet.rows() > 0) lines.back()["sheet"] = points_json(muscle.sheet);
  }
  return {{"time_s", muscles.time_s},
          {"few_points", muscles.few_points},
          {"groups", muscle_groups(muscles)},
          {"lines", lines},
          {"active", active_muscles(input, muscles)}};
}

json report_manifest(const ReportInput& input, BinaryBlock& block, bool face) {
  const auto& performance = input.performance;
  json manifest = {{"version", 1},
                   {"title", input.title},
                   {"notes", input.notes},
                   {"summary", input.summary.is_object() ? input.summary : json::object()},
                   {"point_words", point_words_of(input)},
                   {"scan_vertices", performance.scan_vertices},
                   {"motion", motion_section(input, block)},
                   {"landmarks", landmark_section(performance.landmarks, block)},
                   {"driven",
                    {{"names", performance.driven_names},
                     {"points", points_json(performance.driven_points_rest)}}},
                   {"held", points_json(performance.held_points_rest)},
                   {"lip_cut", points_json(performance.lip_cut_rest)},
                   {"symmetry", symmetry_section(input.symmetry)},
                   {"tissue", tissue_section(input.tissue, block)},
                   {"variants", variants_section(input, block)}};
  if (input.uncertainty.values.size() > 0)
    manifest["uncertainty"] = map_section(input.uncertainty, block);
  if (!performance.muscles.names.empty()) manifest["muscles"] = muscle_section(input);
  if (input.teeth) {
    manifest["motion"]["jaw"] = jaw_section(performance, block);
    manifest["motion"]["upper_teeth"] = upper_teeth_section(performance);
    for (std::size_t i = 0; i < input.variants.size(); ++i) {
      manifest["variants"][i]["jaw"] = jaw_section(input.variants[i].performance, block);
      manifest["variants"][i]["upper_teeth"] = upper_teeth_section(input.variants[i].performance);
    }
  }
  if (!face) return manifest;
  manifest["skin"] = skin_section(input, block);
  const Vec3 forward = add_backing(input, block, manifest);
  if (input.mirror) manifest["mirror"] = mirror_section(*input.mirror, block);
  if (input.teeth) manifest["teeth"] = teeth_section(*input.teeth, forward, block);
  return manifest;
}

void check_input(const ReportInput& input) {
  const auto& performance = input.performance;
  const auto frames = performance.frame_time_s.size();
  const Index vertices = performance.skin_rest.points.rows();
  const auto fits = [&](const simulate::Performance& of, const DisplacementModes& modes) {
    return of.skin_displacement_m.size() == frames &&
           static_cast<std::size_t>(modes.weights.rows()) == frames &&
           (modes.modes.empty() || modes.modes[0].rows() == vertices) &&
           (!input.teeth || of.jaw_now_from_rest.size() == frames) &&
           (of.gaze.empty() || of.gaze.size() == frames) &&
           of.landmarks.names == performance.landmarks.names &&
           of.landmarks.time_s.size() == performance.landmarks.time_s.size();
  };
  if (!fits(performance, input.modes))
    throw std::invalid_argument("write_html_report: performance and modes do not belong together");
  const auto map_fits = [&](const SkinMap& map) { return map.values.size() == vertices; };
  if (input.mirror && Index(input.mirror->pairs.found.size()) != vertices)
    throw std::invalid_argument("write_html_report: counterparts of another surface");
  bool all = std::all_of(input.tissue.begin(), input.tissue.end(), map_fits) &&
             (input.uncertainty.values.size() == 0 || map_fits(input.uncertainty));
  for (const ReportVariant& variant : input.variants)
    all = all && fits(variant.performance, variant.difference) &&
          variant.tissue.size() == input.tissue.size() &&
          std::all_of(variant.tissue.begin(), variant.tissue.end(), map_fits);
  if (!all)
    throw std::invalid_argument("write_html_report: a variant does not belong to the scene's run");
}

}  // namespace

nlohmann::json replay_manifest(const ReportInput& input, BinaryBlock& block, bool face) {
  check_input(input);
  json manifest = report_manifest(input, block, face);
  manifest["palette"] = palette();
  return manifest;
}

void write_html_report(const std::filesystem::path& file, const ReportInput& input) {
  check_input(input);
  BinaryBlock block;
  const json manifest = report_manifest(input, block, true);
  write_page(file, page_template(Page::replay), manifest, block);
}

}  // namespace hyperex::report
