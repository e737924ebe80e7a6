// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>

#include "hyperex/anatomy/teeth/dental_arch.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::anatomy {

/// The fit of average arches to a face.
struct TeethFit {
  Teeth teeth;  ///< empty where `why_none` gives a reason
  std::string why_none;
  ArchSize size;
  double behind_lips_m = 0;      ///< upper incisors' edges behind the line where the lips meet: the
                                 ///< rear one of ibug68_62 and 66, on the skin, level in the face
  double least_clearance_m = 0;  ///< of any vertex to the inner surface of lips and cheeks
};

/// The least distance between teeth and tissue at rest.
inline constexpr double kTeethClearance_m = 5e-4;

/// dental_arches() in a face at rest. `skin`: the outer surface of the simulated tissue (its mouth
/// open); `boundary`: the whole surface of that tissue (tissue::boundary_of); `landmarks`: the 68
/// iBUG points. All in the scan's frame, m.
///  * Size: the face's breadth between the outer corners of the eyes over 89.5 mm, the mean of men
///    and women (Farkas, Anthropometry of the Head and Face, 1994), from 0.7 to 1.3. That teeth
///    scale with the face is an assumption.
///  * Mid-line: the mean over landmarks on it and pairs of landmarks beside it.
///  * Height: the upper incisors' edges 3 mm below the edge of the upper lip, where that shows 3.4
///    mm of them in adults below thirty and 1.6 mm below forty (Vig and Brundo, The kinetics of
///    anterior tooth display, J. Prosthet. Dent. 39, 1978, 502).
///  * The plane of occlusion falls by 7 degrees to the front against the normal of the line from
///    nasion to chin: 9.3 degrees against the Frankfort plane, that line being 87.8 degrees against
///    it (Downs, Am. J. Orthod. 34, 1948, 812).
///  * The lower arch is opened about the axis through the condyles (between ibug68_1 and 15) until
///    its incisors' edges stand 0.5 mm above the lower lip's (the same source), by 0.5 mm at least.
///  * The rows are as far forward as kTeethClearance_m to the tissue allows. Where the cheeks limit
///  this, the
///    arch is made narrower if that lets it come forward by more than half of what it loses in
///    breadth.
/// None where the mouth is no opening in the mesh, landmarks are missing, or no place is found
/// within 25 mm behind the lips.
TeethFit fit_teeth(const TriMesh& skin, const TriMesh& boundary, const io::Landmarks& landmarks);

}  // namespace hyperex::anatomy
