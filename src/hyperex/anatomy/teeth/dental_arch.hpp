// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/anatomy/teeth/teeth.hpp"

namespace hyperex::anatomy {

/// Size of the arches relative to those of an average adult.
struct ArchSize {
  double scale = 1;    ///< of everything, > 0
  double breadth = 1;  ///< width of the arches relative to the average, 0.6 to 1.2; a narrower arch
                       ///< is longer, because the size of the teeth does not change
};

/// Both rows of permanent teeth without the third molars, in occlusion, metres. Frame: x to the
/// subject's left, y up, z forward; the mid-line is x = 0, the edges of the upper central incisors
/// meet it at the origin and y = 0 is the plane of occlusion.
///
/// Crowns: length, mesiodistal and labiolingual diameters, each at its greatest and at the neck,
/// are those of Ash and Nelson, Wheeler's Dental Anatomy, Physiology and Occlusion, 8th ed. 2003,
/// table 1-1. Arches: the beta function of Braun, Hnat, Fender and Legan, The form of the human
/// dental arch, Angle Orthod. 68 (1998) 29: z = 3.0314 D (x/W + 1/2)^0.8 (1/2 - x/W)^0.8, with a
/// depth D such that each tooth is in contact with its neighbours. Overbite and overjet are 2.5 mm
/// each (2 to 3 mm count as normal: Proffit, Contemporary Orthodontics). Assumed: the shape of a
/// crown between these figures (superellipses, cusps of 1 mm), the width W of the arches between
/// the second molars' middles (56 and 52 mm), how crowns lean, and the gum: a rounded band about
/// the necks, 1 mm thick before them, 8 mm high, that fills half of the height between neighbours.
/// The lower incisors' edges are in one line, the lower canines 0.2 mm above it.
/// Lower molars stand 0.5 mm clear of the upper ones.
Teeth dental_arches(const ArchSize& size = {});

/// Overbite and overjet of dental_arches() at scale 1.
inline constexpr double kOverbite_m = 0.0025, kOverjet_m = 0.0025;

}  // namespace hyperex::anatomy
