// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/core/bounds.hpp"

namespace hyperex::tissue {

/// How thick the soft tissue may be, m.
inline constexpr Bounds thickness_m_in{0.001, 0.04};

/// The parameters of a material, as places in arrays. SI: Pa, Pa s, 1, kg/m^3.
enum Parameter { young, viscosity, poisson, density };
inline constexpr int parameter_count = 4;

/// A value a parameter.
using TissueParameters = std::array<double, parameter_count>;
/// The same where given.
using GivenParameters = std::array<std::optional<double>, parameter_count>;

inline constexpr TissueParameters default_parameters = {192.4e3, 476.8, 0.495, 1100};

struct ParameterInfo {
  const char* key;      ///< of scene files and tables: "young_kpa"
  const char* title;    ///< "Young's modulus (kPa)"
  double si;            ///< SI = value in the key's unit * si
  double least, most;   ///< allowed, SI
  const char* allowed;  ///< in words, in the key's unit
};
/// What a material may have: outside, K is not positive definite, or C or M not semi-definite.
const ParameterInfo& parameter_info(int parameter);
bool is_allowed(int parameter, double value);

enum class Interpolation {
  harmonic,  ///< on the skin (harmonic.hpp)
  linear     ///< over triangles of points, seen from in front (frontal.hpp)
};

struct TissuePoint {
  std::string landmark;
  std::string side;  ///< "L", "R" or "": as the name says, and of a name without side both
  GivenParameters value{};
  bool operator==(const TissuePoint&) const = default;
};

/// A change within a part of the skin: by name, a band about a line, or painted.
struct TissueRegion {
  std::string name = {};                                  ///< of facial_regions(); or
  std::vector<std::string> scar = {};                     ///< landmarks, two or more; or
  std::vector<std::array<double, 3>> scar_points_m = {};  ///< scan frame, two or more; or
  std::filesystem::path painted = {};                     ///< shares a vertex of the scan
  double width_m = 0.004;                                 ///< of a scar
  double blend_m = 0.004;  ///< from nothing to the whole change, half of it on either side
  GivenParameters value{}, factor{};
  bool operator==(const TissueRegion&) const = default;
};

/// What makes the tissue differ from place to place. A plain value: a variant is a changed copy.
struct TissueFieldOptions {
  GivenParameters uniform{};  ///< where no point gives the parameter; none: preset or default
  std::string preset;         ///< of tissue_presets(); empty: none
  Interpolation interpolation = Interpolation::harmonic;
  bool mirror = false;                ///< what is given for one side holds for the other too
  std::vector<TissuePoint> points;    ///< in the place of the preset's at the same landmark
  std::filesystem::path per_vertex;   ///< CSV or PLY, a row a vertex of the scan; empty: none
  std::vector<TissueRegion> regions;  ///< applied in turn
  bool operator==(const TissueFieldOptions&) const = default;
};

/// Something wrong with one of the options: `key` is "preset", "point[1].side", "region[0].name".
struct FieldProblem {
  std::string key, expected;
};

}  // namespace hyperex::tissue
