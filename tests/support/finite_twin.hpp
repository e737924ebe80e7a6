// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The truth of a twin at finite strain, which the program does not assume.
#include <vector>

#include "support/muscle_twin.hpp"

namespace hyperex::test {

/// The points where the forces that make `motion` in the truth's tissue act at finite strain: in
/// base, then after each change. The results have no noise. `young_factor`: of the whole tissue.
std::vector<motion::Motion> at_finite_strain(const TwinFace& face,
                                             const simulate::AlignedMotion& motion,
                                             const muscles::MuscleTable& muscles,
                                             double young_factor,
                                             const std::vector<TwinChange>& changes);

}  // namespace hyperex::test
