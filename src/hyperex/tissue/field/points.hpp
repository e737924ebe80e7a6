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

/// The side of a landmark: "L", "R", or "" for the middle. For an unknown name it is given by the
/// ending _L or _R.
std::string side_of_landmark(const std::string& name);

/// The points of `options`, one per landmark. A paired name without a side means both landmarks.
/// With options.mirror, each point also applies to its counterpart. Adds to `problems` unknown
/// landmarks, sides that contradict the name, landmarks on the wrong side of the midline (by more
/// than 2 mm), and landmarks with two values.
std::vector<ResolvedPoint> resolve_points(const TissueFieldOptions& options,
                                          const io::Landmarks& landmarks,
                                          std::vector<FieldProblem>& problems);

}  // namespace hyperex::tissue
