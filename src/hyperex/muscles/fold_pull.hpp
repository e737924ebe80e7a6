// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/muscles/force_shape.hpp"
#include "hyperex/muscles/muscle_lines.hpp"

namespace hyperex::muscles {

/// The line in the skin along which the fold from nose to mouth (nasolabial fold) forms, on the
/// subject's left or right side. It runs from beside the wing of the nose to beside the corner of
/// the mouth, through the landmarks of the fold that are given (face::fold_landmark). A rule gives
/// the ends that are not, and the bow where the middle is not. n x 3, m, nearly equally spaced.
/// `from_rest`: the rule's ends are shifted by groove_at_rest().
Points nasolabial_fold(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks, bool left,
                       bool from_rest = FoldShape{}.from_rest);

/// How far outwards, across the fold (m, scan frame), the groove of the skin at rest lies from the
/// rule's line: the median over cuts at 0.2, 0.3 and 0.4 of the way from the wing of the nose to
/// the corner of the mouth (anatomy::FoldProfile). Nearer to the mouth the deepest groove is that
/// of the lips. Zero where the median depth is below 1.75 mm, as on faces without a fold at rest,
/// where the shift would be more than 6 mm, or where a cut meets a hole.
Vec3 groove_at_rest(const TriMesh& skin, const io::Landmarks& landmarks, bool left);

/// Where the line of each side has those of its ends and its middle that `landmarks` lack: by name
/// (face::optional_landmarks), m, on the skin.
io::Landmarks fold_places(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks);

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
