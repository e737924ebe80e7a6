// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>

#include "hyperex/fem/time/drive.hpp"
#include "hyperex/simulate/drive/boundary.hpp"

namespace hyperex::simulate {

struct InputShapes {
  fem::Drive drive;
  double greatest_opening_deg = 0;  ///< of the jaw, over the steps
};

/// Steps beyond the end that a course is given for, so that the spline's condition there does not
/// reach back: a disturbance falls to 2 - sqrt 3 at each knot.
inline constexpr int kBeyond = 12;

/// What one direction of the input prescribes (a value a prescribed unknown) and its forces (all
/// unknowns).
using FillShape =
    std::function<void(const Eigen::VectorXd& direction, Eigen::Ref<Eigen::VectorXd> prescribed,
                       Eigen::Ref<Eigen::VectorXd> force)>;

/// An input of many numbers (a row each) over the steps and kBeyond more (a column each) as few
/// shapes with their courses: its principal directions (eigenvectors of its own second moments), as
/// many as leave no number wrong by more than `tolerance` times the greatest. The courses'
/// derivatives are those of the C2 cubic spline through their values at all steps: at rest at the
/// start, running on past the end.
fem::Drive compressed_drive(const Eigen::MatrixXd& input, double dt_s, int steps, double tolerance,
                            Eigen::Index prescribed, Eigen::Index unknowns, const FillShape& fill);

/// Everything that a boundary prescribes over a run (compressed_drive): the input at each step is
/// the acting points' displacements and the jaw's turn and slide, in which the boundary is linear.
/// `points_at`: displacement of all the motion's points (P x 3) at a time from the start (s).
InputShapes input_shapes(Boundary& boundary, const std::function<Points(double)>& points_at,
                         double dt_s, int steps, double tolerance);

}  // namespace hyperex::simulate
