// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <random>

#include "hyperex/io/landmarks.hpp"

namespace hyperex::face {

/// Error of a coordinate of a landmark that is found on a scan, 1 sigma: docs/landmarks.md.
inline constexpr double kLandmarkError_m = 1.5e-3;

/// The landmarks as they may be found instead: each moved by a normal error of `sigma_m` in every
/// coordinate. A place that has two names is one landmark.
io::Landmarks with_errors(io::Landmarks landmarks, double sigma_m, std::mt19937& random);

}  // namespace hyperex::face
