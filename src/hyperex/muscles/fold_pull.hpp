// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/muscles/force_shape.hpp"
#include "hyperex/muscles/muscle_lines.hpp"

namespace hyperex::muscles {

/// The line in the skin along which the fold from nose to mouth (nasolabial fold) forms, on the
/// subject's left or right side. It runs from beside the wing of the nose to beside the corner of
/// the mouth. n x 3, m, equally spaced along the line.
Points nasolabial_fold(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks, bool left);

/// The part of a nasolabial_fold() along which a muscle ends in the skin
/// (TemplateMuscle::fold_from, fold_to). m x 3, m, from the nose on, equally spaced.
Points part_of_fold(const Points& fold, const TemplateMuscle& muscle);

/// Nodal forces (3 |nodes|, N) of a muscle whose fibres end in the skin along a part of the fold
/// (part_of_fold()). `fold`: the nasolabial_fold() of the muscle's side. The
/// force per area of skin at the distance d from that part of the line is
///   exp(-(d / width)^2) (cos(a) t - sin(a) n),
/// where t is the direction in the skin towards the muscle's origin, n the outward normal, a the
/// angle FoldShape::inwards_deg and width FoldShape::width_mm. Not normalised: the caller scales
/// the result. Zero for a muscle that does not end in the fold.
Eigen::VectorXd fold_pull(const MuscleLine& line, const TemplateMuscle& muscle, const Points& fold,
                          const tissue::TissueMesh& mesh, const FoldShape& shape);

}  // namespace hyperex::muscles
