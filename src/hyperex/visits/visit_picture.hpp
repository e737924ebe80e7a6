// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/render/image.hpp"
#include "hyperex/visits/measured_face.hpp"

namespace hyperex::visits {

/// The average face from the front, displaced like the recorded points of `face` at the peak. It
/// shows the movement, not the person: at rest it has the shape of the average face and the
/// asymmetry of the recorded points. Between the points the displacement is interpolated by radial
/// basis functions. R and L are drawn at the upper corners. Returns nothing if the directions are
/// not known. 300 x 400 pixels.
std::optional<render::Image> draw_peak(const MeasuredFace& face);

}  // namespace hyperex::visits
