// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::tissue {

/// Some scans go on behind the lips. At the corners of the mouth both linings lie on each other in
/// a fold narrower than the simulated elements, which would join the lips across it: the opened
/// mouth then keeps a notch at either end. Within 12 mm of the inner corners (ibug68_60, 64) this
/// gives up what lies on the lips' inner sides: what the surface hides in more than nine of ten of
/// 15 directions, up to 31 degrees up and down and 27 to the sides of straight ahead. The slit then
/// ends where the lips are seen to part; what was given up moves with the rim (rim.hpp).
/// Returns the number of triangles given up: 0 where the mouth is closed or nothing is hidden.
int give_up_corner_linings(TriMesh& mesh, const io::Landmarks& landmarks);

}  // namespace hyperex::tissue
