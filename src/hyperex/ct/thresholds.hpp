// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>

#include "hyperex/core/bounds.hpp"
#include "hyperex/ct/volume.hpp"

namespace hyperex::ct {

/// What values of the skin and of bone may be given, HU.
inline constexpr Bounds skin_hu_in{-900, 200}, bone_hu_in{50, 2000};

/// Grey values (HU) that the surfaces are drawn at, and what they were found from.
struct Thresholds {
  double skin_hu = 0, bone_hu = 0;
  bool skin_given = false, bone_given = false;
  double air_hu = 0, soft_hu = 0;  ///< the commonest values of air and of soft tissue
  bool is_hu = true;               ///< false: other units, and both values were given
  double noise_hu = 0;             ///< standard deviation in soft tissue, from its quartiles
};

/// The skin's value: half-way between the commonest value of air (-1100 to -850 HU) and that of
/// soft tissue (-150 to 200 HU), as an edge blurred by the scanner lies at its middle. Values
/// without air or soft tissue are no Hounsfield units, as of an MRI: where both values are given,
/// air is the median below the skin's and soft tissue that between the two. Throws InputError
/// (naming `source`) where not both are, or a given one is impossible.
Thresholds find_skin_threshold(const Volume& volume, const std::string& source,
                               std::optional<double> skin_hu = {},
                               std::optional<double> bone_hu = {});

/// Sets thresholds.bone_hu by isodata thresholding (T. Ridler and S. Calvard, IEEE Trans. SMC 8,
/// 1978, 630). The threshold lies half-way between two means: that of the values from skin_hu up to
/// it, and that of the values above it. It is limited to 150 to 700 HU. The volume must hold no
/// couch.
void find_bone_threshold(const Volume& body, Thresholds& thresholds,
                         std::optional<double> bone_hu = {});

}  // namespace hyperex::ct
