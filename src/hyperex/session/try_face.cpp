// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/try_face.hpp"

#include <fmt/format.h>

#include <string>

#include "hyperex/core/progress.hpp"
#include "hyperex/session/drive_choice.hpp"
#include "hyperex/session/driven_points.hpp"
#include "hyperex/session/face_options.hpp"
#include "hyperex/session/plausible.hpp"
#include "hyperex/session/prepared_face.hpp"
#include "hyperex/session/run_cost.hpp"
#include "hyperex/simulate/run/simulator.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::session {
namespace {

double expected_nodes(const scene::Scene& scene, const Inputs& inputs) {
  return tissue::expected_surface_nodes(inputs.scan.mesh, inputs.landmarks, scene.mesh) *
         (scene.mesh.layers + 1);
}

/// `what`: "a mesh of about 60000 nodes".
Note unchecked_mesh(const std::string& what) {
  return make_note("mesh.unchecked",
                   fmt::format("not checked, as {} takes long: whether it can be made, and the "
                               "tissue and the driven points on it",
                               what));
}

PreparedFace meshed_face(const scene::Scene& scene, Inputs& inputs) {
  Progress progress("meshing the soft tissue", 0);
  return prepare_face(scene, inputs, [] {});
}

}  // namespace

void check_faces_before_run(simulate::Simulator& base, const std::vector<VariantRun>& runs) {
  base.check_before_run();
  for (const VariantRun& run : runs) {
    simulate::Simulator own = base;
    own.set_options(run.options);
    own.check_before_run();
  }
}

std::vector<Note> try_face(const scene::Scene& given, Inputs inputs) {
  if (const Eigen::Index vertices = inputs.scan.mesh.points.rows(); vertices > kMostTriedVertices)
    return {unchecked_mesh(fmt::format("meshing a scan of {} vertices", vertices))};
  if (const double nodes = expected_nodes(given, inputs); nodes > kMostTriedNodes)
    return {unchecked_mesh(fmt::format("a mesh of about {:.0f} nodes", nodes))};
  scene::Scene scene = given;
  scene.drive.by = drive_choice(given).by;
  inputs.driven = driven_points(scene, inputs.motion.motion);
  const PreparedFace face = meshed_face(scene, inputs);
  TissueFields fields(inputs, *face.mesh);
  const FaceOptions options = face_options(scene, inputs, fields);
  simulate::Simulator simulator(face.mesh, inputs.landmarks, inputs.motion, options.base);
  if (scene.motion.recording.empty()) check_faces_before_run(simulator, options.runs);
  checked_cost(given, inputs, Extent::quick, &face.mesh->volume);
  std::vector<Note> notes = face.mesh->notes;
  append(notes, notes_on_tissue(options.field, options.runs));
  add(notes, skin_warning(skin_off_scan(*face.mesh, inputs.landmarks)));
  return notes;
}

}  // namespace hyperex::session
