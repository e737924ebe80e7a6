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
/// (markups[0].controlPoints; "LPS" is taken as the scan's own axes, which is how Slicer writes
/// models beside it; "RAS" has x and y turned). `stated` overrides the file's unit.
/// Throws InputError: torn JSON, a point that is not three finite numbers, no points, a name twice.
Landmarks read_landmarks(const std::filesystem::path& file,
                         std::optional<LengthUnit> stated = std::nullopt);
/// read_landmarks reads it back. NAME.mrk.json: a point list of 3D Slicer, LPS, the scan's numbers.
void write_landmarks(const std::filesystem::path& file, const Landmarks& landmarks,
                     LengthUnit unit);

}  // namespace hyperex::io
