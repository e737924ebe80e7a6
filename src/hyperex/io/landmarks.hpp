// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/scan.hpp"

namespace hyperex::io {

/// Name -> position in the scan's frame, metres. Names as in docs/landmarks: "exocanthion_R",
/// "ibug68_48" ... ; L and R are the subject's own sides.
using Landmarks = std::map<std::string, Vec3>;

/// Reads {"units": "mm", "points": {"NAME": [x, y, z], ...}} or 3D Slicer's .mrk.json
/// (markups[0].controlPoints). "LPS" coordinates are taken as the scan's own, because Slicer writes
/// models in the same way; "RAS" coordinates have the signs of x and y changed. `stated` overrides
/// the unit in the file. Throws InputError if the JSON is damaged, if a point is not three finite
/// numbers, if there are no points, or if a name occurs twice.
Landmarks read_landmarks(const std::filesystem::path& file,
                         std::optional<LengthUnit> stated = std::nullopt);
/// Writes a file that read_landmarks() can read. NAME.mrk.json: a point list of 3D Slicer in LPS
/// with the scan's coordinates.
void write_landmarks(const std::filesystem::path& file, const Landmarks& landmarks,
                     LengthUnit unit);

}  // namespace hyperex::io
