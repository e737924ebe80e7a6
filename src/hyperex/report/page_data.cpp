// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/page_data.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <stdexcept>
#include <string>

#include "hyperex/core/files.hpp"
#include "hyperex/render/time_plot.hpp"
#include "hyperex/report/page_template.hpp"

namespace hyperex::report {
namespace {

using nlohmann::json;
static_assert(std::endian::native == std::endian::little, "the page reads little-endian arrays");

/// JSON that is safe inside a script element: "<" only occurs in strings, where its escape means
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

}  // namespace

std::string base64(const std::vector<std::uint8_t>& bytes) {
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
  return text;
}

json palette() {
  const auto all = [](bool dark) {
    json list = json::array();
    for (std::size_t i = 0; i < render::category_count; ++i) {
      const render::Colour c = render::category_colour(i, dark);
      const auto byte = [](double share) { return int(std::lround(255 * share)); };
      list.push_back(fmt::format("#{:02x}{:02x}{:02x}", byte(c.r), byte(c.g), byte(c.b)));
    }
    return list;
  };
  json faces = json::array();
  for (std::size_t i = 0; i < render::category_count; ++i)
    faces.push_back(render::face_category(i));
  return {{"light", all(false)},
          {"dark", all(true)},
          {"left", render::left_category},
          {"right", render::right_category},
          {"faces", faces}};
}

void write_page(const std::filesystem::path& file, std::string_view page, json manifest,
                const BinaryBlock& block) {
  manifest["palette"] = palette();
  const std::string text = script_safe(manifest);
  const auto at = page.find(data_mark);
  if (at == std::string_view::npos)
    throw std::logic_error("write_page: the page has no place for the data");
  write_file_atomically(file, [&](std::ostream& out) {
    out << page.substr(0, at) << "<script id=\"hyperex-manifest\" type=\"application/json\">"
        << text << "</script>\n"
        << "<script id=\"hyperex-binary\" type=\"application/octet-stream;base64\">";
    out << base64(block.bytes()) << "</script>\n" << page.substr(at + data_mark.size());
  });
}

}  // namespace hyperex::report
