// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/html_report.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "hyperex/report/page_data.hpp"
#include "hyperex/report/page_template.hpp"
#include "hyperex/report/skin_view.hpp"

namespace hyperex::report {
namespace {

using Eigen::Index;
using nlohmann::json;

json points_at(const PointsF& points, BinaryBlock& block) {
  return block.add("float32", points.data(), points.size());
}

json skin_section(const ReportInput& input, BinaryBlock& block) {
  const auto& performance = input.performance;
  const SkinView view = skin_view(performance, input.scan);
  json skin = {{"points", points_at(performance.skin_rest.points.cast<float>(), block)},
               {"triangles", block.add("int32", performance.skin_rest.triangles.data(),
                                       performance.skin_rest.triangles.size())}};
  if (view.uv.rows() > 0) {
    skin["texture"] = {
        {"mime_type", input.scan.texture->mime_type},
        {"image", block.add(input.scan.texture->bytes)},
        {"uv", block.add("float32", view.uv.data(), view.uv.size())},
        {"skin_vertex", block.add(view.skin_vertex)},
        {"triangles", block.add("int32", view.triangles.data(), view.triangles.size())}};
  } else if (const auto colour = skin_colour(performance, input.scan); colour.rows() > 0) {
    skin["colour"] = block.add("uint8", colour.data(), colour.size());
  }
  return skin;
}

json motion_section(const ReportInput& input, BinaryBlock& block) {
  json modes = json::array();
  for (const auto& mode : input.modes.modes) {
    const float largest = mode.cwiseAbs().maxCoeff();
    const float step_m = largest > 0 ? largest / 32767 : 1;
    std::vector<std::int16_t> steps(mode.size());
    std::transform(mode.data(), mode.data() + mode.size(), steps.begin(), [&](float value) {
      return static_cast<std::int16_t>(std::lround(value / step_m));
    });
    modes.push_back(
        {{"step_m", step_m}, {"values", block.add("int16", steps.data(), steps.size())}});
  }
  using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const RowMajor weights = input.modes.weights;
  double largest_m = 0;
  for (const auto& frame : input.performance.skin_displacement_m)
    largest_m = std::max<double>(largest_m, frame.rows() ? frame.rowwise().norm().maxCoeff() : 0);
  return {{"time_s", input.performance.frame_time_s},
          {"peak_frame", input.performance.peak_frame},
          {"modes", modes},
          {"weights", block.add("float32", weights.data(), weights.size())},
          {"max_error_mm", 1e3 * input.modes.max_error_m},
          {"max_displacement_mm", 1e3 * largest_m}};
}

json landmark_section(const motion::Motion& landmarks, BinaryBlock& block) {
  std::vector<float> values;  // N x P x 3
  for (const auto& frame : landmarks.positions)
    for (Index i = 0; i < frame.size(); ++i) values.push_back(static_cast<float>(frame.data()[i]));
  return {
      {"names", landmarks.names}, {"time_s", landmarks.time_s}, {"positions", block.add(values)}};
}

json points_json(const Points& points) {
  json rows = json::array();
  for (Index i = 0; i < points.rows(); ++i)
    rows.push_back({points(i, 0), points(i, 1), points(i, 2)});
  return rows;
}

json manifest_of(const ReportInput& input, BinaryBlock& block) {
  const auto& performance = input.performance;
  json manifest = {{"version", 1},
                   {"title", input.title},
                   {"notes", input.notes},
                   {"summary", input.summary.is_object() ? input.summary : json::object()},
                   {"scan_vertices", performance.scan_vertices},
                   {"skin", skin_section(input, block)},
                   {"motion", motion_section(input, block)},
                   {"landmarks", landmark_section(performance.landmarks, block)},
                   {"driven",
                    {{"names", performance.driven_names},
                     {"points", points_json(performance.driven_points_rest)}}},
                   {"held", points_json(performance.held_points_rest)},
                   {"lip_cut", points_json(performance.lip_cut_rest)},
                   {"symmetry", nullptr}};
  if (input.symmetry)
    manifest["symmetry"] = {{"time_s", input.symmetry->time_s},
                            {"xi_left", input.symmetry->xi_left},
                            {"xi_right", input.symmetry->xi_right},
                            {"s", input.symmetry->s},
                            {"floor", input.symmetry->floor}};
  return manifest;
}

void check(const ReportInput& input) {
  const auto& performance = input.performance;
  const auto frames = performance.frame_time_s.size();
  if (performance.skin_displacement_m.size() != frames ||
      static_cast<std::size_t>(input.modes.weights.rows()) != frames ||
      (!input.modes.modes.empty() &&
       input.modes.modes[0].rows() != performance.skin_rest.points.rows()))
    throw std::invalid_argument("write_html_report: performance and modes do not belong together");
}

}  // namespace

void write_html_report(const std::filesystem::path& file, const ReportInput& input) {
  check(input);
  BinaryBlock block;
  const json manifest = manifest_of(input, block);
  write_page(file, page_template(Page::replay), manifest, block);
}

}  // namespace hyperex::report
