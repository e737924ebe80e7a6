// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "hyperex/core/note.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/tissue/mesh/volume_mesh.hpp"

namespace hyperex::session {

/// The expected cost of a run with all its outputs.
struct RunCost {
  double frames = 0;     ///< of each face
  double nodes = 0;      ///< of the mesh
  bool guessed = false;  ///< nodes without the scan's landmarks or its mesh
  double variants = 0;   ///< besides base
  /// Of the first and the last frame in the recording, from its start. The end of the run itself
  /// makes no frame: of 1 s at 30 Hz the last one is at 0.967 s.
  double from_s = 0, to_s = 0;
  double lead_s = 0;                          ///< before from_s, in which the face is led from rest
  double disk_bytes = 0, frames_bytes = 0;    ///< in all; of them frames/, for ParaView
  double memory_bytes = 0, motion_bytes = 0;  ///< in all; of them the motion of all faces
  /// On two idle processors, correct to a factor of about two, and the part of the variants; 0:
  /// unknown, as at finite strain. Without contact. Noise of the driven points counts where the
  /// whole recording was read.
  double seconds = 0, variants_seconds = 0;
  double budget_seconds = 0;   ///< part of output.error_budget in `seconds`; 0: none
  double contact_seconds = 0;  ///< besides, where something touches in every frame; 0: no contact
};

/// `volume`: of the face, once it is meshed; null: its size is estimated from the area of the scan.
/// Nothing where the length of the run is unknown.
std::optional<RunCost> expected_cost(const scene::Scene& scene, const Inputs& inputs, Extent extent,
                                     const tissue::VolumeMesh* volume = nullptr);

/// The same of a new scene, without tracking a face. Throws InputError where its files are wrong.
std::optional<RunCost> cost_before_tracking(const scene::Scene& scene);

/// "a run: 1200 frames, from 0 s to 39.97 s of the recording; about 0.97 GB on disk (frames/, for
/// ParaView: 0.94 GB), ..."
std::string sentence_of(const RunCost& cost);

/// Throws InputError if the run would write more than output.most_gb or take more memory than
/// output.most_memory_gb. If `notes` contains a doubt about the unit of the recording's times, the
/// message is about that.
void check_cost(const scene::Scene& scene, const RunCost& cost,
                const std::vector<Note>& notes = {});

/// The least output.vtu_every with which the run stays below output.most_gb with a fifth to spare.
/// 1 where that is so without it, and where frames for ParaView are not what takes the space.
int vtu_every_within_bound(const scene::Scene& scene, const RunCost& cost);

/// expected_cost(), after check_cost().
std::optional<RunCost> checked_cost(const scene::Scene& scene, const Inputs& inputs, Extent extent,
                                    const tissue::VolumeMesh* volume = nullptr);

}  // namespace hyperex::session
