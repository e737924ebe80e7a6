// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include "hyperex/io/landmarks.hpp"
#include "hyperex/io/scan.hpp"

namespace hyperex::session {

/// A person's scan and the landmarks that are known on it.
struct Face {
  io::Scan scan;            ///< metres
  io::Landmarks landmarks;  ///< metres, the scan's frame; empty: found on the scan when needed
};

/// `scan`: PLY, OBJ, STL, glTF or GLB, its unit guessed from its size where the file states none.
/// `landmarks`: JSON or 3D Slicer's markups; empty: none. Throws InputError.
Face read_face(const std::filesystem::path& scan, const std::filesystem::path& landmarks = {});

}  // namespace hyperex::session
