// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>

#include "hyperex/scene/scene.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/tissue/mesh/volume_mesh.hpp"

namespace hyperex::session {

/// The expected cost of a run with all its outputs.
struct RunCost {
  double frames = 0;                        ///< of each face
  double variants = 0;                      ///< besides base
  double disk_bytes = 0, frames_bytes = 0;  ///< in all; of them frames/, for ParaView
  double memory_bytes = 0;
  /// On two idle processors, correct to a factor of about two, and the part of the variants; 0:
  /// unknown, as at finite strain or with contact.
  double seconds = 0, variants_seconds = 0;
};

/// `volume`: of the face, once it is meshed; null: its size is estimated from the area of the scan.
/// Nothing where the length of the run is unknown, as for a camera's recording that was not read
/// whole.
std::optional<RunCost> expected_cost(const scene::Scene& scene, const Inputs& inputs, Extent extent,
                                     const tissue::VolumeMesh* volume = nullptr);

/// "a run takes about 1201 frames, 0.97 GB on disk (0.94 GB of it frames/, for ParaView), ..."
std::string sentence_of(const RunCost& cost);

/// Throws InputError where the run would write more than output.most_gb.
void check_disk(const scene::Scene& scene, const RunCost& cost);

}  // namespace hyperex::session
