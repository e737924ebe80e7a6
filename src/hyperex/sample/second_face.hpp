// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/anatomy/embedded_face.hpp"

namespace hyperex::sample {

/// The embedded face with another person's proportions: a longer and wider jaw, a wider mouth, a
/// longer nose with a bridge, and the slight asymmetry that every face has.
/// Its vertices and triangles are those of anatomy::embedded_face() in the same order, moved by
/// smooth displacements about landmarks (bumps.hpp). The same face every time.
anatomy::EmbeddedFace second_face();

}  // namespace hyperex::sample
