// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/core/note.hpp"
#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::anatomy {

struct CompletedLandmarks {
  io::Landmarks landmarks;          ///< those given, unchanged, and those placed
  std::vector<std::string> placed;  ///< sorted
};

/// Adds the landmarks that are not given. The canonical face is registered to the scan
/// (register_canonical_face) and corrected by radial basis functions so that it passes through the
/// given landmarks. Each missing landmark is the point of the scan closest to its position on the
/// registered face. `source` is the file to name in errors. Throws InputError, all problems at
/// once:
///  * landmarks in other axes than the scan's (negated_axes_problem);
///  * a given landmark farther than 15 mm from the scan's surface, named with the distance; where
///    they are those of one side, one sentence (half_missing_problem);
///  * left and right exchanged: of one pair (the fit is far better with the pair exchanged back),
///    or of all (the face then looks into the scan, as it does where the scan's triangles are
///    inside out);
///  * a landmark 4 cm or more from the place that all the others predict; where the scan has no
///    depth, that (flat_problem);
///  * landmarks of the fold from nose to mouth in wrong places (fold_landmark_problems);
///  * something is missing and fewer than three of the given are known to the canonical face, or
///    they lie nearly on a line; or a missing one is unknown to it.
CompletedLandmarks complete_landmarks(const io::Landmarks& given,
                                      const std::vector<std::string>& needed, const TriMesh& scan,
                                      const std::string& source = "landmarks");

/// The same for all landmarks that the canonical face knows. A simulation needs these.
CompletedLandmarks complete_landmarks(const io::Landmarks& given, const TriMesh& scan,
                                      const std::string& source = "landmarks");

/// The names of `given` that are not known (face::is_known_landmark): the user's own, or misspelt.
std::vector<std::string> unknown_landmarks(const io::Landmarks& given);

/// `landmarks.unknown` for such names (one or more): lists some of them, and where to find the
/// known names.
Note unknown_landmarks_note(const std::vector<std::string>& names);

}  // namespace hyperex::anatomy
