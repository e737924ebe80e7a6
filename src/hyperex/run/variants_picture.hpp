// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <filesystem>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/metrics/variant_comparison.hpp"
#include "hyperex/render/camera.hpp"
#include "hyperex/run/outputs.hpp"
#include "hyperex/session/variants.hpp"

namespace hyperex::run {
using session::VariantRun;

/// Three cameras: obliquely from the right, from the front, and obliquely from the left, because a
/// variant may change either side. Each shows all the points (face frame), at the same scale.
std::array<render::Camera, 3> cameras_on(const Points& framed, double aspect);

/// The variant that is farthest from base in any frame, and the first frame in which it is: that
/// which the report names. One comparison or more.
struct MostDifferent {
  std::size_t variant = 0, frame = 0;
};
MostDifferent differs_most(const std::vector<metrics::VariantComparison>& compared);

/// The face of base and of each variant in the frame of differs_most(), seen by
/// cameras_on() and coloured by the greatest distance from base over time. The scale of the colours
/// is chosen such that small differences remain visible beside a large one. One comparison per
/// variant.
void draw_variants(const Results& base, const std::vector<metrics::VariantComparison>& compared,
                   const std::vector<VariantRun>& runs, const std::filesystem::path& file);

/// S(t) of all faces with the noise floor, and the change of xi_L - xi_R by each variant. Writes
/// nothing if there is only one frame.
void draw_variant_symmetry(const Results& base, const std::vector<VariantRun>& runs,
                           const std::filesystem::path& file);

}  // namespace hyperex::run
