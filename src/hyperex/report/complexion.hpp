// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/face/complexion.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::report {

/// Skin colours for a scan that has no colours. The painted skin of the canonical face
/// (face/complexion.hpp) is transferred by the landmarks of the first sample. Lips and brows are
/// faint, because landmarks may be off by some millimetres. RGBA (sRGB) of each vertex of
/// skin_rest; 0 rows if the outer corners of the eyes or the corners of the mouth are missing. Only
/// for display; no figure depends on it.
io::VertexColours complexion(const simulate::Performance& performance, face::SkinTone tone);

}  // namespace hyperex::report
