// SPDX-License-Identifier: GPL-3.0-or-later
// Scene files: what `hyperex run` and `hyperex check` do, and the parts of it.
#include "hyperex/scene/scene.hpp"

#include <utility>

#include "bind.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/run/pipeline.hpp"
#include "hyperex/session/drive_choice.hpp"
#include "hyperex/session/mirrored_twin.hpp"
#include "hyperex/session/obstacles.hpp"
#include "hyperex/session/plausible.hpp"
#include "hyperex/session/prepared_face.hpp"
#include "hyperex/session/simulation_options.hpp"
#include "hyperex/session/teeth.hpp"
#include "hyperex/session/thinned_scan.hpp"
#include "hyperex/session/tissue_fields.hpp"
#include "meshes.hpp"
#include "obstacles.hpp"

namespace hyperex::python {
namespace {

using Path = std::filesystem::path;

/// {"tissue.young_kpa": 300} as "tissue.young_kpa=300"; JSON's scalars and lists are TOML's.
std::vector<std::string> overrides_of(const py::dict& changes) {
  const py::object dumps = py::module_::import("json").attr("dumps");
  std::vector<std::string> list;
  for (const auto& [key, value] : changes)
    list.push_back(key.cast<std::string>() + "=" + dumps(value).cast<std::string>());
  return list;
}

py::object run(const Path& file, const Path& out, const py::dict& changes) {
  const std::vector<std::string> overrides = overrides_of(changes);
  std::string summary;
  {
    const py::gil_scoped_release unlocked;
    summary = run::run_scene(scene::read_scene(file, overrides), out)
                  .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }
  return py::module_::import("json").attr("loads")(summary);
}

/// What a scene names, read and made ready.
struct ReadyScene {
  scene::Scene scene;
  session::Inputs inputs;
  Face face;
  SharedTissueMesh mesh;
  simulate::SimulationOptions options;
  Obstacles obstacles;  ///< that the scene or one of its variants may touch
  std::vector<std::pair<std::string, simulate::SimulationOptions>> variants;
};

std::unique_ptr<ReadyScene> made_ready(const Path& file, const std::vector<std::string>& changes) {
  auto ready = std::make_unique<ReadyScene>();
  ready->scene = scene::read_scene(file, changes);
  // The program warns; here nobody may look at warnings.
  if (const std::string idle = session::idle_law_warning(ready->scene); !idle.empty())
    throw InputError(file, idle + ": set tissue.strain = \"finite\", or leave them out");
  session::Inputs& inputs = ready->inputs = session::read_inputs(ready->scene);
  session::choose_drive(ready->scene, inputs);
  ready->mesh = std::make_shared<tissue::TissueMesh>(
      tissue::build_tissue_mesh(inputs.scan.mesh, inputs.landmarks, ready->scene.mesh,
                                inputs.scan.file.string(), session::on_seams(inputs.scan)));
  ready->face = {inputs.scan, inputs.landmarks, inputs.placed};
  if (ready->mesh->full)
    inputs.scan = session::thinned_scan(inputs.scan, *ready->mesh->full, ready->mesh->skin);
  session::TissueFields fields(inputs, *ready->mesh);
  const auto options_of = [&](const scene::Scene& s, const session::Inputs& of,
                              const std::string& owner) {
    simulate::SimulationOptions options = session::simulation_options(s, of);
    // A law stands in base for a variant at finite strain.
    if (options.model.strain != simulate::Strain::finite) options.model.law = {};
    if (const auto field = fields.of(s, owner)) options.tissue.element = field->element;
    return options;
  };
  ready->options = options_of(ready->scene, inputs, "");
  const auto teeth = session::teeth_of(ready->scene, inputs, *ready->mesh, inputs.notes);
  ready->obstacles.all = session::obstacles_of(ready->scene, inputs, *ready->mesh, teeth.get());
  for (std::size_t i = 0; i < ready->scene.variants.size(); ++i) {
    const scene::Variant& variant = ready->scene.variants[i];
    ready->variants.emplace_back(
        variant.name, options_of(variant.scene, session::inputs_of_variant(variant.scene, inputs),
                                 "variant[" + std::to_string(i) + "]."));
  }
  return ready;
}

/// Each point moves as the mirror image of its counterpart.
simulate::AlignedMotion mirrored(const ReadyScene& ready) {
  std::string why_not;
  const metrics::MidsagittalPlane plane = session::rest_asymmetry(*ready.mesh, ready.inputs).plane;
  auto motion = session::mirrored_motion(ready.inputs.motion, plane, ready.inputs.driven, why_not);
  if (!motion) throw InputError(ready.scene.file, "the motion has no mirror image: " + why_not);
  return *motion;
}

}  // namespace

void bind_scene(py::module_& m) {
  py::class_<ReadyScene>(m, "Scene",
                         "A scene file, read: face, mesh, motion and options, made ready.")
      .def(py::init([](const Path& file, const py::dict& changes) {
             const std::vector<std::string> overrides = overrides_of(changes);
             const py::gil_scoped_release unlocked;
             return made_ready(file, overrides);
           }),
           "file"_a, "changes"_a = py::dict(),
           "Reads everything that the scene names (a camera's recording is tracked, which takes "
           "long) and meshes the tissue. `changes`: {\"tissue.young_kpa\": 300}.")
      .def_readonly("face", &ReadyScene::face)
      .def_readonly("mesh", &ReadyScene::mesh)
      .def_property_readonly("motion", [](const ReadyScene& s) { return s.inputs.motion; })
      .def_property_readonly("mirrored_motion", &mirrored,
                             "The motion mirrored in the face's midsagittal plane, for a "
                             "simulator's twin: what `twin` of excursions_of() takes.")
      .def_property_readonly(
          "options", [](const ReadyScene& s) { return s.options; }, "SimulationOptions, a copy.")
      .def_readonly("obstacles", &ReadyScene::obstacles,
                    "Teeth and eyeballs, where contact.teeth or contact.eyes asks for them.")
      .def_property_readonly(
          "variants",
          [](const ReadyScene& s) {
            py::dict all;
            for (const auto& [name, options] : s.variants) all[py::str(name)] = py::cast(options);
            return all;
          },
          "Name -> SimulationOptions of each variant, for Simulator.set_options().")
      .def_property_readonly(
          "jitter_m", [](const ReadyScene& s) { return s.inputs.jitter_m; },
          "Of the recorded points; 0: none known.")
      .def_property_readonly("notes", [](const ReadyScene& s) { return s.inputs.notes; })
      .def_property_readonly("warnings", [](const ReadyScene& s) { return s.inputs.warnings; })
      .def(
          "simulator",
          [simulator = py::object(m.attr("Simulator"))](const ReadyScene& s) {
            py::object made = simulator(s.mesh, s.inputs.landmarks, s.inputs.motion, s.options);
            made.attr("set_obstacles")(s.obstacles);
            return made;
          },
          "A Simulator of the scene, without its variants.");
  m.def("run_scene", &run, "file"_a, "out"_a, "changes"_a = py::dict(),
        "What `hyperex run` does: writes all outputs into the folder `out` and returns the content "
        "of summary.json as a dict. `changes`: {\"tissue.young_kpa\": 300}. Ctrl-C ends it when it "
        "is done.");
  m.def(
      "check_scene",
      [](const Path& file, const py::dict& changes) {
        const std::vector<std::string> overrides = overrides_of(changes);
        run::Checked checked;
        {
          const py::gil_scoped_release unlocked;
          checked = run::check_scene(scene::read_scene(file, overrides));
        }
        return py::dict("notes"_a = checked.notes, "warnings"_a = checked.warnings);
      },
      "file"_a, "changes"_a = py::dict(),
      "What `hyperex check` does: reads everything, simulates nothing; {notes, warnings}.");
}

}  // namespace hyperex::python
