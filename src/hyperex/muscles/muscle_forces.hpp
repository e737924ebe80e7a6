// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/muscles/force_shape.hpp"
#include "hyperex/muscles/muscle_lines.hpp"

namespace hyperex::muscles {

/// Nodal forces (3 |nodes|, N) of a muscle. A pull: the integral over the tissue of the body force
/// w(r) s^ramp (-t) N/m^3 with t the line's direction towards the insertion, s the share of the way
/// from the origin. A ring: the forces of the stress w(r) t t^T Pa, which sum to zero before part
/// of their component normal to the skin is removed. Not normalised: the caller scales.
Eigen::VectorXd muscle_force(const MuscleLine& line, const TemplateMuscle& muscle,
                             const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                             const ForceShape& shape);

}  // namespace hyperex::muscles
