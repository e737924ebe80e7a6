// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include "hyperex/ct/volume.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::ct {

/// Points in the midline that the shape alone gives, in the frame of a face.
struct FoundPoints {
  io::Landmarks skin;  ///< pronasale, and subnasale, nasion and pogonion where they were found
  std::optional<Vec3> bone_pogonion_m, bone_menton_m;
};

/// Looks at the head from the front (along -z), through the volume `head` at `skin_hu`:
///   pronasale  most forward of all, in the middle of the patch within 0.3 mm of it;
///              none within 10 mm of the skin's upper and lower end
///   subnasale  deepest point of the midline within 30 mm below it
///   nasion     deepest point of the midline 18 to 75 mm above it; none where that is an end of it
///   pogonion   the first most forward point of the midline above the lowest point of the chin's
///              bone (menton), or where it rises least within 30 mm; in the middle of the stretch
///              within 0.3 mm of it. Needs the mandible
/// The head must be upright to about 20 degrees. `mandible` may be without triangles.
FoundPoints find_points(const Volume& head, double skin_hu, const TriMesh& skin,
                        const TriMesh& mandible);

}  // namespace hyperex::ct
