// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/muscles/force_shape.hpp"
#include "hyperex/muscles/muscle_lines.hpp"

namespace hyperex::muscles {

/// Nodal forces (3 |nodes|, N) of a muscle. For a pull, they are the integral over the tissue of
/// the body force w(r) s^ramp (-t) N/m^3, where t is the line's direction towards the insertion and
/// s the share of the length from the origin. For a ring, they are the forces of the stress w(r) t
/// t^T Pa. These sum to zero before part of their component normal to the skin is removed. Not
/// normalised: the caller scales the result.
Eigen::VectorXd muscle_force(const MuscleLine& line, const TemplateMuscle& muscle,
                             const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                             const ForceShape& shape);

}  // namespace hyperex::muscles
