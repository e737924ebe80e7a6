// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/io/landmarks.hpp"
#include "hyperex/tissue/options.hpp"

namespace hyperex::tissue {

/// A point of the scene or of the preset at one landmark.
struct ResolvedPoint {
  std::string landmark;  ///< with its side
  GivenParameters value{};
  std::string key;  ///< "point[2]" or "preset"
};

/// "L", "R", or "" in the middle; for an unknown name by its ending _L or _R.
std::string side_of_landmark(const std::string& name);

/// The points of `options` at landmarks: a paired name without a side stands for both; with
/// options.mirror each also holds for its counterpart. Adds to `problems`: unknown landmarks, a
/// side that contradicts the name, a landmark on the wrong side of the face's middle (2 mm of
/// slack), two values for one landmark.
std::vector<ResolvedPoint> resolve_points(const TissueFieldOptions& options,
                                          const io::Landmarks& landmarks,
                                          std::vector<FieldProblem>& problems);

}  // namespace hyperex::tissue
