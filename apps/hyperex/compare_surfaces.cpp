// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare_surfaces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <optional>
#include <set>
#include <utility>

#include "hyperex/core/error.hpp"
#include "hyperex/core/lower_case.hpp"
#include "hyperex/io/scan.hpp"

namespace hyperex::cli {
namespace {

// Reads the files and collects the notes on their units.
class Reader {
 public:
  explicit Reader(const std::string& unit) : unit_(io::length_unit(unit)) {}
  TriMesh read(const std::filesystem::path& file) {
    if (unit_) return io::read_mesh(file, *unit_);
    io::Scan scan = io::read_scan(file);
    notes_.push_back(fmt::format("{}: unit {}", file.string(), io::unit_note(scan)));
    if (scan.unit_guessed) guessed_.insert(scan.unit);
    return std::move(scan.mesh);
  }
  std::vector<std::string> notes() const {
    std::vector<std::string> all = notes_;
    if (guessed_.size() > 1)
      all.push_back(
          "warning: the units that were guessed differ; if the files are in one unit, state it "
          "with --unit");
    return all;
  }

 private:
  std::optional<io::LengthUnit> unit_;
  std::vector<std::string> notes_;
  std::set<io::LengthUnit> guessed_;
};

// If the sizes of the two surfaces differ by a large factor, one of the units is wrong.
void check_sizes(const CompareOptions& options, const ComparedSurfaces& surfaces) {
  constexpr double most = 5;
  const double a = io::across(surfaces.a.points);
  const auto check = [&](const std::filesystem::path& file, const TriMesh& mesh) {
    const double size = io::across(mesh.points);
    if (size <= most * a && a <= most * size) return;
    throw InputError(
        file, fmt::format("is {:.4g} mm across and {} is {:.4g} mm{}: expected surfaces of about "
                          "one size; are both in the same unit?",
                          1e3 * size, options.a.string(), 1e3 * a,
                          options.unit.empty() ? "" : fmt::format(" in {}", options.unit)));
  };
  check(options.b, surfaces.b);
  check(options.rest.empty() ? options.a : options.rest, surfaces.rest);
}

// STL stores the corners of each triangle separately. After joining, the vertices are numbered by
// first appearance, and distinct vertices at the same place have become one. The original numbering
// is lost.
void refuse_stl(const CompareOptions& options) {
  for (const auto& file : {options.a, options.b})
    if (ending_of(file) == ".stl")
      throw InputError(file,
                       "is an STL, which does not number its vertices: --corresponding needs "
                       "PLY, OBJ or glTF; without it the closest points are compared");
}

// For a comparison of corresponding vertices, all three surfaces must begin with the vertices of
// the rest surface.
void check_counts(const CompareOptions& options, ComparedSurfaces& surfaces) {
  const Eigen::Index a = surfaces.a.points.rows(), b = surfaces.b.points.rows();
  if (options.rest.empty()) {
    if (a != b)
      throw InputError(options.b, fmt::format("has {} vertices and {} has {}: to be compared by "
                                              "corresponding vertices they need as many; give the "
                                              "scan at rest (--rest) if one has some appended",
                                              b, options.a.string(), a));
    surfaces.scored = a;
    return;
  }
  surfaces.scored = surfaces.rest.points.rows();
  for (const auto& [file, count] : {std::pair{options.a, a}, std::pair{options.b, b}}) {
    if (count < surfaces.scored)
      throw InputError(file, fmt::format("has {} vertices, fewer than the {} of the scan at rest "
                                         "{}: they do not correspond",
                                         count, surfaces.scored, options.rest.string()));
    if (count > surfaces.scored)
      std::cerr << fmt::format(
          "{}: {} vertices beyond the {} of the scan at rest are taken as appended and left out\n",
          file.string(), count - surfaces.scored, surfaces.scored);
  }
}

}  // namespace

ComparedSurfaces read_surfaces(const CompareOptions& options) {
  if (options.corresponding) refuse_stl(options);
  ComparedSurfaces surfaces;
  Reader reader(options.unit);
  surfaces.a = reader.read(options.a);
  surfaces.b = reader.read(options.b);
  surfaces.rest = options.rest.empty() ? surfaces.a : reader.read(options.rest);
  surfaces.notes = reader.notes();
  check_sizes(options, surfaces);
  if (options.corresponding) {
    check_counts(options, surfaces);
    return surfaces;
  }
  surfaces.scored = surfaces.a.points.rows();
  if (!options.rest.empty() && surfaces.rest.points.rows() != surfaces.scored)
    surfaces.scored = std::min(surfaces.scored, surfaces.rest.points.rows());
  if (!options.rest.empty() && surfaces.scored < surfaces.rest.points.rows())
    throw InputError(
        options.a,
        fmt::format("has {} vertices, fewer than the {} of the scan at rest {}", surfaces.scored,
                    surfaces.rest.points.rows(), options.rest.string()));
  return surfaces;
}

}  // namespace hyperex::cli
