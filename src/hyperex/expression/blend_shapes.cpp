// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/expression/blend_shapes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "hyperex/core/error.hpp"
#include "hyperex/core/lower_case.hpp"
#include "hyperex/core/slips.hpp"
#include "hyperex/expression/arkit_names.hpp"
#include "hyperex/expression/gaze.hpp"
#include "hyperex/expression/tables.hpp"
#include "hyperex/expression/timecode.hpp"
#include "hyperex/io/csv.hpp"
#include "hyperex/io/number.hpp"
#include "hyperex/motion/option_error.hpp"

namespace hyperex::expression {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

void check_time(const io::CsvTable& table, const std::vector<double>& time_s) {
  for (std::size_t k = 0; k < time_s.size(); ++k) {
    const std::string at = fmt::format("{:g} s", time_s[k]);
    if (!std::isfinite(time_s[k]))
      throw InputError({table.file, table.lines[k], "time", "nothing", "a time"});
    if (k > 0 && !(time_s[k] > time_s[k - 1]))
      throw InputError({table.file, table.lines[k], "time", at,
                        fmt::format("later than {:g} s, the row before", time_s[k - 1])});
  }
  if (time_s.size() < 2) throw InputError(table.file, "fewer than two rows; expected a recording");
}

/// The blend shape without a column whose name the column probably misspells; empty if there is
/// none.
std::string shape_meant(const std::string& column, const std::vector<std::string>& there) {
  constexpr std::size_t most_slips = 2, shortest = 6;
  std::string best;
  std::size_t least = most_slips + 1;
  for (const std::string& name : arkit_shapes()) {
    const std::size_t far = slips(lower_case(column), lower_case(name));
    if (column.size() < shortest || far >= least ||
        std::find(there.begin(), there.end(), name) != there.end())
      continue;
    least = far;
    best = name;
  }
  return best;
}

/// "; column jawOpn: did you mean jawOpen?" of the first columns that seem misspelt.
std::string shapes_meant(const std::vector<std::string>& columns) {
  constexpr int most = 3;
  std::string text;
  int found = 0;
  for (const std::string& column : columns)
    if (const std::string meant = shape_meant(column, {}); !meant.empty() && found++ < most)
      text += fmt::format("; column {}: did you mean {}?", io::quotable(column), meant);
  return text;
}

/// Refuses a scan in the place of a table.
void refuse_scan(const std::filesystem::path& file) {
  const std::string ending = ending_of(file);
  for (const char* scan : {".ply", ".obj", ".stl", ".gltf", ".glb"})
    if (ending == scan)
      throw InputError(file,
                       "is a scan; expected a table of weights (CSV), with scan.file = the "
                       "scan");
}

/// Refuses a table that another option reads.
[[noreturn]] void refuse_other_table(const std::filesystem::path& file, const std::string& what,
                                     const std::string& option) {
  throw motion::OptionError(file.string(), what + ": expected it as ", option, "");
}

bool has_action_units(const io::CsvTable& table) {
  return table.find("AU12_r") || table.find("AU26_r");
}

bool has_blend_shapes(const io::CsvTable& table) {
  return std::ranges::any_of(table.names, [](const std::string& column) {
    return std::ranges::any_of(arkit_shapes(), [&](const std::string& shape) {
      return lower_case(shape) == lower_case(column);
    });
  });
}

/// Says which columns were left out.
void note_left_out(const std::vector<std::string>& columns, BlendShapes& out) {
  std::vector<std::string> others;
  for (const std::string& column : columns)
    if (const std::string meant = shape_meant(column, out.names); !meant.empty())
      out.misspelt.push_back(fmt::format(
          "column {} is no blend shape of ARKit and is left out; did you mean {}?", column, meant));
    else
      others.push_back(column);
  if (!others.empty())
    out.notes.push_back(fmt::format("columns left out: {}", fmt::join(others, ", ")));
}

/// Names the shapes that a whole capture lacks. A table with few shapes is made so.
void note_absent(BlendShapes& out) {
  constexpr std::size_t whole = 40;
  if (out.names.size() < whole) return;
  std::vector<std::string> absent;
  for (const std::string& name : arkit_shapes())
    if (std::ranges::find(out.names, name) == out.names.end()) absent.push_back(name);
  if (!absent.empty())
    out.notes.push_back(
        fmt::format("{} of ARKit's {} blend shapes have no column and count as 0: {}",
                    absent.size(), arkit_shapes().size(), fmt::join(absent, ", ")));
}

/// Reads the angles of the eyes and takes their names off `left_out`.
void read_eye_angles(const io::CsvTable& table, BlendShapes& out,
                     std::vector<std::string>& left_out) {
  constexpr std::array names = {"LeftEyeYaw", "LeftEyePitch", "RightEyeYaw", "RightEyePitch"};
  Eigen::MatrixXd angles(table.values.rows(), Eigen::Index(names.size()));
  for (std::size_t c = 0; c < names.size(); ++c) {
    const std::optional<int> column = table.find(names[c]);
    if (!column) return;
    angles.col(Eigen::Index(c)) = table.values.col(*column);
  }
  const Eigen::ArrayXXd size = angles.array().isNaN().select(0, angles.array().abs());
  if (size.maxCoeff() == 0) return;
  if (const double most = size.maxCoeff(); most > std::numbers::pi / 2) {
    out.notes.push_back(fmt::format(
        "the angles of the eyes (LeftEyeYaw ...) reach {:g}, so they are no radians as Live Link "
        "writes them; the gaze is taken from the weights eyeLook... alone",
        most));
    return;
  }
  out.eye_angles_rad = std::move(angles);
  std::erase_if(left_out, [&](const std::string& column) {
    return std::ranges::find(names, column) != names.end();
  });
}

/// Fills in the times. Returns their column, nothing where they are timecodes.
std::optional<int> read_times(const io::CsvTable& table, BlendShapes& out) {
  const auto rows = table.values.rows();
  out.time_s.assign(static_cast<std::size_t>(rows), kNan);
  std::optional<int> time;
  for (const char* name : {"time_s", "time", "timestamp"})
    if (!time) time = table.find(name);
  const std::optional<int> timecode = table.find("Timecode");
  if (!time && !timecode)
    throw InputError(table.file,
                     "has no time: expected a column time_s, time, timestamp or Timecode");
  if (time) {
    for (Eigen::Index k = 0; k < rows; ++k) out.time_s[k] = table.values(k, *time);
  } else {
    std::vector<double> codes(static_cast<std::size_t>(rows));
    for (Eigen::Index k = 0; k < rows; ++k) codes[k] = table.values(k, *timecode);
    const double rate_hz = frame_rate_of(codes);
    for (Eigen::Index k = 0; k < rows; ++k) out.time_s[k] = timecode_seconds(codes[k], rate_hz);
    const double start = out.time_s.empty() ? 0 : out.time_s.front();
    for (double& t : out.time_s) t -= start;
    out.notes.push_back(fmt::format("timecodes read at {:g} frames a second", rate_hz));
  }
  check_time(table, out.time_s);
  return time;
}

}  // namespace

BlendShapes read_arkit(const std::filesystem::path& file) {
  refuse_scan(file);
  const io::CsvTable table = io::read_csv(file, [](const std::string& name, std::string_view cell) {
    return name == "Timecode" ? timecode_frames(cell) : std::nullopt;
  });
  if (has_action_units(table) && !has_blend_shapes(table))
    refuse_other_table(file, "a table of action units by OpenFace, not of ARKit's blend shapes",
                       "openface");
  BlendShapes out;
  out.file = file;
  out.lines = table.lines;
  const auto rows = table.values.rows();
  const std::optional<int> time = read_times(table, out);

  std::vector<int> columns;
  std::vector<std::string> left_out;
  for (std::size_t c = 0; c < table.names.size(); ++c) {
    std::string name = table.names[c];
    name[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(name[0])));
    if (std::ranges::find(arkit_shapes(), name) != arkit_shapes().end()) {
      out.names.push_back(name);
      out.columns.push_back(table.names[c]);
      columns.push_back(static_cast<int>(c));
    } else if (static_cast<int>(c) != time.value_or(-1) && name != "timecode") {
      left_out.push_back(table.names[c]);
    }
  }
  if (columns.empty())
    throw InputError(file, "has no column named after a blend shape of ARKit, such as jawOpen" +
                               shapes_meant(left_out));
  read_eye_angles(table, out, left_out);
  note_left_out(left_out, out);
  note_absent(out);
  out.weights.resize(rows, static_cast<Eigen::Index>(columns.size()));
  for (Eigen::Index k = 0; k < rows; ++k)
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const double w = table.values(k, columns[c]);
      if (w < -0.05 || w > 1.5)
        throw InputError({file, table.lines[static_cast<std::size_t>(k)],
                          table.names[static_cast<std::size_t>(columns[c])], fmt::format("{:g}", w),
                          "a weight from 0 to 1"});
      out.weights(k, static_cast<Eigen::Index>(c)) = std::isnan(w) ? w : std::clamp(w, 0.0, 1.0);
    }
  return out;
}

BlendShapes read_openface(const std::filesystem::path& file) {
  constexpr double kMostIntensity = 5;
  refuse_scan(file);
  const io::CsvTable table = io::read_csv(file);
  if (has_blend_shapes(table) && !has_action_units(table))
    refuse_other_table(file, "a table of ARKit's blend shapes, not of OpenFace's action units",
                       "arkit");
  BlendShapes out;
  out.file = file;
  out.lines = table.lines;
  const auto rows = table.values.rows();
  const int time = table.column("timestamp");
  for (Eigen::Index k = 0; k < rows; ++k) out.time_s.push_back(table.values(k, time));
  check_time(table, out.time_s);
  out.weights.resize(rows, 0);
  bool any = false;
  for (const auto& row : table_rows(openface_arkit_table(), "action_unit,blend_shape,share")) {
    const std::string column_name = row.at(0) + "_r";
    const auto column = table.find(column_name);
    if (!column) continue;
    any = true;
    for (const auto& name : arkit_names(row.at(1))) {
      auto at = std::find(out.names.begin(), out.names.end(), name) - out.names.begin();
      if (at == static_cast<std::ptrdiff_t>(out.names.size())) {
        out.names.push_back(name);
        out.columns.push_back(column_name);
        out.weights.conservativeResize(Eigen::NoChange, out.weights.cols() + 1);
        out.weights.rightCols(1).setZero();
      } else {
        out.columns[static_cast<std::size_t>(at)] += " and " + column_name;
      }
      out.weights.col(at) += table.values.col(*column) / kMostIntensity * table_number(row.at(2));
    }
    for (Eigen::Index k = 0; k < rows; ++k)
      if (const double r = table.values(k, *column); r < 0 || r > kMostIntensity)
        throw InputError({file, table.lines[static_cast<std::size_t>(k)], column_name,
                          fmt::format("{:g}", r), "an intensity from 0 to 5"});
  }
  if (!any)
    throw InputError(file,
                     "has no intensities of action units: expected columns AU01_r, AU02_r ...");
  out.weights = out.weights.cwiseMin(1);
  int lost = 0;
  if (const auto success = table.find("success"))
    for (Eigen::Index k = 0; k < rows; ++k)
      if (table.values(k, *success) < 0.5) {
        out.weights.row(k).setConstant(kNan);
        ++lost;
      }
  if (lost > 0) out.notes.push_back(fmt::format("{} of {} frames without a face", lost, rows));
  out.notes.emplace_back("OpenFace does not distinguish sides: left and right move alike");
  return out;
}

motion::Motion motion_of(const BlendShapes& recorded, const FaceModel& model,
                         std::vector<std::string>& notes) {
  const BlendShapes shapes = model.lids_once ? with_lids_once(recorded) : recorded;
  std::set<std::string> used;
  const auto mean_of = [&](const std::string& pattern) -> Eigen::VectorXd {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(shapes.weights.rows());
    const auto names = arkit_names(pattern);
    for (const auto& name : names)
      for (std::size_t c = 0; c < shapes.names.size(); ++c)
        if (shapes.names[c] == name) {
          sum += shapes.weights.col(static_cast<Eigen::Index>(c)) / double(names.size());
          used.insert(name);
        }
    return sum;
  };
  std::vector<DeformationUnit> units = model.animation_units;
  units.insert(units.end(), model.recorded_units.begin(), model.recorded_units.end());
  Eigen::MatrixXd alpha(shapes.weights.rows(), static_cast<Eigen::Index>(units.size()));
  for (std::size_t u = 0; u < units.size(); ++u) {
    const DeformationUnit& unit = units[u];
    alpha.col(static_cast<Eigen::Index>(u)) =
        mean_of(unit.arkit) / unit.arkit_scale -
        mean_of(unit.arkit_negative) / unit.arkit_negative_scale;
    if (!unit.arkit_factor.empty())
      alpha.col(static_cast<Eigen::Index>(u)).array() *= mean_of(unit.arkit_factor).array();
  }
  if (used.empty() && std::ranges::none_of(shapes.names, is_gaze))
    throw InputError(shapes.file, fmt::format("moves nothing of the {} face: it has none of {}",
                                              model.name, fmt::join(shapes.names, ", ")));
  std::vector<std::string> idle;
  for (std::size_t c = 0; c < shapes.names.size(); ++c)
    if (!used.contains(shapes.names[c]) && !is_gaze(shapes.names[c]) &&
        shapes.weights.col(static_cast<Eigen::Index>(c)).cwiseAbs().maxCoeff() > 0)
      idle.push_back(shapes.names[c]);
  if (!idle.empty())
    notes.push_back(
        fmt::format("the {} face does not move with {}", model.name, fmt::join(idle, ", ")));

  motion::Motion out;
  out.source = shapes.file.string();
  out.time_s = shapes.time_s;
  out.smooth_up_to_s = 0;
  out.lines = shapes.lines;
  for (const auto& [name, vertices] : model.landmarks) out.names.push_back(name);
  for (Eigen::Index k = 0; k < alpha.rows(); ++k) {
    Points at = Points::Constant(static_cast<Eigen::Index>(out.names.size()), 3, kNan);
    if (alpha.row(k).allFinite())
      at = landmarks_on(model, deformed(model.mesh.points, units, alpha.row(k).transpose()));
    out.positions.push_back(std::move(at));
  }
  return out;
}

}  // namespace hyperex::expression
