// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::tissue {

/// Some scans continue behind the lips. At the corners of the mouth the two linings then form a
/// fold narrower than the simulated elements, which would join the lips across it and leave a notch
/// at either end of the opened mouth. Within 12 mm of the inner corners (ibug68_60, 64) this
/// removes triangles on the lips' inner sides: those that the surface hides in more than 90 % of 15
/// directions, up to 31 degrees up and down and 27 to the sides of straight ahead. The slit then
/// ends where the lips visibly part; the removed skin moves with the rim (rim.hpp). Returns the
/// number of triangles removed: 0 where the mouth is closed or nothing is hidden.
int remove_corner_linings(TriMesh& mesh, const io::Landmarks& landmarks);

}  // namespace hyperex::tissue
