// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/core/describe.hpp"

namespace hyperex::tissue {

/// How thick the soft tissue may be, m.
inline constexpr Bounds thickness_m_in{0.001, 0.04};
/// How thick one of its layers may be, m.
inline constexpr Bounds layer_thickness_m_in{0, 0.04, true};

/// The parameters of a material, as places in arrays. SI: Pa, Pa s, 1, kg/m^3.
enum Parameter { young, viscosity, poisson, density };
inline constexpr int parameter_count = 4;

/// One value per parameter.
using TissueParameters = std::array<double, parameter_count>;
/// The same where given.
using GivenParameters = std::array<std::optional<double>, parameter_count>;

inline constexpr TissueParameters default_parameters = {192.4e3, 476.8, 0.495, 1100};

struct ParameterInfo {
  std::string key;         ///< of scene files and tables: "young_kpa"
  const char* title;       ///< "Young's modulus (kPa)"
  double si;               ///< SI = value in the key's unit * si
  double least, most;      ///< allowed, SI
  std::string allowed;     ///< in words, in the key's unit
  std::string name;        ///< of C++ and Python: "young_pa"
  std::string allowed_si;  ///< in words, in the unit of `name`
};
/// Name ("young_pa"), unit and bounds of a parameter. Outside of its bounds K is not positive
/// definite, or C or M not semi-definite.
OptionDetails parameter_details(int parameter);
const ParameterInfo& parameter_info(int parameter);
bool is_allowed(int parameter, double value);
/// The key of a factor of a parameter: "young_factor".
std::string factor_key(int parameter);

enum class Interpolation {
  harmonic,  ///< on the skin (harmonic.hpp)
  linear     ///< over triangles of points, seen from in front (frontal.hpp)
};
constexpr auto words_of(Interpolation) {
  return std::array{Word{"harmonic", Interpolation::harmonic},
                    Word{"linear", Interpolation::linear}};
}

struct TissuePoint {
  std::string landmark;
  std::string side;  ///< "L", "R" or "": that of the name, both for a name without side
  GivenParameters value{};
  bool operator==(const TissuePoint&) const = default;

  static constexpr const char* about = "The tissue at a landmark.";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.option(HX_MEMBER(landmark),
             "A landmark of the scan, with its side (cheek_R) or without (cheek: both).",
             {.required = true, .least = 1});
    v.option(HX_MEMBER(side), "The subject's own side, where the landmark's name has none.",
             {.words = {"L", "R", ""}});
    v.option(HX_MEMBER(value[young]), "Young's modulus there.", parameter_details(young));
    v.option(HX_MEMBER(value[viscosity]), "Viscosity there.", parameter_details(viscosity));
    v.option(HX_MEMBER(value[poisson]), "Poisson's ratio there.", parameter_details(poisson));
    v.option(HX_MEMBER(value[density]), "Density there.", parameter_details(density));
  }
};

/// The tissue between two depths under the skin.
struct TissueLayer {
  std::string name = {};                   ///< "skin", for messages
  std::optional<double> thickness_m = {};  ///< not given, of the last one alone: what is left
  GivenParameters value{}, factor{};       ///< factor: of the uniform value
  bool operator==(const TissueLayer&) const = default;

  static constexpr const char* about = "A layer of the tissue.";
  template <class Visitor>
  static void describe(Visitor& v) {
    constexpr Bounds factor_in{0, 1000, true};
    v.option(HX_MEMBER(name), "What the layer is called, as skin or fat.", {.least = 1});
    v.option(HX_MEMBER(thickness_m),
             "How thick the layer is. Only the last, deepest one may have none: it takes the rest.",
             {.unit = kMillimetres, .bounds = layer_thickness_m_in});
    v.option(HX_MEMBER(value[young]), "Young's modulus of the layer.", parameter_details(young));
    v.option(HX_MEMBER(value[viscosity]), "Its viscosity.", parameter_details(viscosity));
    v.option(HX_MEMBER(value[poisson]), "Its Poisson's ratio.", parameter_details(poisson));
    v.option(HX_MEMBER(value[density]), "Its density.", parameter_details(density));
    v.option(HX_MEMBER(factor[young]), "Instead: multiplies tissue.young_kpa in the layer.",
             {.bounds = factor_in, .name = "young_factor"});
    v.option(HX_MEMBER(factor[viscosity]), "Instead: multiplies tissue.viscosity_pa_s.",
             {.bounds = {0, 1000}, .name = "viscosity_factor"});
    v.option(HX_MEMBER(factor[poisson]), "Instead: multiplies tissue.poisson.",
             {.bounds = {-1000, 1000}, .name = "poisson_factor"});
    v.option(HX_MEMBER(factor[density]), "Instead: multiplies tissue.density_kg_m3.",
             {.bounds = factor_in, .name = "density_factor"});
  }
};

/// A change within a part of the skin: by name, a band about a line, or painted.
struct TissueRegion {
  std::string name = {};                                  ///< of facial_regions(); or
  std::vector<std::string> scar = {};                     ///< landmarks, two or more; or
  std::vector<std::array<double, 3>> scar_points_m = {};  ///< scan frame, two or more; or
  std::filesystem::path painted = {};                     ///< one share per vertex of the scan
  double width_m = 0.004;                                 ///< of a scar
  double blend_m = 0.004;  ///< width of the transition, half of it on either side of the border
  GivenParameters value{}, factor{};
  double volume_m3 = 0;  ///< added there, as of filler or an implant; negative: taken away
  bool operator==(const TissueRegion&) const = default;

  static constexpr const char* about = "A change within a part of the skin.";
  template <class Visitor>
  static void describe(Visitor& v) {
    constexpr Bounds factor_in{0, 1000, true};
    v.option(HX_MEMBER(name),
             "A part of the face, as cheek_R or lips (hyperex presets lists them).", {.least = 1});
    v.option(HX_MEMBER(scar),
             "Instead of name: landmarks along a scar, whose straight segments are projected onto "
             "the skin.",
             {.least = 2});
    v.option(HX_MEMBER(scar_points_m), "Instead: points along a scar, in the scan's coordinates.",
             {.unit = kMillimetres});
    v.option(HX_MEMBER(painted),
             "Instead: the scan painted red where the change applies (PLY, OBJ, GLB with vertex "
             "colours), or a CSV or PLY file with one weight from 0 to 1 per vertex.");
    v.option(HX_MEMBER(width_m), "Width of a scar; 4 where not given.",
             {.unit = kMillimetres, .bounds = {0.0005, 0.1}});
    v.option(HX_MEMBER(blend_m),
             "Width of the transition at the rim, half of it outside; 4 where not given.",
             {.unit = kMillimetres, .bounds = {0, 0.1}});
    v.option(HX_MEMBER(value[young]), "Young's modulus there.", parameter_details(young));
    v.option(HX_MEMBER(value[viscosity]), "Viscosity there.", parameter_details(viscosity));
    v.option(HX_MEMBER(value[poisson]), "Poisson's ratio there.", parameter_details(poisson));
    v.option(HX_MEMBER(value[density]), "Density there.", parameter_details(density));
    v.option(HX_MEMBER(factor[young]), "Multiplies Young's modulus there.",
             {.bounds = factor_in, .name = "young_factor"});
    v.option(HX_MEMBER(factor[viscosity]), "Multiplies the viscosity there.",
             {.bounds = {0, 1000}, .name = "viscosity_factor"});
    v.option(HX_MEMBER(factor[poisson]), "Multiplies Poisson's ratio there.",
             {.bounds = {-1000, 1000}, .name = "poisson_factor"});
    v.option(HX_MEMBER(factor[density]), "Multiplies the density there.",
             {.bounds = factor_in, .name = "density_factor"});
    v.option(HX_MEMBER(volume_m3),
             "Volume that is added there, as of filler or an implant, or taken away, as of fat "
             "(negative). The tissue grows alike through its thickness before the recorded forces "
             "act (docs/surgery.md).",
             {.unit = kMillilitres, .bounds = {-3e-5, 3e-5}});
  }
};

/// How the tissue varies in space. A plain value: a variant is a changed copy.
struct TissueFieldOptions {
  GivenParameters uniform{};  ///< where no point gives the parameter; not given: preset or default
  std::string preset;         ///< of tissue_presets(); empty: none
  Interpolation interpolation = Interpolation::harmonic;
  bool mirror = false;                ///< values for one side hold for the other too
  std::vector<TissueLayer> layers;    ///< from the skin inwards; instead of those of the preset
  std::vector<TissuePoint> points;    ///< replace those of the preset at the same landmark
  std::filesystem::path per_vertex;   ///< CSV or PLY, one row per vertex of the scan; empty: none
  std::vector<TissueRegion> regions;  ///< applied in turn
  bool operator==(const TissueFieldOptions&) const = default;

  static constexpr const char* about = "The material.";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.option(HX_MEMBER(uniform[young]),
             "Young's modulus E. The springs of [support] do not scale with it. Where drive.by = "
             "\"muscles\", E rises towards the lips (docs/muscles.md).",
             parameter_details(young));
    v.option(HX_MEMBER(uniform[poisson]),
             "Poisson's ratio. With tissue.element = \"tet4\" the tissue moves too little near "
             "0.5.",
             parameter_details(poisson));
    v.option(HX_MEMBER(uniform[viscosity]), "Viscosity eta, of changes of shape.",
             parameter_details(viscosity));
    v.option(HX_MEMBER(uniform[density]), "Density.", parameter_details(density));
    v.option(HX_MEMBER(preset),
             "Published parameters by name (hyperex presets lists them with their sources); keys "
             "given here replace its values. Empty: none.");
    v.option(HX_MEMBER(interpolation),
             "How parameters at points are interpolated over the face: as a harmonic field on the "
             "skin, or linearly over triangles of points in the frontal view (docs/tissue.md).");
    v.option(HX_MEMBER(mirror),
             "Entries of [[tissue.point]] and [[tissue.region]] for one side are mirrored to the "
             "other.");
    v.option(HX_MEMBER(per_vertex),
             "Parameters for each vertex of the scan: a CSV file with columns young_kpa, "
             "viscosity_pa_s, poisson or density_kg_m3 and one row per vertex, or a PLY file with "
             "such vertex properties. An empty cell (in PLY: nan) keeps the value that the other "
             "keys give.");
    v.option(
        HX_MEMBER(layers),
        "A layer of the tissue, from the skin inwards, with values of its own in place of the "
        "uniform ones; points and regions change them afterwards. Under layers that all have a "
        "thickness the tissue is uniform. One or more here replace all layers of the preset.",
        {.key = "layer"});
    v.option(HX_MEMBER(points),
             "Parameters at a landmark, interpolated over the face instead of the uniform ones. At "
             "least one of them must be given.",
             {.key = "point"});
    v.option(HX_MEMBER(regions),
             "A change within a part of the face, applied after the points and in the order of the "
             "file: values, factors or added volume in a named or painted region or along a scar.",
             {.key = "region"});
  }
};

/// A problem with one of the options: `key` is "preset", "point[1].side", "region[0].name".
struct FieldProblem {
  std::string key, expected;
  std::string value = {};  ///< the value given, in quotes; empty: not stated in the message
};

}  // namespace hyperex::tissue
