// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/motion/stabilise.hpp"
#include "hyperex/motion/still_points.hpp"

namespace hyperex::motion {

/// The motion as it is, with the head's own: no poses, no bounds.
StabilisedMotion with_head_kept(const Motion& motion);

/// A motion whose head pose was taken out where its points allow that.
struct TriedPose {
  StabilisedMotion steady;  ///< with_head_kept() where the pose could not be taken out
  std::string why_not;      ///< one sentence; empty: it was taken out
};

/// stabilise() for a motion whose user named no points of the skull. `still_points`: those that
/// points_to_hold_the_head() found, or empty for all landmarks. `option`: how messages call the
/// option that names others, such as "--rigid-points".
TriedPose try_stabilise(const Motion& motion, const std::vector<std::string>& still_points,
                        const std::string& option);

/// "the head is held by a, b, c, d, which keep still against each other; not used: e (moves by 1.3
/// mm against them)": says which points were found, as the user did not name them. At least one
/// name.
std::string still_points_sentence(const StillPoints& still_points);

/// "the head's pose is that of the face's landmarks, while a, b, c keep still against each other,
/// as points of the skull do, and are not used": of still_points_beside_landmarks().
std::string unused_still_points_sentence(const std::vector<std::string>& still_points);

}  // namespace hyperex::motion
