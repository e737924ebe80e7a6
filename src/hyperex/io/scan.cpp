// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/io/scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "hyperex/core/error.hpp"
#include "hyperex/core/lower_case.hpp"
#include "hyperex/io/raw_mesh.hpp"

namespace hyperex::io {
namespace {
constexpr std::array kUnits{LengthUnit::millimetre, LengthUnit::centimetre, LengthUnit::metre};
// Limits of the middle side of a face's bounding box. A guessed unit requires a more plausible size
// than a stated one.
constexpr double guess_min_m = 0.10, guess_max_m = 0.30;
constexpr double stated_min_m = 0.08, stated_max_m = 0.45;

bool is_gltf(const std::filesystem::path& file) {
  const std::string extension = ending_of(file);
  return extension == ".gltf" || extension == ".glb";
}

RawMesh read_raw(const std::filesystem::path& file) {
  const std::string extension = ending_of(file);
  std::error_code not_there;  // a missing file is reported by the reader
  if (std::filesystem::is_regular_file(file, not_there) && std::filesystem::is_empty(file))
    throw InputError(file, "is empty; expected a triangle mesh");
  if (extension == ".ply") return read_ply(file);
  if (extension == ".obj") return read_obj(file);
  if (extension == ".stl") return read_stl(file);
  if (is_gltf(file)) return read_gltf(file);
  throw InputError(file, fmt::format("has the extension \"{}\"; expected .ply, .obj, .stl, .gltf "
                                     "or .glb",
                                     extension));
}

std::optional<LengthUnit> unit_between(double extent, double min_m, double max_m) {
  for (const LengthUnit unit : kUnits) {
    const double size_m = extent * metres_per(unit);
    if (size_m >= min_m && size_m <= max_m) return unit;
  }
  return std::nullopt;
}

std::string size_text(double size_m) {
  return size_m < 0.01 ? fmt::format("{:.3g} mm", 1e3 * size_m)
         : size_m < 1  ? fmt::format("{:.3g} cm", 1e2 * size_m)
                       : fmt::format("{:.4g} m", size_m);
}

[[noreturn]] void refuse_size(const std::filesystem::path& file, double extent,
                              const std::string& reading, double size_m) {
  const auto fitting = unit_between(extent, stated_min_m, stated_max_m);
  throw InputError(
      file, fmt::format("the middle side of its bounding box is {} {}; expected a face, 8 to 45 "
                        "cm{}",
                        size_text(size_m), reading,
                        fitting ? fmt::format(": the unit \"{}\" would fit ({})", name_of(*fitting),
                                              size_text(extent * metres_per(*fitting)))
                                : std::string(", and no unit of mm, cm or m fits")));
}

/// Determines the unit by the rule in scan.hpp.
void settle_unit(Scan& scan, std::optional<LengthUnit> stated) {
  const double extent = across(scan.mesh.points);
  if (!stated && !is_gltf(scan.file)) {
    const auto guess = unit_between(extent, guess_min_m, guess_max_m);
    if (!guess) {
      const auto fitting = unit_between(extent, stated_min_m, stated_max_m);
      throw InputError(
          scan.file,
          fmt::format("its unit cannot be guessed: the middle side of its bounding box is {:.4g}, "
                      "a face of 10 to 30 cm in none of mm, cm and m; {}",
                      extent,
                      fitting
                          ? fmt::format("state the unit (\"{}\" would make it {})",
                                        name_of(*fitting), size_text(extent * metres_per(*fitting)))
                          : std::string("expected the scan of one face")));
    }
    scan.unit = *guess;
    scan.unit_guessed = true;
    return;
  }
  scan.unit = stated.value_or(LengthUnit::metre);
  const double size_m = extent * metres_per(scan.unit);
  if (size_m < stated_min_m || size_m > stated_max_m)
    refuse_size(scan.file, extent,
                stated ? fmt::format("in the stated unit \"{}\"", name_of(scan.unit))
                       : std::string("in metres, glTF's unit"),
                size_m);
}

}  // namespace

double across(const Points& points) {
  std::array<double, 3> sides;
  for (int k = 0; k < 3; ++k) sides[k] = points.col(k).maxCoeff() - points.col(k).minCoeff();
  std::sort(sides.begin(), sides.end());
  return sides[1];
}

std::string unit_note(const Scan& scan) {
  const char* why = scan.unit_guessed                                      ? "guessed by its size"
                    : is_gltf(scan.file) && scan.unit == LengthUnit::metre ? "glTF's unit"
                                                                           : "as stated";
  return fmt::format("{}, {}: {} across", name_of(scan.unit), why,
                     size_text(across(scan.mesh.points)));
}

double metres_per(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::millimetre:
      return 1e-3;
    case LengthUnit::centimetre:
      return 1e-2;
    case LengthUnit::metre:
      break;
  }
  return 1;
}

std::string name_of(LengthUnit unit) {
  return std::string(word_of(unit));
}

std::optional<LengthUnit> length_unit(const std::string& name) {
  return value_of<LengthUnit>(name);
}

Scan read_scan(const std::filesystem::path& file, std::optional<LengthUnit> stated) {
  Scan scan = triangulated(file, read_raw(file));
  settle_unit(scan, stated);
  scan.mesh.points *= metres_per(scan.unit);
  return scan;
}

TriMesh read_mesh(const std::filesystem::path& file, LengthUnit unit) {
  Scan scan = triangulated(file, read_raw(file));
  scan.mesh.points *= metres_per(unit);
  return std::move(scan.mesh);
}

}  // namespace hyperex::io
