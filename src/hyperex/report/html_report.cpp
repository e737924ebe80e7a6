// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/html_report.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "hyperex/core/files.hpp"
#include "hyperex/report/page_template.hpp"
#include "hyperex/report/skin_view.hpp"

namespace hyperex::report {
namespace {

using Eigen::Index;
using nlohmann::json;
static_assert(std::endian::native == std::endian::little, "the page reads little-endian arrays");

/// One block of bytes that the page decodes once; the manifest says what lies where.
class BinaryBlock {
 public:
  template <typename T>
  json add(const char* type, const T* data, std::size_t count) {
    bytes_.resize((bytes_.size() + 7) / 8 * 8);  // typed arrays need aligned offsets
    const json at = {{"type", type}, {"offset", bytes_.size()}, {"count", count}};
    const auto* first = reinterpret_cast<const std::uint8_t*>(data);
    bytes_.insert(bytes_.end(), first, first + count * sizeof(T));
    return at;
  }
  json add(const std::vector<float>& v) { return add("float32", v.data(), v.size()); }
  json add(const std::vector<int>& v) { return add("int32", v.data(), v.size()); }
  json add(const PointsF& v) { return add("float32", v.data(), v.size()); }
  json add(const std::vector<std::uint8_t>& v) { return add("uint8", v.data(), v.size()); }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

void write_base64(std::ostream& out, const std::vector<std::uint8_t>& bytes) {
  static constexpr char digits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    const unsigned group =
        bytes[i] << 16 | (left > 1 ? bytes[i + 1] << 8 : 0) | (left > 2 ? bytes[i + 2] : 0);
    text += digits[group >> 18 & 63];
    text += digits[group >> 12 & 63];
    text += left > 1 ? digits[group >> 6 & 63] : '=';
    text += left > 2 ? digits[group & 63] : '=';
  }
  out << text;
}

json skin_section(const ReportInput& input, BinaryBlock& block) {
  const auto& performance = input.performance;
  const SkinView view = skin_view(performance, input.scan);
  json skin = {{"points", block.add(PointsF(performance.skin_rest.points.cast<float>()))},
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

/// JSON that may stand inside a script element: "<" only occurs in strings, where its escape means
/// the same and cannot end the element.
std::string script_safe(const json& value) {
  std::string text;
  for (const char c : value.dump(-1, ' ', false, json::error_handler_t::replace)) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  return text;
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
  const std::string manifest = script_safe(manifest_of(input, block));
  const std::string_view page = page_template();
  const auto at = page.find(data_mark);
  if (at == std::string_view::npos)
    throw std::logic_error("write_html_report: the page has no place for the data");
  write_file_atomically(file, [&](std::ostream& out) {
    out << page.substr(0, at) << "<script id=\"hyperex-manifest\" type=\"application/json\">"
        << manifest << "</script>\n"
        << "<script id=\"hyperex-binary\" type=\"application/octet-stream;base64\">";
    write_base64(out, block.bytes());
    out << "</script>\n" << page.substr(at + data_mark.size());
  });
}

}  // namespace hyperex::report
