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
  std::vector<Region> regions;     ///< those that could be defined and are not empty, in this order
  std::vector<std::string> notes;  ///< stand-ins used and regions left out, a sentence each
  const Region* find(const std::string& name) const;  ///< nullptr where there is none
};

/// Parts of the face on a scan at rest, by distance to landmarks (straight, not along the skin):
///   face      within 40 mm of any of ibug68_0 to 67
///   lips      within 15 mm of 48-67
///   nose      within 12 mm of 27-35, alare_L, alare_R or pronasale; not lips
///   cheeks    within 22 mm of cheek_L or cheek_R; not lips
///   eyes      within 12 mm of 36-47; not lips, not nose
///   forehead  within 35 mm of 17-26, above the nearest of them along the face's axis (from the
///   middle
///             of 48-67 to that of 36-47); not lips, nose or eyes
///   chin      within 20 mm of 7-9; not lips
///   below_eyes  of the face, what lies lower than 15 mm above the tip of the nose (pronasale, else
///             30) along the face's axis
///             (face_frame_of_corners)
/// Cheeks and chin may share vertices with neighbours; the lips share none. Where some of the 68
/// are absent, those that are there are used, and where a region has none or too few, anatomical
/// names: lips by cheilion, labiale_superius, labiale_inferius, stomion, crista_philtri_inferior
/// (at least four points), nose by pronasale, subnasale, alare, nasion (two), eyes by exocanthion,
/// endocanthion, palpebrale_inferius (two), forehead by glabella, chin by pogonion, gnathion; face
/// by all landmarks given. What cannot be defined is left out; `notes` says so.
Regions regions_of(const Points& rest, const io::Landmarks& landmarks);

}  // namespace hyperex::metrics
