// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/io/landmarks.hpp"
#include "hyperex/render/render.hpp"

namespace hyperex::sample {

/// Colours of a face's vertices: skin with slight blotches, lips, brows. `landmarks` (all 68 iBUG
/// points) and `points` in a face's own axes: x to the subject's left, y up, z forward; metres.
render::VertexColours painted_face(const Points& points, const io::Landmarks& landmarks);

}  // namespace hyperex::sample
