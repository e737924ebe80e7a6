// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/per_vertex/per_vertex.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "hyperex/core/error.hpp"
#include "hyperex/core/lower_case.hpp"
#include "hyperex/io/csv.hpp"
#include "hyperex/io/raw_mesh.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/tissue/per_vertex/vertex_match.hpp"

namespace hyperex::tissue {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct Column {
  std::string name;
  Eigen::VectorXd values;
};

/// Values a row, and the mesh that they lie on where the file has one.
struct Table {
  std::vector<Column> columns;
  std::optional<TriMesh> mesh;
};

/// The CSV's columns or the PLY's vertex properties; of other files nothing.
Table read_table(const std::filesystem::path& file) {
  Table table;
  if (ending_of(file) == ".csv") {
    const io::CsvTable csv = io::read_csv(file);
    for (std::size_t c = 0; c < csv.names.size(); ++c)
      table.columns.push_back({csv.names[c], csv.values.col(Eigen::Index(c))});
  } else if (ending_of(file) == ".ply") {
    io::RawMesh raw = io::read_ply(file);
    for (const auto& scalar : raw.vertex_scalars)
      table.columns.push_back({scalar.name, scalar.values.cast<double>()});
    raw.vertex_colour.resize(0, 4);
    table.mesh = raw.face_end.empty() ? TriMesh{std::move(raw.points), {}}
                                      : io::triangulated(file, std::move(raw)).mesh;
  }
  return table;
}

Eigen::VectorXd redness(const io::VertexColours& colours) {
  Eigen::VectorXd share(colours.rows());
  for (Eigen::Index v = 0; v < share.size(); ++v)
    share[v] = std::max(0, colours(v, 0) - std::max<int>(colours(v, 1), colours(v, 2))) / 255.0;
  return share;
}

/// Brings values of a file's vertices onto the scan's. `own`: the file's mesh, if it has one.
class OnScan {
 public:
  OnScan(const std::filesystem::path& file, const std::optional<TriMesh>& own, const TriMesh& scan,
         std::vector<Note>& notes)
      : file_(file), notes_(notes) {
    if (own) match_.emplace(file, *own, scan);
    if (match_ && !match_->same_order())
      notes_.push_back(make_note(
          "tissue.matched_by_place",
          fmt::format("{}: its {} vertices are not in the scan's order; they were matched by place",
                      file.string(), own->points.rows())));
  }

  Eigen::VectorXd operator()(const Eigen::VectorXd& values, double otherwise) const {
    if (!match_) return values;
    if (const auto count = match_->disagreements(values); count > 0)
      notes_.push_back(
          make_note("tissue.values_averaged",
                    fmt::format("{}: at {} of the scan's vertices it has several vertices with "
                                "different values; their mean was used",
                                file_.string(), count)));
    return match_->on_scan(values, otherwise);
  }

 private:
  const std::filesystem::path& file_;
  std::vector<Note>& notes_;
  std::optional<VertexMatch> match_;
};

/// A column that is looked for.
struct Wanted {
  std::string key;
  double si;            ///< SI = value * si
  std::string allowed;  ///< in words
  std::function<bool(double)> is_allowed;
};

/// Its values, SI, NaN where none is given; nothing where there is no such column.
std::optional<Eigen::VectorXd> sound_values(const std::filesystem::path& file, const Table& table,
                                            const Wanted& wanted, const TriMesh& scan) {
  const auto column = std::find_if(table.columns.begin(), table.columns.end(),
                                   [&](const auto& c) { return c.name == wanted.key; });
  if (column == table.columns.end()) return std::nullopt;
  Eigen::VectorXd values = column->values;
  if (!table.mesh && values.size() != scan.points.rows())
    throw InputError(file, fmt::format("{} rows of {}: expected {}, one per vertex of the scan",
                                       values.size(), wanted.key, scan.points.rows()));
  for (Eigen::Index v = 0; v < values.size(); ++v) {
    const double value = values[v] * wanted.si;
    if (!std::isnan(value) && !wanted.is_allowed(value))
      throw InputError(file, fmt::format("{} = {:g} at vertex {} (counted from 0): expected {}",
                                         wanted.key, values[v], v, wanted.allowed));
    values[v] = value;
  }
  return values;
}

}  // namespace

PerVertex read_per_vertex(const std::filesystem::path& file, const TriMesh& scan,
                          std::vector<Note>& notes) {
  const Table table = read_table(file);
  PerVertex columns;
  std::optional<OnScan> on_scan;
  for (int p = 0; p < parameter_count; ++p) {
    const ParameterInfo& info = parameter_info(p);
    const Wanted wanted{info.key, info.si, info.allowed,
                        [p](double value) { return is_allowed(p, value); }};
    const auto values = sound_values(file, table, wanted, scan);
    if (!values) continue;
    if (!on_scan) on_scan.emplace(file, table.mesh, scan, notes);
    columns[p] = (*on_scan)(*values, kNone);
  }
  if (!on_scan)
    throw InputError(
        file,
        "no values per vertex: expected columns (CSV) or vertex properties (PLY) with the "
        "names young_kpa, viscosity_pa_s, poisson or density_kg_m3");
  return columns;
}

Eigen::VectorXd read_depths(const std::filesystem::path& file, const TriMesh& scan,
                            std::vector<Note>& notes) {
  constexpr Bounds in = thickness_m_in;
  const Table table = read_table(file);
  const Wanted wanted{"thickness_mm", 1e-3,
                      fmt::format("a number from {:g} to {:g}", 1e3 * in.least, 1e3 * in.most),
                      [in](double value) { return in.holds(value); }};
  const auto values = sound_values(file, table, wanted, scan);
  if (!values)
    throw InputError(file,
                     "no thickness per vertex: expected a column (CSV) or a vertex property (PLY) "
                     "with the name thickness_mm");
  return OnScan(file, table.mesh, scan, notes)(*values, kNone);
}

Eigen::VectorXd read_paint(const std::filesystem::path& file, const TriMesh& scan,
                           std::vector<Note>& notes) {
  Table table = read_table(file);
  Eigen::VectorXd share;
  for (const auto& column : table.columns)
    if (column.name == "weight") share = column.values;
  const bool by_colour = share.size() == 0 && ending_of(file) != ".csv";
  if (by_colour) {
    io::Scan painted = io::read_scan(file);
    share = redness(painted.vertex_colour);
    table.mesh = std::move(painted.mesh);
  }
  if (share.size() == 0)
    throw InputError(
        file,
        "nothing painted: expected one weight per vertex (column or property `weight`) or "
        "a mesh with vertex colours");
  if (!table.mesh && share.size() != scan.points.rows())
    throw InputError(file, fmt::format("{} painted vertices: expected {}, those of the scan",
                                       share.size(), scan.points.rows()));
  for (Eigen::Index v = 0; v < share.size(); ++v)
    if (!(share[v] >= 0 && share[v] <= 1))
      throw InputError(
          file,
          fmt::format("weight = {:g} at vertex {} (counted from 0): expected a number from 0 to 1",
                      share[v], v));
  constexpr double least = 1e-6;
  if (share.maxCoeff() < least)
    throw InputError(
        file,
        by_colour
            ? "nothing is painted red: expected the region in pure red, on white, grey or black"
            : "every weight is 0: expected 1 where the region is");
  return OnScan(file, table.mesh, scan, notes)(share, 0);
}

}  // namespace hyperex::tissue
