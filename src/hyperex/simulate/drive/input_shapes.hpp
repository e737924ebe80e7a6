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

/// Steps beyond the end for which a course is given. The spline's condition at its own end then
/// does not reach back: a disturbance falls by a factor of 2 - sqrt 3 at each knot.
inline constexpr int kBeyond = 12;

/// Fills in what one direction of the input prescribes (one value per prescribed unknown, m) and
/// its forces (all unknowns, N).
using FillShape =
    std::function<void(const Eigen::VectorXd& direction, Eigen::Ref<Eigen::VectorXd> prescribed,
                       Eigen::Ref<Eigen::VectorXd> force)>;

/// Compresses an input of many numbers (rows) over the steps and kBeyond more (columns) into few
/// shapes with their courses. The shapes are its principal directions: eigenvectors of its second
/// moments, as many as leave no number wrong by more than `tolerance` times the greatest. The
/// courses' derivatives are those of the C2 cubic spline through their values at all steps, which
/// is at rest at the start.
fem::Drive compressed_drive(const Eigen::MatrixXd& input, double dt_s, int steps, double tolerance,
                            Eigen::Index prescribed, Eigen::Index unknowns, const FillShape& fill);

/// What a boundary prescribes over a run, compressed. The input at each step are the acting points'
/// displacements and the jaw's turn and slide. The boundary is linear in these.
/// `points_at`: displacement of all the motion's points (P x 3, m) at a time from the start (s).
InputShapes input_shapes(Boundary& boundary, const std::function<Points(double)>& points_at,
                         double dt_s, int steps, double tolerance);

}  // namespace hyperex::simulate
