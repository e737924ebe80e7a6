// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "hyperex/anatomy/teeth/teeth.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::session {

/// The scans that teeth.upper and teeth.lower name, closed (close_mesh), as crowns; notes say what
/// was closed. `scan_unit`: used where teeth.unit = "scan". `landmarks`: of the face; empty where
/// they are unknown. Throws InputError where a file cannot be read or closed, or its mesh does not
/// lie in the mouth.
anatomy::Teeth read_teeth(const scene::Scene& scene, io::LengthUnit scan_unit,
                          const io::Landmarks& landmarks, std::vector<Note>& notes);

/// The teeth of a face: inputs.teeth and, for jaws without a scan, average arches
/// (anatomy::fit_teeth) where teeth.shape requests them; null where there are none. Notes say how
/// the arches were fitted, or why there are none.
std::shared_ptr<const anatomy::Teeth> teeth_of(const scene::Scene& scene, const Inputs& inputs,
                                               const tissue::TissueMesh& mesh,
                                               std::vector<Note>& notes);

}  // namespace hyperex::session
