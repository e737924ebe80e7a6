// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Landmarks that the canonical face knows, on both faces.
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::anatomy {

/// One row per landmark, in the order of the names.
struct KnownLandmarks {
  std::vector<std::string> names;
  Points canonical, given;  ///< metres of either face
};

KnownLandmarks known_landmarks(const io::Landmarks& given);

}  // namespace hyperex::anatomy
