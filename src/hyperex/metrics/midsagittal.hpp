// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::metrics {

/// The plane of reflection {p : normal . p = offset} of a face.
struct MidsagittalPlane {
  Vec3 normal = Vec3::UnitX();  ///< unit vector towards the subject's left
  double offset_m = 0;

  Vec3 reflect(const Vec3& p) const { return p - 2 * (normal.dot(p) - offset_m) * normal; }
  Vec3 reflect_vector(const Vec3& v) const { return v - 2 * normal.dot(v) * normal; }

  double landmark_rms_m = 0;  ///< weighted distance of reflected landmarks to their counterparts
  /// Weighted distance between the reflected surface and the surface, along its normal; NaN if not
  /// refined.
  double surface_rms_m = 0;
  /// Change by the refinement; the shift is that at the middle of the face.
  double turned_deg = 0, shifted_m = 0;
  int rounds = 0;    ///< rounds of refinement; 0 if it was rejected
  std::string note;  ///< why the refinement by the surface failed, one sentence; otherwise empty
};

/// The plane for which reflected landmarks best match the landmarks of the other side, and midline
/// landmarks match themselves. Weighted least squares, with Cauchy weights in ten rounds. For
/// ordered pairs (a, b), relative to their common mean m, the normal is the eigenvector of sum w (a
/// b' + b a') / 2 with the least eigenvalue, and offset = normal . m. Pairs are given by
/// mirrored_landmark() of the canonical face; landmarks of the folds (face::optional_landmarks) do
/// not count. Throws InputError if there are fewer than two pairs.
MidsagittalPlane landmark_plane(const io::Landmarks& landmarks);

/// landmark_plane(), refined by matching the reflected surface with the surface itself, by
/// point-to-plane iterative closest points over the region "face" (regions.hpp). Each round solves
/// directly for the three parameters of the plane, so that the result is always an exact
/// reflection. Weights are Tukey's with the tuning constant 4.685 and the scale 1.4826 median |r|.
/// Closest points are rejected if they lie on the outer border or more than 10 mm away, or if the
/// normals differ by more than 60 degrees. The iteration ends when a step is below 1e-8 (radian, or
/// 0.1 m), after four successive rounds without a smaller step, or after 60 rounds. A refinement
/// that rotates the plane by more than 15 degrees or shifts it by more than 15 mm is rejected, and
/// `note` says so. Sources: docs/symmetry.md.
MidsagittalPlane midsagittal_plane(const TriMesh& rest, const io::Landmarks& landmarks);

}  // namespace hyperex::metrics
