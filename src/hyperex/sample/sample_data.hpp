// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <set>
#include <string>

#include "hyperex/sample/rendered_face.hpp"

namespace hyperex::sample {

/// The second face smiles on its right side, then opens its mouth: 2 s at 30 frames per second, 320
/// x 320 pixels, with noise of 1 mm in the depth and of 2 of 255 levels in the colours.
RenderedFace sample_clip();

/// Writes sample data to try the program with. The bytes are always the same.
///   second_face.ply, second_face_landmarks.json   another person's face, mm
///   flawed_scan.ply     the same face with a scanner's faults, mm, no landmarks (flawed_scan.hpp)
///   recording/          sample_clip() in the TUM layout, with camera and truth files
///   sample.json         what was made, with its noise, and the names of the files
/// `folder`: new, empty, or of an earlier call (core/output_directory.hpp); it appears complete or
/// not at all. Throws InputError where it cannot be written or contains something else.
void write_sample_data(const std::filesystem::path& folder);

}  // namespace hyperex::sample
