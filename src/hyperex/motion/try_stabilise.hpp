// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/motion/stabilise.hpp"

namespace hyperex::motion {

/// The motion as it is, with the head's own: no poses, no bounds.
StabilisedMotion with_head_kept(const Motion& motion);

/// A motion whose head pose was taken out where its points allow that.
struct TriedPose {
  StabilisedMotion steady;  ///< with_head_kept() where the pose could not be taken out
  std::string why_not;      ///< one sentence; empty: it was taken out
};

/// stabilise() for a motion whose user named no points of the skull. `still_points`: those that
/// proposed_rigid_points() found, or empty for all landmarks. `option`: how messages call the
/// option that names others, such as "--rigid-points".
TriedPose try_stabilise(const Motion& motion, const std::vector<std::string>& still_points,
                        const std::string& option);

/// "head pose: taken out by a, b, c, d, which keep their distances from each other, as points of
/// the skull do": says which points were found, as the user did not name them.
std::string still_points_sentence(const std::vector<std::string>& still_points);

/// "the head's pose is that of the face's landmarks, while a, b, c keep their distances from each
/// other, as points of the skull do, and are not used": of still_points_beside_landmarks().
std::string unused_still_points_sentence(const std::vector<std::string>& still_points);

}  // namespace hyperex::motion
