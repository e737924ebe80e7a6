// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/geometry/types.hpp"
#include "hyperex/metrics/symmetry_tables.hpp"
#include "hyperex/motion/motion.hpp"

namespace hyperex::metrics {

/// A recorded point this near to a corner of the mouth at rest shows it: a landmark of another
/// place, and a marker of any other name. Markers are often glued beside the corners (10 mm in
/// AnimFace).
inline constexpr double kLandmarkShows_m = 5e-3, kMarkerShows_m = 15e-3;

/// Whether a recording shows a corner of the mouth that lies at `rest`: a point has its name or
/// another name of its place (face::place_name), or lies as near to it in the first sample.
/// `recorded`: in the frame of `rest`.
bool is_recorded(const motion::Motion& recorded, const std::string& name, const Vec3& rest);

/// A run moves both sides of the face, also where its recording shows one alone. What it makes of
/// the other side comes from its prior and must not look measured. For each pair, `left_recorded`
/// and `right_recorded` are set: of a corner is_recorded(), of others by the place alone. Where one
/// side of a pair is recorded alone, all figures of the other side and all that compare the two
/// become NaN. So do those of a corner of the mouth that is not recorded, its curves, its xi, and
/// S(t). Call this last, after the floors were added. `landmarks`: the run's, whose columns the
/// measures name; `recorded`: in their frame.
void withhold_unrecorded(SymmetryMeasures& measures, const motion::Motion& landmarks,
                         const motion::Motion& recorded);

}  // namespace hyperex::metrics
