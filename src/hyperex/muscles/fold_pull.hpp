// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/muscles/force_shape.hpp"
#include "hyperex/muscles/muscle_lines.hpp"

namespace hyperex::muscles {

/// The line in the skin along which the fold from nose to mouth (nasolabial fold) forms, of the
/// subject's left or right side. From beside the wing of the nose to beside the corner of the
/// mouth; n x 3, m, on the skin, equally spaced along the line.
Points nasolabial_fold(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks, bool left);

/// Nodal forces (3 |nodes|, N) of a muscle whose fibres end in the skin along a part of the fold
/// (TemplateMuscle::fold_from, fold_to). `fold`: the nasolabial_fold() of its side. On skin at the
/// distance d from that part of the line, per area:
///   exp(-(d / width)^2) (cos(a) t - sin(a) n),
/// t the direction in the skin towards the muscle's origin, n the outward normal, a and width
/// FoldShape's. Not normalised: the caller scales. Zero for a muscle that does not end in the fold.
Eigen::VectorXd fold_pull(const MuscleLine& line, const TemplateMuscle& muscle, const Points& fold,
                          const tissue::TissueMesh& mesh, const FoldShape& shape);

}  // namespace hyperex::muscles
