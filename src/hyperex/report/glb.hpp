// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include "hyperex/io/scan.hpp"
#include "hyperex/reenact/performance.hpp"
#include "hyperex/report/displacement_modes.hpp"

namespace hyperex::report {

/// Writes the moving skin as binary glTF 2.0, metres: one mesh with `modes` (of
/// performance.skin_displacement_m) as morph targets, their weights animated linearly at the frame
/// times counted from the first frame. Normals move too: the targets' normal deltas are the
/// least-squares fit to the true normals of all frames. With the scan's texture (vertices split at
/// seams, the skin's order kept by extras.skin_vertices otherwise) or its vertex colours, else a
/// plain skin tone. A performance without motion is written as a still mesh. Throws InputError
/// where the file cannot be written, std::invalid_argument where performance, scan and modes do not
/// belong together.
void write_glb(const std::filesystem::path& file, const reenact::Performance& performance,
               const io::Scan& scan, const DisplacementModes& modes);

}  // namespace hyperex::report
