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

/// The results that depend only on the scan, its landmarks and the options of the mesh.
struct PreparedFace {
  std::shared_ptr<const tissue::TissueMesh> mesh;
  metrics::RestAsymmetry at_rest;
};

/// metrics::rest_asymmetry() of the skin, with the two lips distinguished.
metrics::RestAsymmetry rest_asymmetry(const tissue::TissueMesh& mesh, const Inputs& inputs);

/// The tissue's mesh and the face's own asymmetry: from scene.kept where an earlier run kept it
/// (the log reports that), else made and kept there. Where the scan is thinned, inputs.scan becomes
/// the thinned one. `skin_known` is called after that and may start work that needs the scan.
/// Throws as tissue::build_tissue_mesh().
PreparedFace prepare_face(const scene::Scene& scene, Inputs& inputs,
                          const std::function<void()>& skin_known);

/// To bytes and back, bit for bit; nothing where the bytes hold no face.
std::string bytes_of(const PreparedFace& face);
std::optional<PreparedFace> prepared_face_from(const std::string& bytes);
/// Whether every index in it is in range, and its sizes fit this scan.
bool fits(const PreparedFace& face, const TriMesh& scan);

}  // namespace hyperex::session
