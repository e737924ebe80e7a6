// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "hyperex/metrics/asymmetry.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::session {

/// What rests on the scan, its landmarks and the options of the mesh alone.
struct PreparedFace {
  std::shared_ptr<const tissue::TissueMesh> mesh;
  metrics::RestAsymmetry at_rest;
};

/// metrics::rest_asymmetry() of the skin, its lips told apart.
metrics::RestAsymmetry rest_asymmetry(const tissue::TissueMesh& mesh, const Inputs& inputs);

/// The tissue's mesh and the face's own asymmetry: from scene.kept where an earlier run kept it
/// (the log says so), else made and kept there. Where the scan had to be thinned, inputs.scan is
/// the thinned one from then on. `skin_known` is called once that is settled and may start what
/// needs the scan. Throws as tissue::build_tissue_mesh().
PreparedFace prepare_face(const scene::Scene& scene, Inputs& inputs,
                          const std::function<void()>& skin_known);

/// As bytes and back, bit for bit; nothing where the bytes are not of this.
std::string bytes_of(const PreparedFace& face);
std::optional<PreparedFace> prepared_face_from(const std::string& bytes);
/// Whether every index in it is one of what it counts, and its sizes are those of this scan.
bool fits(const PreparedFace& face, const TriMesh& scan);

}  // namespace hyperex::session
