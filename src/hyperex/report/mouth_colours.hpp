// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/report/face_backing.hpp"

namespace hyperex::report {

/// Colours (sRGB) of teeth, gums, tongue and lining in full light.
inline constexpr Srgb kCrownColour = {0xeb, 0xe1, 0xca}, kGumColour = {0xc4, 0x6e, 0x6c},
                      kTongueColour = {0xc0, 0x62, 0x60}, kMucosaColour = {0xa8, 0x58, 0x50};

}  // namespace hyperex::report
