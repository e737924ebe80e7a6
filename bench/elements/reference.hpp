// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace hyperex::study {

/// Rise of the middle of the right edge of Cook's membrane (unit depth, force over the right edge)
/// by biquadratic quadrilaterals, `cells` along each edge, graded towards the corners, with the
/// dilatation projected on linear polynomials in each: an element known to be stable.
double cooks_rise(int cells, double young, double poisson, double force, bool plane_stress);

}  // namespace hyperex::study
