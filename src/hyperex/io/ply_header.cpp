// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/io/ply_header.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <utility>

#include "hyperex/core/error.hpp"
#include "hyperex/io/number.hpp"

namespace hyperex::io {
namespace {

std::optional<PlyType> type_named(std::string_view name) {
  using enum PlyType;
  constexpr std::array<std::pair<std::string_view, PlyType>, 16> names{{{"char", int8},
                                                                        {"uchar", uint8},
                                                                        {"short", int16},
                                                                        {"ushort", uint16},
                                                                        {"int", int32},
                                                                        {"uint", uint32},
                                                                        {"float", float32},
                                                                        {"double", float64},
                                                                        {"int8", int8},
                                                                        {"uint8", uint8},
                                                                        {"int16", int16},
                                                                        {"uint16", uint16},
                                                                        {"int32", int32},
                                                                        {"uint32", uint32},
                                                                        {"float32", float32},
                                                                        {"float64", float64}}};
  for (const auto& [known, type] : names)
    if (name == known) return type;
  return std::nullopt;
}

/// Reads the header line by line.
class HeaderReader {
 public:
  HeaderReader(const std::filesystem::path& file, const std::string& bytes)
      : file_(file), bytes_(bytes) {}

  PlyHeader read() {
    std::string_view line;
    if (!next(line) || trimmed(line) != "ply")
      throw InputError(file_, "is no PLY file; expected its first line to be \"ply\"");
    bool has_format = false;
    while (next(line)) {
      const auto word = words(line);
      if (word.empty() || word[0] == "obj_info") continue;
      if (word[0] == "end_header") {
        if (!has_format) fail("end_header", "a line \"format ...\" before it");
        header_.bytes = at_;
        return std::move(header_);
      }
      if (word[0] == "format") {
        read_format(line, word);
        has_format = true;
      } else if (word[0] == "comment") {
        read_comment(line, word);
      } else if (word[0] == "element") {
        read_element(line, word);
      } else if (word[0] == "property") {
        read_property(line, word);
      } else {
        fail(line, "format, comment, obj_info, element, property or end_header");
      }
    }
    throw InputError(file_, fmt::format("is torn: its header ends at line {} without "
                                        "\"end_header\"",
                                        header_.lines));
  }

 private:
  /// Only "\n" ends a header line, because a binary body after "end_header\n" may begin with any
  /// byte.
  bool next(std::string_view& line) {
    const auto end = bytes_.find('\n', at_);
    if (end == std::string::npos) return false;
    line = std::string_view(bytes_).substr(at_, end - at_);
    at_ = end + 1;
    ++header_.lines;
    return true;
  }

  [[noreturn]] void fail(std::string_view found, const std::string& expected) const {
    throw InputError({file_, header_.lines, "", quotable(trimmed(found)), expected});
  }

  void read_format(std::string_view line, const std::vector<std::string_view>& word) {
    using enum PlyHeader::Format;
    if (word.size() >= 2 && word[1] == "ascii")
      header_.format = ascii;
    else if (word.size() >= 2 && word[1] == "binary_little_endian")
      header_.format = binary_little_endian;
    else if (word.size() >= 2 && word[1] == "binary_big_endian")
      header_.format = binary_big_endian;
    else
      fail(line, "ascii, binary_little_endian or binary_big_endian");
  }

  void read_comment(std::string_view line, const std::vector<std::string_view>& word) {
    if (word.size() < 3 || word[1] != "TextureFile" || !header_.texture_file.empty()) return;
    // A file name may contain blanks.
    header_.texture_file = trimmed(line.substr(word[2].data() - line.data()));
  }

  void read_element(std::string_view line, const std::vector<std::string_view>& word) {
    const auto count = word.size() == 3 ? parse_integer(word[2]) : std::nullopt;
    if (!count || *count < 0) fail(line, "\"element NAME COUNT\", COUNT a whole number, 0 or more");
    header_.elements.push_back({std::string(word[1]), *count, {}});
  }

  void read_property(std::string_view line, const std::vector<std::string_view>& word) {
    if (header_.elements.empty()) fail(line, "an element before its properties");
    const bool is_list = word.size() == 5 && word[1] == "list";
    if (!is_list && word.size() != 3)
      fail(line, "\"property TYPE NAME\" or \"property list TYPE TYPE NAME\"");
    PlyProperty property;
    property.is_list = is_list;
    property.name = word.back();
    property.type = type(line, word[word.size() - 2]);
    if (is_list) {
      property.count_type = type(line, word[2]);
      if (property.count_type >= PlyType::float32) fail(line, "a whole-number type for a length");
    }
    header_.elements.back().properties.push_back(property);
  }

  PlyType type(std::string_view line, std::string_view name) const {
    const auto found = type_named(name);
    if (!found)
      fail(line, fmt::format("a type of char, uchar, short, ushort, int, uint, float or double "
                             "instead of \"{}\"",
                             quotable(name)));
    return *found;
  }

  const std::filesystem::path& file_;
  const std::string& bytes_;
  std::size_t at_ = 0;
  PlyHeader header_;
};

}  // namespace

std::size_t bytes_of(PlyType type) {
  constexpr std::array<std::size_t, 8> bytes{1, 1, 2, 2, 4, 4, 4, 8};
  return bytes[static_cast<std::size_t>(type)];
}

std::size_t PlyElement::smallest_row(bool ascii) const {
  std::size_t size = 0;
  for (const auto& property : properties)
    size += ascii ? 2 : bytes_of(property.is_list ? property.count_type : property.type);
  return size;
}

PlyHeader read_ply_header(const std::filesystem::path& file, const std::string& bytes) {
  PlyHeader header = HeaderReader(file, bytes).read();
  // Before memory is allocated from these counts, check that the file can contain so much.
  const bool ascii = header.format == PlyHeader::Format::ascii;
  const std::size_t body = bytes.size() - header.bytes;
  std::size_t left = body + (ascii ? 1 : 0);  // the last line may lack its line ending
  for (const auto& element : header.elements) {
    const std::size_t row = element.smallest_row(ascii);
    if (row == 0) continue;
    if (static_cast<std::size_t>(element.count) > left / row)
      throw InputError(file,
                       fmt::format("is torn, or its header is wrong: it says {} rows of \"{}\", "
                                   "of {} bytes or more each; only {} bytes follow the header",
                                   element.count, quotable(element.name), row, body));
    left -= row * static_cast<std::size_t>(element.count);
  }
  return header;
}

}  // namespace hyperex::io
