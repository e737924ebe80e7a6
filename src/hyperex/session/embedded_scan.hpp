// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/face/complexion.hpp"
#include "hyperex/io/scan.hpp"

namespace hyperex::session {

/// The embedded face as a scan, with texture coordinates and a painted texture (JPEG,
/// face/complexion.hpp).
io::Scan embedded_scan(face::SkinTone tone = face::SkinTone::light);

}  // namespace hyperex::session
