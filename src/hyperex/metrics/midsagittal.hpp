// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::metrics {

/// The plane {p : normal . p = offset} in which a face is reflected.
struct MidsagittalPlane {
  Vec3 normal = Vec3::UnitX();  ///< of length 1, towards the subject's left
  double offset_m = 0;

  Vec3 reflect(const Vec3& p) const { return p - 2 * (normal.dot(p) - offset_m) * normal; }
  Vec3 reflect_vector(const Vec3& v) const { return v - 2 * normal.dot(v) * normal; }

  double landmark_rms_m = 0;  ///< of reflected landmarks to their counterparts, weighted
  /// Weighted distance of the reflected surface to the surface along its normal; NaN if not
  /// refined.
  double surface_rms_m = 0;
  double turned_deg = 0, shifted_m = 0;  ///< by the refinement; shift in the middle of the face
  int rounds = 0;                        ///< of refinement; 0 where it was given up
  std::string note;  ///< why the surface did not refine it, a sentence; else empty
};

/// The plane whose reflection carries landmarks onto those of the other side and midline ones onto
/// themselves, in the least-squares sense with Cauchy weights in ten rounds: for ordered pairs
/// (a, b) about their common middle m the normal is the eigenvector of least eigenvalue of
/// sum w (a b' + b a') / 2, and offset = normal . m. Pairs are those of the canonical face's
/// mirrored_landmark(). Throws InputError where fewer than two pairs are given.
MidsagittalPlane landmark_plane(const io::Landmarks& landmarks);

/// landmark_plane(), refined by laying the reflected surface on the surface: iterative closest
/// points over the region "face" (regions.hpp), point to plane, solved for the plane's three
/// parameters directly, so that the result is a reflection at every step; Tukey's weights at
/// 4.685 times the scale 1.4826 median |r|. Feet on the outer border, more than 10 mm off, or
/// with normals more than 60 degrees apart do not count. It ends where steps are below 1e-8
/// (radian, or 0.1 m), after four rounds in a row without a smaller one, or after 60. A refinement
/// that turns by more than 15 degrees or shifts by more than 15 mm is given up, and `note` says so.
/// docs/symmetry.md names the sources.
MidsagittalPlane midsagittal_plane(const TriMesh& rest, const io::Landmarks& landmarks);

}  // namespace hyperex::metrics
