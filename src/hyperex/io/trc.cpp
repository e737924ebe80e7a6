// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/io/trc.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/io/number.hpp"
#include "hyperex/io/text_file.hpp"

namespace hyperex::io {
namespace {
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

class TrcReader {
 public:
  TrcReader(const std::filesystem::path& file, const std::string& text)
      : file_(file), lines_(text), ends_with_line_(text.ends_with('\n') || text.ends_with('\r')) {}

  TrcFile read() {
    read_header();
    read_names();
    next("the line of axes (X1, Y1, Z1, ...)");
    std::string_view line;
    while (lines_.next(line))
      if (!trimmed(line).empty()) read_frame(line);
    if (static_cast<long long>(trc_.time_s.size()) != frames_)
      throw InputError(file_,
                       fmt::format("is torn, or its header is wrong: NumFrames is {}, but {} "
                                   "frames follow",
                                   frames_, trc_.time_s.size()));
    if (frames_ == 0) throw InputError(file_, "has no frames; expected at least one");
    return std::move(trc_);
  }

 private:
  [[noreturn]] void fail(const std::string& key, std::string_view value,
                         const std::string& expected) const {
    throw InputError({file_, lines_.number(), key, quotable(value), expected});
  }

  std::string_view next(const std::string& expected) {
    std::string_view line;
    if (!lines_.next(line))
      throw InputError(file_, fmt::format("is torn: it ends at line {}; expected {}",
                                          lines_.number(), expected));
    return line;
  }

  void read_header() {
    const std::string_view first = next("a line \"PathFileType ...\"");
    if (!trimmed(first).starts_with("PathFileType"))
      fail("", first, "\"PathFileType\", as a TRC file begins");
    const auto keys = words(next("a line \"DataRate CameraRate NumFrames ...\""));
    const auto values = words(next("the values of DataRate, NumFrames, NumMarkers and Units"));
    const auto value = [&](const char* key) {
      const auto place = std::find(keys.begin(), keys.end(), key);
      const auto k = static_cast<std::size_t>(place - keys.begin());
      if (k >= keys.size() || k >= values.size())
        fail(key, "", "this key and its value in the header");
      return values[k];
    };
    const auto rate = parse_number(value("DataRate"));
    if (!rate || !(*rate > 0) || std::isinf(*rate))
      fail("DataRate", value("DataRate"), "a number above 0 (Hz)");
    trc_.data_rate_hz = *rate;
    const auto unit = length_unit(std::string(value("Units")));
    if (!unit) fail("Units", value("Units"), "mm, cm or m");
    trc_.unit = *unit;
    frames_ = count("NumFrames", value("NumFrames"));
    markers_ = count("NumMarkers", value("NumMarkers"));
    if (markers_ == 0) fail("NumMarkers", "0", "at least one marker");
  }

  long long count(const char* key, std::string_view text) const {
    const auto number = parse_integer(text);
    if (!number || *number < 0) fail(key, text, "a whole number, 0 or more");
    return *number;
  }

  void read_names() {
    // A name may contain blanks. Each is followed by two empty cells, for y and z.
    const std::string_view line = next("a line \"Frame# Time NAME ...\"");
    tabs_ = line.find('\t') != std::string_view::npos;
    const auto cells = tabs_ ? split(line, '\t') : words(line);
    if (cells.size() < 2 || !trimmed(cells[0]).starts_with("Frame"))
      fail("", line, "\"Frame#\", \"Time\" and the names of the markers");
    std::set<std::string> known;
    for (std::size_t c = 2; c < cells.size(); ++c) {
      const std::string name(trimmed(cells[c]));
      if (name.empty()) continue;
      if (!is_printable_name(name)) fail("", name, printable_name);
      if (!known.insert(name).second) fail("", name, "each marker's name once; it occurs twice");
      trc_.names.push_back(name);
    }
    if (static_cast<long long>(trc_.names.size()) != markers_)
      fail("NumMarkers", std::to_string(markers_),
           fmt::format("{}, as many as the names", trc_.names.size()));
  }

  void read_frame(std::string_view line) {
    auto cells = tabs_ ? split(line, '\t') : words(line);
    const std::size_t needed = 2 + 3 * trc_.names.size();
    while (cells.size() > needed && trimmed(cells.back()).empty()) cells.pop_back();
    // Some programs omit empty cells at the end of a line. A truncated file lacks the last line
    // ending.
    const bool cut = tabs_ && cells.size() >= 2 && cells.size() < needed &&
                     (ends_with_line_ || !at_end()) && (cells.size() - 2) % 3 == 0;
    if (cut) cells.resize(needed);
    if (cells.size() != needed)
      fail("", fmt::format("{} cells", cells.size()),
           fmt::format("{}: frame, time and 3 for each of {} markers", needed, trc_.names.size()));
    const double time = cell("Time", cells[1]);
    if (std::isnan(time)) fail("Time", "", "a number (s)");
    if (!trc_.time_s.empty() && time <= trc_.time_s.back())
      fail("Time", cells[1], fmt::format("more than {} s, the time before", trc_.time_s.back()));
    Points points(static_cast<Eigen::Index>(trc_.names.size()), 3);
    for (std::size_t m = 0; m < trc_.names.size(); ++m) {
      for (int k = 0; k < 3; ++k)
        points(m, k) = cell(trc_.names[m], cells[2 + 3 * m + k]) * metres_per(trc_.unit);
      const auto missing = points.row(m).array().isNaN().count();
      if (missing == 1 || missing == 2) fail(trc_.names[m], "", "all three coordinates or none");
    }
    trc_.time_s.push_back(time);
    trc_.lines.push_back(int(lines_.number()));
    trc_.positions.push_back(std::move(points));
  }

  double cell(const std::string& key, std::string_view text) const {
    text = trimmed(text);
    if (text.empty()) return nan;
    const auto number = parse_number(text);
    if (!number || std::isinf(*number)) fail(key, text, "a finite number or nothing");
    return *number;
  }

  /// Whether the line just read is the last one of the file.
  bool at_end() const {
    Lines ahead = lines_;
    std::string_view line;
    return !ahead.next(line);
  }

  const std::filesystem::path& file_;
  Lines lines_;
  bool ends_with_line_, tabs_ = true;
  long long frames_ = 0, markers_ = 0;
  TrcFile trc_;
};

void check(const TrcFile& recording) {
  bool sound = recording.data_rate_hz > 0 && recording.time_s.size() == recording.positions.size();
  for (const Points& points : recording.positions)
    sound = sound && points.rows() == static_cast<Eigen::Index>(recording.names.size());
  for (const auto& name : recording.names)
    sound = sound && !name.empty() && name.find_first_of("\t\r\n") == std::string::npos;
  if (!sound)
    throw std::invalid_argument(
        "write_trc: a rate above 0, names without tabs, and for each frame "
        "a time and one row per name");
}

}  // namespace

TrcFile read_trc(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  refuse_other_than_text(file, text);
  return TrcReader(file, text).read();
}

void write_trc(const std::filesystem::path& file, const TrcFile& recording) {
  check(recording);
  const double scale = 1 / metres_per(recording.unit);
  write_file_atomically(file, [&](std::ostream& stream) {
    stream
        << fmt::format("PathFileType\t4\t(X/Y/Z)\t{}\n", file.filename().string())
        << "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\t"
           "OrigNumFrames\n"
        << fmt::format("{0}\t{0}\t{1}\t{2}\t{3}\t{0}\t1\t{1}\n", recording.data_rate_hz,
                       recording.time_s.size(), recording.names.size(), name_of(recording.unit))
        << "Frame#\tTime";
    for (const auto& name : recording.names) stream << '\t' << name << "\t\t";
    stream << "\n\t";
    for (std::size_t m = 1; m <= recording.names.size(); ++m)
      stream << fmt::format("\tX{0}\tY{0}\tZ{0}", m);
    stream << "\n\n";
    for (std::size_t f = 0; f < recording.time_s.size(); ++f) {
      stream << fmt::format("{}\t{:.10g}", f + 1, recording.time_s[f]);
      const Points& points = recording.positions[f];
      for (Eigen::Index m = 0; m < points.rows(); ++m)
        if (points.row(m).hasNaN())
          stream << "\t\t\t";
        else
          for (int k = 0; k < 3; ++k) stream << fmt::format("\t{:.10g}", points(m, k) * scale);
      stream << '\n';
    }
  });
}

}  // namespace hyperex::io
