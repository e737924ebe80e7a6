// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::metrics {

/// Vertices of a scan that belong to a part of the face.
struct Region {
  std::string name;
  std::vector<int> vertices;  ///< ascending
};

struct Regions {
  /// The regions that could be defined and are not empty, in the order below.
  std::vector<Region> regions;
  std::vector<std::string> notes;  ///< substitute landmarks and omitted regions, one sentence each
  const Region* find(const std::string& name) const;  ///< nullptr where there is none
};

/// Regions of a face on a scan at rest, defined by straight-line distance to landmarks (numbers are
/// iBUG-68 points):
///   face      within 40 mm of any of ibug68_0 to 67
///   lips      within 15 mm of 48-67
///   nose      within 12 mm of 27-35, alare_L, alare_R or pronasale; not lips
///   cheeks    within 22 mm of cheek_L or cheek_R; not lips
///   eyes      within 12 mm of 36-47; not lips, not nose
///   forehead  within 35 mm of 17-26 and above the nearest of them along the axis of the face (from
///             the middle of 48-67 to that of 36-47); not lips, nose or eyes
///   chin      within 20 mm of 7-9; not lips
///   below_eyes  the part of the face that is lower than 15 mm above the tip of the nose
///             (pronasale, else 30) along the vertical axis of the face (face_frame_of_corners)
/// Cheeks and chin may share vertices with neighbouring regions; the lips share none. If some of
/// the 68 points of a region are absent, the remaining ones are used together with anatomical
/// landmarks: for the lips cheilion, labiale_superius, labiale_inferius, stomion,
/// crista_philtri_inferior (at least four points in all); for the nose subnasale, nasion (two); for
/// the eyes exocanthion, endocanthion, palpebrale_inferius (two); for the forehead glabella; for
/// the chin pogonion, gnathion. For the face, all landmarks are used if none of the 68 is given. A
/// region that cannot be defined is omitted, and `notes` says so.
Regions regions_of(const Points& rest, const io::Landmarks& landmarks);

}  // namespace hyperex::metrics
