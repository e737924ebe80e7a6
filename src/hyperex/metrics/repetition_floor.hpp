// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/metrics/excursion.hpp"

namespace hyperex::metrics {

/// Counts a person's own variation in the floors of all pairs. `repetition_mm`: 95 % of the
/// differences between two performances of one side are below this (a posed smile after a week: 1.5
/// mm, Tanikawa and Takada, Angle Orthod. 88, 2018, 319); 0: the recording alone is judged. Both
/// sides are taken to vary independently, so that this is the floor of their difference too.
void add_repetition_floor(Excursions& excursions, double repetition_mm);

}  // namespace hyperex::metrics
