// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <set>
#include <string>

#include "hyperex/sample/rendered_face.hpp"

namespace hyperex::sample {

/// The second face smiling on its right side, then opening the mouth: 2 s at 30 frames per second,
/// 320 x 320 pixels, noise of 1 mm in the depth and of 2 of 255 levels in the colours.
RenderedFace sample_clip();

/// Writes data to try the program with, the same bytes every time:
///   second_face.ply, second_face_landmarks.json   another person's face, mm
///   flawed_scan.ply     the same face as a scanner leaves it, mm, no landmarks (flawed_scan.hpp)
///   recording/          sample_clip() in the TUM layout, with camera and truth files
///   sample.json         what was made, with its noise, and the names of the files
/// `folder`: new, empty, or of an earlier call (core/output_directory.hpp); appears whole or not at
/// all. Throws InputError where it cannot be written or holds something else.
void write_sample_data(const std::filesystem::path& folder);

}  // namespace hyperex::sample
