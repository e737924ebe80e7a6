// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>

#include "hyperex/fem/time/drive.hpp"
#include "hyperex/reenact/boundary.hpp"

namespace hyperex::reenact {

struct InputShapes {
  fem::Drive drive;
  double greatest_opening_deg = 0;  ///< of the jaw, over the steps
};

/// Everything that a boundary prescribes over a run as few shapes with their courses. The input at
/// each step (displacements of the acting points, and the jaw's turn and slide) is written in its
/// principal directions (eigenvectors of its own second moments), as many as leave no number of it
/// wrong by more than `tolerance` times the greatest; the boundary is linear in it. The courses'
/// derivatives are those of the C2 cubic spline through their values at all steps: at rest at the
/// start, running on past the end.
/// `points_at`: displacement of all the motion's points (P x 3) at a time from the start (s).
InputShapes input_shapes(Boundary& boundary, const std::function<Points(double)>& points_at,
                         double dt_s, int steps, double tolerance);

}  // namespace hyperex::reenact
