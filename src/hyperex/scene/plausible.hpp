// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/scene/inputs.hpp"

namespace hyperex::scene {

// Whether what a scene names belongs together. Numbers in the .cpp are calibrated on real data.

/// Throws InputError where the recording fits the scan far better with left and right exchanged: at
/// its common points, after a similarity, more than 6 mm apart (root mean square), and less than
/// half of that with its points mirrored.
void check_sides(const motion::Motion& stabilised, const io::Landmarks& landmarks);

/// A sentence where the recording fits the scan badly: of another face, in another unit, or with
/// points that only share their names; empty where it fits.
std::string misfit_warning(const reenact::AlignedMotion& aligned);

/// A sentence where the recording seems to begin in the middle of an expression
/// (motion::started_in_expression); empty where it does not.
std::string start_warning(const motion::Motion& stabilised, const io::Landmarks& landmarks);

/// Throws InputError where nothing would move: the recording is one sample, or the run ends before
/// its second frame.
void check_length(const Scene& scene, const motion::Motion& m);

/// A sentence where the simulated skin is more than 5 mm from the scan somewhere on the face
/// (within 25 mm of a landmark), with the landmark next to that place; empty where it is not.
std::string skin_warning(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks);

}  // namespace hyperex::scene
