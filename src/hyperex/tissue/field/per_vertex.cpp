// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/field/per_vertex.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "hyperex/core/error.hpp"
#include "hyperex/io/csv.hpp"
#include "hyperex/io/scan.hpp"

namespace hyperex::tissue {
namespace {

bool has_extension(const std::filesystem::path& file, const char* wanted) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return extension == wanted;
}

/// The CSV's column or the PLY's vertex property; empty where there is none.
Eigen::VectorXd weight_column(const std::filesystem::path& file) {
  if (has_extension(file, ".csv")) {
    const io::CsvTable table = io::read_csv(file);
    if (const auto column = table.find("weight")) return table.values.col(*column);
  } else if (has_extension(file, ".ply")) {
    for (const auto& scalar : io::read_ply_scalars(file))
      if (scalar.name == "weight") return scalar.values.cast<double>();
  }
  return {};
}

Eigen::VectorXd redness(const io::VertexColours& colours) {
  Eigen::VectorXd share(colours.rows());
  for (Eigen::Index v = 0; v < share.size(); ++v)
    share[v] = std::max(0, colours(v, 0) - std::max<int>(colours(v, 1), colours(v, 2))) / 255.0;
  return share;
}

/// In the units of the columns' names.
PerVertex read_columns(const std::filesystem::path& file) {
  PerVertex columns;
  if (has_extension(file, ".ply")) {
    for (const auto& scalar : io::read_ply_scalars(file))
      for (int p = 0; p < parameter_count; ++p)
        if (scalar.name == parameter_info(p).key) columns[p] = scalar.values.cast<double>();
    return columns;
  }
  const io::CsvTable table = io::read_csv(file);
  for (int p = 0; p < parameter_count; ++p)
    if (const auto column = table.find(parameter_info(p).key))
      columns[p] = table.values.col(*column);
  return columns;
}

}  // namespace

PerVertex read_per_vertex(const std::filesystem::path& file, Eigen::Index scan_vertices) {
  PerVertex columns = read_columns(file);
  bool any = false;
  for (int p = 0; p < parameter_count; ++p) {
    if (columns[p].size() == 0) continue;
    any = true;
    const ParameterInfo& info = parameter_info(p);
    if (columns[p].size() != scan_vertices)
      throw InputError(file, fmt::format("{} rows of {}: expected {}, one a vertex of the scan",
                                         columns[p].size(), info.key, scan_vertices));
    for (Eigen::Index v = 0; v < scan_vertices; ++v) {
      const double value = columns[p][v] * info.si;
      if (!std::isnan(value) && !is_allowed(p, value))
        throw InputError(file, fmt::format("{} = {:g} at vertex {} (counted from 0): expected {}",
                                           info.key, columns[p][v], v, info.allowed));
      columns[p][v] = value;
    }
  }
  if (!any)
    throw InputError(file,
                     "no values a vertex: expected columns (CSV) or vertex properties (PLY) of the "
                     "names young_kpa, viscosity_pa_s, poisson or density_kg_m3");
  return columns;
}

Eigen::VectorXd read_paint(const std::filesystem::path& file, Eigen::Index scan_vertices) {
  Eigen::VectorXd share = weight_column(file);
  if (share.size() == 0 && !has_extension(file, ".csv"))
    share = redness(io::read_scan(file).vertex_colour);
  if (share.size() == 0)
    throw InputError(file,
                     "nothing painted: expected weights a vertex (column or property `weight`) or "
                     "a mesh with vertex colours");
  if (share.size() != scan_vertices)
    throw InputError(file, fmt::format("{} painted vertices: expected {}, those of the scan",
                                       share.size(), scan_vertices));
  for (Eigen::Index v = 0; v < scan_vertices; ++v)
    if (!(share[v] >= 0 && share[v] <= 1))
      throw InputError(file, fmt::format("weight = {:g} at vertex {} (counted from 0): expected a "
                                         "number from 0 to 1",
                                         share[v], v));
  return share;
}

}  // namespace hyperex::tissue
