// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/metrics/midsagittal.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/simulate/run/simulator.hpp"
#include "hyperex/tissue/field/tissue_field.hpp"

namespace hyperex::session {

/// A run's mirrored twin: the same mesh, supports and driven points with the motion and the tissue
/// mirrored in the face's midsagittal plane. Its use: metrics/mesh_floor.hpp.
struct MirroredTwin {
  std::string why_not;       ///< a sentence where there is no twin, else empty
  motion::Motion landmarks;  ///< as Performance::landmarks of the run, same names and times
  std::vector<PointsF> skin_displacement_m;
  PointsF neutral_displacement_m;                  ///< Performance::neutral_displacement_m
  std::shared_ptr<simulate::Simulator> simulator;  ///< of the mirrored motion; null: no twin
};

/// Each point moves as the mirror image of its counterpart: with M its reflection's linear part,
/// x_i(t) = x_i(0) + M (x_m(i)(t) - x_m(i)(0)). The counterpart is the landmark with the mirrored
/// name, else the point nearest to the reflected place, within 5 mm. Points without one keep their
/// motion. Where one of `needed` (names) has none there is no mirrored motion, and `why_not` gives
/// the reason.
std::optional<simulate::AlignedMotion> mirrored_motion(const simulate::AlignedMotion& motion,
                                                       const metrics::MidsagittalPlane& plane,
                                                       const std::vector<std::string>& needed,
                                                       std::string& why_not);

/// Every tetrahedron takes the field at the point of the skin nearest to its reflected centroid.
/// Layers lie as deep on either side: it keeps its own share of each.
void take_mirrored(const tissue::TissueField& field, const tissue::TissueMesh& mesh,
                   const metrics::MidsagittalPlane& plane, simulate::TissueValues& values);

/// `field`: where the run's tissue differs from place to place, else null. Uses the reduced model,
/// whatever the run uses. `run`: a simulator of the run's mesh and motion, whose stages it reuses.
/// Throws NumericalError as Simulator::run(), and Cancelled after `cancelled` returned true.
MirroredTwin simulate_twin(const scene::Scene& scene, const Inputs& inputs,
                           const tissue::TissueField* field, const metrics::MidsagittalPlane& plane,
                           const simulate::Simulator& run,
                           const std::function<bool()>& cancelled = {});

/// The twin of a variant, with the stages and the load of base's twin where there is one. `run`:
/// the variant's simulator, which is finished; its factor is reused.
MirroredTwin simulate_variants_twin(const scene::Scene& scene, const Inputs& inputs,
                                    const tissue::TissueField* field,
                                    const metrics::MidsagittalPlane& plane,
                                    simulate::Simulator& run, const MirroredTwin& of_base,
                                    const std::function<bool()>& cancelled = {});

}  // namespace hyperex::session
