// SPDX-License-Identifier: GPL-3.0-or-later
// Tissue that differs from place to place: points, regions, scars, presets.
#include "hyperex/tissue/field/tissue_field.hpp"

#include "hyperex/session/thinned_scan.hpp"
#include "hyperex/simulate/options.hpp"
#include "meshes.hpp"
#include "options_class.hpp"

namespace hyperex::python {
namespace {

using namespace tissue;

void refuse_if_any(const std::vector<FieldProblem>& found) {
  std::vector<InputProblem> problems;
  for (const FieldProblem& p : found)
    problems.push_back({{}, 0, "tissue." + p.key, "", p.expected});
  if (!problems.empty()) throw InputError(problems);
}

simulate::TissueValues field_of(const SharedTissueMesh& mesh, const Face& face,
                                const TissueFieldOptions& options) {
  refuse_if_any(problems_of(options, face.landmarks));
  simulate::TissueValues values;
  values.uniform = uniform_parameters(options);
  if (!is_graded(options)) return values;
  std::optional<anatomy::RegisteredFace> registered;
  if (needs_registration(options))
    registered = anatomy::register_canonical_face(
        face.landmarks, mesh->full ? session::thinned_scan(face.scan, *mesh->full, mesh->skin).mesh
                                   : face.scan.mesh);
  // Files a vertex name the scan's own vertices, also of a scan that was thinned.
  const TissueMesh whole = mesh->full ? tissue::with_full_skin(*mesh) : TissueMesh{};
  const TissueFieldMaker maker(mesh->full ? whole : *mesh, face.landmarks,
                               registered ? &*registered : nullptr);
  TissueField field = maker.make(options);
  if (mesh->full) session::keep_thinned(field, *mesh->full);
  values.element = std::move(field.element);
  return values;
}

/// None, or a number.
template <class T>
void given(OptionsClass<T>& options, const char* name, GivenParameters T::*member, Parameter p,
           const char* doc) {
  options.custom(
      name, [=](const T& self) { return py::cast((self.*member)[p]); },
      [=](T& self, py::handle value) { (self.*member)[p] = value.cast<std::optional<double>>(); },
      doc);
}
template <class T>
void given_values(OptionsClass<T>& options, GivenParameters T::*member) {
  given(options, "young_pa", member, young, "Pa, or None.");
  given(options, "viscosity_pa_s", member, viscosity, "Pa s, or None.");
  given(options, "poisson", member, poisson, "Or None.");
  given(options, "density_kg_m3", member, density, "kg / m^3, or None.");
}

void bind_parts(py::module_& m) {
  OptionsClass<TissuePoint> point(m, "TissuePoint", "The tissue at a landmark.");
  point.field("landmark", &TissuePoint::landmark, "Its name.")
      .field("side", &TissuePoint::side, "L, R, or empty: as the name says, else both.");
  given_values(point, &TissuePoint::value);
  OptionsClass<TissueRegion> region(m, "TissueRegion", "A change within a part of the skin.");
  region.field("name", &TissueRegion::name, "Of facial_regions(); or")
      .list("scar", &TissueRegion::scar, "two or more landmarks along a line; or")
      .list("scar_points_m", &TissueRegion::scar_points_m, "places along it, metres; or")
      .field("painted", &TissueRegion::painted,
             "a file of weights from 0 to 1, a row a vertex of the scan, or the scan painted red.")
      .field("width_m", &TissueRegion::width_m, "Of a scar.")
      .field("blend_m", &TissueRegion::blend_m, "From nothing to the whole change.");
  given_values(region, &TissueRegion::value);
  given(region, "young_factor", &TissueRegion::factor, young, "Multiplies, or None.");
  given(region, "viscosity_factor", &TissueRegion::factor, viscosity, "Multiplies, or None.");
}

}  // namespace

void bind_tissue_field(py::module_& m) {
  bind_parts(m);
  OptionsClass<TissueFieldOptions> options(m, "TissueFieldOptions",
                                           "What makes the tissue differ from place to place.");
  given_values(options, &TissueFieldOptions::uniform);
  options.field("preset", &TissueFieldOptions::preset, "Of tissue_presets(); empty: none.")
      .word("interpolation", &TissueFieldOptions::interpolation,
            {{"harmonic", Interpolation::harmonic}, {"linear", Interpolation::linear}},
            "harmonic or linear.")
      .field("mirror", &TissueFieldOptions::mirror, "What is given for one side holds for both.")
      .list("points", &TissueFieldOptions::points, "TissuePoints.")
      .field("per_vertex", &TissueFieldOptions::per_vertex,
             "A file of values, a row a vertex of the scan; empty: none.")
      .list("regions", &TissueFieldOptions::regions, "TissueRegions, applied in turn.");
  m.def("tissue_field", &field_of, "mesh"_a, "face"_a, "options"_a, Unlocked(),
        "The Tissue that these options give on a mesh, for Simulator.set_tissue().");
  m.def(
      "tissue_presets",
      [] {
        std::map<std::string, std::string> all;
        for (const TissuePreset& preset : tissue_presets()) all[preset.name] = preset.summary;
        return all;
      },
      "Published parameters: name -> what they are.");
}

}  // namespace hyperex::python
