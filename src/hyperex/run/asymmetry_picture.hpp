// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/io/landmarks.hpp"
#include "hyperex/metrics/asymmetry.hpp"
#include "hyperex/render/image.hpp"
#include "hyperex/run/backing_surfaces.hpp"

namespace hyperex::run {

/// The asymmetry map on the moved skin, from the front and from both sides, with a colour bar in mm
/// up to the 99th percentile over the face; a vertex without a counterpart is not coloured,
/// nor is one that lies, or whose counterpart lies, within 12 mm of the skin's longest border.
/// The map is alike on both sides, which stands behind `title`. `moved`: the displaced skin;
/// `map_mm`: one value per vertex (asymmetry_mm); `landmarks`: those at rest. `behind`: teeth and
/// the other surfaces behind the skin's holes, in the frame of `moved`; null: nothing is there.
render::Image draw_asymmetry(const TriMesh& moved, const Eigen::VectorXf& map_mm,
                             const metrics::Asymmetry& asymmetry, const io::Landmarks& landmarks,
                             const std::string& title, const std::string& note,
                             const BackingSurfaces* behind = nullptr);

}  // namespace hyperex::run
