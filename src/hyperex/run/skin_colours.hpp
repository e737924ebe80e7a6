// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/face/complexion.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/render/render.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::run {

/// The colours of the skin in pictures, one per vertex of skin_rest: from the scan's texture or
/// vertex colours, otherwise from report::complexion(). 0 rows if none of these exists.
render::VertexColours skin_colours(const simulate::Performance& performance, const io::Scan& scan,
                                   face::SkinTone tone);

}  // namespace hyperex::run
