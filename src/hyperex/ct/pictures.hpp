// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/ct/ct_face.hpp"
#include "hyperex/render/image.hpp"

namespace hyperex::ct {

/// Slices through nose, mouth and chin (from below, as radiologists look), through the middle (from
/// the left) and through the jaws (from the front), with the surfaces' contours.
render::Image draw_slices(const CtFace& face);

/// The bones seen through the skin, from the front and from both sides.
render::Image draw_bones_through_skin(const CtFace& face);

/// The shortest distance from the skin to bone, in colours, with its bar.
render::Image draw_thickness(const CtFace& face);

}  // namespace hyperex::ct
