// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/anatomy/teeth/teeth.hpp"
#include "hyperex/face/face_frame.hpp"

namespace hyperex::anatomy {

/// The least distance of a tongue from crowns and gums at rest.
inline constexpr double kTongueClearance_m = 1.2e-3;

/// A tongue at rest inside the lower row, scan frame, a closed smooth surface that moves with the
/// lower row: a blunt tip behind and 2 mm under the incisors' edges, a back that is domed along the
/// row and has a shallow groove in the middle, falling to the throat behind the molars. It keeps
/// kTongueClearance_m from every vertex of both rows. Only for display: all its dimensions are
/// assumed. Empty if there is no lower row, or less space than 12 mm by 18 mm inside it, as in a
/// solid scan.
TriMesh tongue_in(const Teeth& teeth, const face::FaceFrame& face);

}  // namespace hyperex::anatomy
