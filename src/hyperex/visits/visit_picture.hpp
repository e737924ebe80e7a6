// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include "hyperex/geometry/types.hpp"
#include "hyperex/render/image.hpp"
#include "hyperex/visits/measured_face.hpp"

namespace hyperex::visits {

/// The vertices of anatomy::embedded_face() (|V| x 3, m), displaced like the recorded points of
/// `face` at the peak, in the face's frame (face_frame.hpp: +x the subject's left, +y up). Between
/// the points the displacement is interpolated by radial basis functions, for each lip without the
/// points of the other. Lips that would pass through each other meet half way. Returns nothing if
/// the directions are not known.
std::optional<Points> peak_surface(const MeasuredFace& face);

/// The average face from the front, displaced like the recorded points of `face` at the peak. It
/// shows the movement, not the person: at rest it has the shape of the average face and the
/// asymmetry of the recorded points. Its surface is peak_surface(). R and L are drawn at the upper
/// corners. Returns nothing if the directions are not known. 300 x 400 pixels.
std::optional<render::Image> draw_peak(const MeasuredFace& face);

}  // namespace hyperex::visits
