// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/core/note.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/session/variants.hpp"
#include "hyperex/simulate/run/simulator.hpp"

namespace hyperex::session {

/// A mesh of this many nodes takes about 3 s on two idle processors: as long as a check may.
inline constexpr double kMostTriedNodes = 40000;
/// A scan of more vertices takes longer to prepare, whatever the mesh.
inline constexpr Eigen::Index kMostTriedVertices = 300000;

/// Does what a run does before it assembles matrices: the mesh, the tissue on it, what moves the
/// face, and the same of each variant. Throws InputError, in a run's words, with what a run refuses
/// by then. Returns the mesh's notes. Where the scan or the mesh would be larger than the bounds
/// above, nothing is done and a note says so. Of a camera's recording the points are not tried, as
/// Extent::searched reads one frame of it. `inputs`: of read_inputs(), with landmarks.
std::vector<Note> try_face(const scene::Scene& scene, Inputs inputs);

/// Throws InputError where the run of base or of a variant would because of points, muscles, the
/// jaw or the number of steps, and assembles nothing: milliseconds for each face. A session asks
/// this before it assembles matrices, and a check asks the same.
void check_faces_before_run(simulate::Simulator& base, const std::vector<VariantRun>& runs);

}  // namespace hyperex::session
