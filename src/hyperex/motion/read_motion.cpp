// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/read_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/lower_case.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/io/csv.hpp"
#include "hyperex/io/number.hpp"
#include "hyperex/io/trc.hpp"
#include "hyperex/motion/option_error.hpp"

namespace hyperex::motion {

namespace {

namespace fs = std::filesystem;
using io::LengthUnit;

/// The span of a face's points, metres. The interval is so narrow that only one of mm, cm and m
/// fits.
constexpr double kLeastSpan = 0.05, kLargestSpan = 0.45;
/// The smallest and the largest span in a stated unit: from a few points of a mouth to a head and
/// shoulders.
constexpr double kLeastStatedSpan = 0.01, kLargestStatedSpan = 1.0;

/// Removes "_mm", "_cm" or "_m" from the end of `text`.
std::optional<LengthUnit> take_unit(std::string& text) {
  const auto cut = text.rfind('_');
  if (cut == std::string::npos || cut == 0) return {};
  const auto unit = io::length_unit(lower_case(text.substr(cut + 1)));
  if (unit) text.resize(cut);
  return unit;
}

/// The columns of one point.
struct PointColumns {
  std::string name;
  std::array<int, 3> column{-1, -1, -1};
  std::optional<LengthUnit> unit;
};

struct Columns {
  int time = -1;
  std::vector<PointColumns> points;
  std::map<std::string, std::size_t> place;  // of a name among the points
};

bool is_numbered(const std::string& name) {
  return name.size() > 1 && name[0] >= 'x' && name[0] <= 'z' &&
         std::all_of(name.begin() + 1, name.end(), [](unsigned char c) { return std::isdigit(c); });
}

void add_coordinate(const io::CsvTable& table, Columns& columns, int column) {
  const std::string& header = table.names[std::size_t(column)];
  std::string name = header;
  const auto unit = take_unit(name);
  int axis = -1;
  if (is_numbered(lower_case(name))) {
    axis = std::tolower(name[0]) - 'x';
    name = "point_" + std::to_string(std::stol(name.substr(1, 9)));
  } else if (name.size() > 2 && name[name.size() - 2] == '_' &&
             std::string("xyz").find(char(std::tolower(name.back()))) != std::string::npos) {
    axis = std::tolower(name.back()) - 'x';
    name.resize(name.size() - 2);
  } else {
    throw InputError({table.file, 1, "column", io::quotable(header),
                      "time_s, x0, y0, z0, x1 ..., or NAME_x, NAME_y, NAME_z with an optional "
                      "unit (NAME_x_mm)"});
  }
  const auto [known, is_new] = columns.place.try_emplace(name, columns.points.size());
  if (is_new) columns.points.push_back({name, {-1, -1, -1}, unit});
  PointColumns* const point = &columns.points[known->second];
  if (point->column[std::size_t(axis)] >= 0)
    throw InputError({table.file, 1, "column", io::quotable(header),
                      "each coordinate of point " + io::quotable(name) + " once"});
  if (point->unit != unit)
    throw InputError({table.file, 1, "column", io::quotable(header),
                      "the three coordinates of point " + io::quotable(name) + " in one unit"});
  point->column[std::size_t(axis)] = column;
}

/// Refuses common tables of other kinds, recognised by their columns, and names the option that
/// reads them.
void refuse_other_tables(const io::CsvTable& table) {
  const auto has = [&](const char* wanted) {
    return std::any_of(table.names.begin(), table.names.end(),
                       [&](const std::string& name) { return lower_case(name) == wanted; });
  };
  if (has("au12_r"))
    throw OptionError(table.file,
                      "a table of action units by OpenFace, not of points: expected it as ",
                      "openface", "");
  if (has("jawopen") || has("mouthsmileleft"))
    throw OptionError(table.file, "a table of ARKit's blend shapes, not of points: expected it as ",
                      "arkit", "");
}

constexpr const char* kNoTime =
    "this is no recording: it has no column of time (time_s, time or timestamp)";

/// Reads a table of numbers. A table of words without a time column is refused for the missing
/// column, which says more about the error than the first word.
io::CsvTable read_table(const fs::path& file) {
  try {
    return io::read_csv(file);
  } catch (const InputError&) {
    const std::string text = lower_case(read_file(file).substr(0, 65536));
    const std::string header = text.substr(0, text.find_first_of("\r\n"));
    const bool of_words =
        !header.empty() && header.find_first_of(",;\t") != std::string::npos &&
        header.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_-.,;\t\" ") ==
            std::string::npos;
    if (of_words && header.find("time") == std::string::npos) throw InputError(file, kNoTime);
    throw;
  }
}

Columns find_columns(const io::CsvTable& table) {
  refuse_other_tables(table);
  static const std::set<std::string> time_names = {"time_s", "time", "timestamp", "timestamp_s"};
  if (std::none_of(table.names.begin(), table.names.end(),
                   [](const std::string& name) { return time_names.contains(lower_case(name)); }))
    throw InputError(table.file, kNoTime);
  Columns columns;
  for (int c = 0; c < int(table.names.size()); ++c) {
    const std::string name = lower_case(table.names[std::size_t(c)]);
    if (name == "frame") continue;
    if (!time_names.contains(name)) {
      add_coordinate(table, columns, c);
    } else if (columns.time >= 0) {
      throw InputError({table.file, 1, "column", name, "one column of time"});
    } else {
      columns.time = c;
    }
  }
  if (columns.points.empty())
    throw InputError(table.file,
                     "there are no points: expected NAME_x, NAME_y, NAME_z or x0, y0, "
                     "z0, x1 ... beside the time");
  for (const auto& point : columns.points)
    for (int axis = 0; axis < 3; ++axis)
      if (point.column[std::size_t(axis)] < 0)
        throw InputError(table.file, fmt::format("point {} has no column for {}",
                                                 io::quotable(point.name), "xyz"[axis]));
  return columns;
}

/// Renames 68 numbered points to the names of the usual annotation.
void name_ibug68(Columns& columns) {
  if (columns.points.size() != 68) return;
  std::set<std::string> expected;
  for (int k = 0; k < 68; ++k) expected.insert("point_" + std::to_string(k));
  for (const auto& point : columns.points) expected.erase(point.name);
  if (!expected.empty()) return;
  for (auto& point : columns.points) point.name = face::ibug(std::stoi(point.name.substr(6)));
}

/// Diagonal of the box around the points: the median over the samples that have two or more.
double span_of(const std::vector<Points>& positions) {
  std::vector<double> spans;
  for (const auto& sample : positions) {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (Eigen::Index p = 0; p < sample.rows(); ++p)
      if (sample.row(p).allFinite()) {
        low = low.cwiseMin(sample.row(p).transpose());
        high = high.cwiseMax(sample.row(p).transpose());
      }
    if ((high - low).allFinite() && (high - low).norm() > 0) spans.push_back((high - low).norm());
  }
  if (spans.empty()) return 0;
  std::nth_element(spans.begin(), spans.begin() + long(spans.size() / 2), spans.end());
  return spans[spans.size() / 2];
}

struct FoundUnit {
  LengthUnit unit;
  std::string why;
};

FoundUnit find_unit(const fs::path& file, std::optional<LengthUnit> stated, double span) {
  if (stated) return {*stated, "as stated"};
  std::string stem = file.stem().string();
  if (const auto named = take_unit(stem)) return {*named, "as the file's name ends"};
  for (const auto unit : {LengthUnit::millimetre, LengthUnit::centimetre, LengthUnit::metre})
    if (const double metres = span * io::metres_per(unit);
        metres >= kLeastSpan && metres < kLargestSpan)
      return {unit, fmt::format("guessed: the points then span {:.0f} mm", metres * 1e3)};
  throw InputError(file, fmt::format("the length unit cannot be guessed: the points span {:.4g}, "
                                     "which is a face's 5 to 45 cm in neither mm, cm nor m: state "
                                     "the unit",
                                     span));
}

void scale_to_metres(const fs::path& file, const Columns& columns, std::optional<LengthUnit> stated,
                     Motion& motion) {
  const bool own_units = std::all_of(columns.points.begin(), columns.points.end(),
                                     [](const PointColumns& p) { return p.unit.has_value(); });
  FoundUnit fallback{LengthUnit::metre, ""};
  if (!own_units) fallback = find_unit(file, stated, span_of(motion.positions));
  std::set<std::string> used;
  for (std::size_t p = 0; p < columns.points.size(); ++p) {
    const LengthUnit unit = columns.points[p].unit.value_or(fallback.unit);
    if (stated && unit != *stated)
      throw InputError(
          file, fmt::format("the columns of point {} are in {}, but the unit was "
                            "stated to be {}",
                            columns.points[p].name, io::name_of(unit), io::name_of(*stated)));
    used.insert(io::name_of(unit));
    for (auto& sample : motion.positions) sample.row(Eigen::Index(p)) *= io::metres_per(unit);
  }
  motion.unit_note = fmt::format("{} ({})", fmt::join(used, ", "),
                                 own_units ? "as the columns say" : fallback.why);
  const double span = span_of(motion.positions);
  if (motion.names.size() >= 3 && (span < kLeastStatedSpan || span > kLargestStatedSpan))
    throw InputError(file, fmt::format("the points span {:.4g} mm in the unit {}: no face is that "
                                       "{}",
                                       span * 1e3, motion.unit_note,
                                       span < kLeastStatedSpan ? "small" : "large"));
}

/// The times in such a file are not numbers; an error about the first of them would mislead.
void refuse_live_link(const fs::path& file) {
  if (lower_case(read_file(file).substr(0, 27)).starts_with("timecode,blendshapecount"))
    throw OptionError(file,
                      "a recording of ARKit's blend shapes by Live Link Face, not of points: "
                      "expected it as ",
                      "arkit", "");
}

Motion from_csv(const fs::path& file, std::optional<LengthUnit> stated) {
  refuse_live_link(file);
  const io::CsvTable table = read_table(file);
  Columns columns = find_columns(table);
  name_ibug68(columns);
  if (table.values.rows() == 0) throw InputError(file, "there are no samples");
  Motion motion;
  motion.source = file.string();
  for (const auto& point : columns.points) motion.names.push_back(point.name);
  for (Eigen::Index k = 0; k < table.values.rows(); ++k) {
    const double t = table.values(k, columns.time);
    const int line = table.lines[std::size_t(k)];
    const std::string& time_name = table.names[std::size_t(columns.time)];
    if (!std::isfinite(t)) throw InputError({file, line, time_name, "nan", "a time in seconds"});
    if (!motion.time_s.empty() && t <= motion.time_s.back())
      throw InputError(
          {file, line, time_name, fmt::format("{}", t),
           fmt::format("a time after the sample before it ({} s)", motion.time_s.back())});
    motion.time_s.push_back(t);
    motion.lines.push_back(line);
    Points sample(Eigen::Index(columns.points.size()), 3);
    for (Eigen::Index p = 0; p < sample.rows(); ++p)
      for (int axis = 0; axis < 3; ++axis)
        sample(p, axis) = table.values(k, columns.points[std::size_t(p)].column[std::size_t(axis)]);
    // A point with one missing coordinate counts as not measured.
    for (Eigen::Index p = 0; p < sample.rows(); ++p)
      if (!sample.row(p).allFinite())
        sample.row(p).setConstant(std::numeric_limits<double>::quiet_NaN());
    motion.positions.push_back(std::move(sample));
  }
  if (span_of(motion.positions) == 0 && motion.names.size() > 1)
    throw InputError(file, "no sample has two measured points apart from each other");
  scale_to_metres(file, columns, stated, motion);
  return motion;
}

Motion from_trc(const fs::path& file, std::optional<LengthUnit> stated) {
  io::TrcFile recording = io::read_trc(file);
  if (recording.names.empty()) throw InputError(file, "there are no points");
  if (recording.time_s.empty()) throw InputError(file, "there are no samples");
  if (stated && *stated != recording.unit)
    throw InputError(file, fmt::format("the file's unit is {}, but it was stated to be {}",
                                       io::name_of(recording.unit), io::name_of(*stated)));
  Motion motion;
  motion.source = file.string();
  motion.unit_note = io::name_of(recording.unit) + " (as the file says)";
  motion.names = std::move(recording.names);
  motion.time_s = std::move(recording.time_s);
  motion.positions = std::move(recording.positions);
  motion.lines = std::move(recording.lines);
  return motion;
}

}  // namespace

Motion read_motion(const fs::path& file, std::optional<LengthUnit> unit) {
  const std::string extension = ending_of(file);
  if (std::error_code error; extension != ".c3d" && !fs::exists(file, error))
    throw InputError(file, "no such file");
  if (extension == ".csv") return from_csv(file, unit);
  if (extension == ".trc") return from_trc(file, unit);
  if (extension == ".c3d")
    throw InputError(
        file, "C3D is not read: export the markers as TRC (Mokka and OpenSim's C3D tools do)");
  throw InputError(file, "a motion is read from .csv or .trc, not from '" + extension + "'");
}

void write_motion_csv(const fs::path& file, const Motion& motion) {
  std::vector<std::string> names = {"time_s"};
  for (const auto& name : motion.names)
    for (const char* axis : {"_x_mm", "_y_mm", "_z_mm"}) names.push_back(name + axis);
  io::write_csv(file, names, long(motion.time_s.size()), [&](long k, std::vector<double>& row) {
    row[0] = motion.time_s[std::size_t(k)];
    const Points& sample = motion.positions[std::size_t(k)];
    for (Eigen::Index i = 0; i < sample.size(); ++i)
      row[std::size_t(i) + 1] = sample.data()[i] * 1e3;
  });
}

}  // namespace hyperex::motion
