// SPDX-License-Identifier: GPL-3.0-or-later
// Tissue that differs from place to place: layers, points, regions, scars, presets.
#include "hyperex/tissue/field/tissue_field.hpp"

#include "hyperex/session/thinned_scan.hpp"
#include "hyperex/session/unknown_names.hpp"
#include "hyperex/simulate/options.hpp"
#include "meshes.hpp"
#include "options_class.hpp"

namespace hyperex::python {
namespace {

using namespace tissue;

void refuse_if_any(const std::vector<FieldProblem>& found) {
  std::vector<InputProblem> problems;
  for (const FieldProblem& p : found)
    problems.push_back({{},
                        0,
                        "tissue." + p.key,
                        p.value,
                        p.expected + session::did_you_mean_region(p.key, p.value)});
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
  values.volume_ratio = std::move(field.volume_ratio);
  return values;
}

}  // namespace

void bind_tissue_field(py::module_& m) {
  OptionsClass<TissuePoint>(m, "TissuePoint");
  OptionsClass<TissueLayer>(m, "TissueLayer");
  OptionsClass<TissueRegion>(m, "TissueRegion");
  OptionsClass<TissueFieldOptions>(m, "TissueFieldOptions");
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
