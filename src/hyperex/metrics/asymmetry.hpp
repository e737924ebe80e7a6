// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/metrics/midsagittal.hpp"

namespace hyperex::metrics {

/// For each vertex of the face at rest, its counterpart: the point of the surface that is closest
/// to the vertex's mirror image.
struct Counterparts {
  std::vector<std::array<int, 3>> vertices;  ///< of the triangle that contains the counterpart
  std::vector<Vec3> weights;                 ///< barycentric
  /// Distance from the mirror image to the counterpart: the asymmetry at rest.
  Eigen::VectorXd distance_m;
  std::vector<char> found;  ///< 0: no counterpart within reach, or it is on the outer border
};

/// `side`: per vertex 1 for the upper lip, -1 for the lower lip, 0 for neither. It prevents a point
/// of one lip from being paired with the other lip when the mouth is closed; empty: no distinction.
/// A closest point is rejected if it is farther than `reach_m` from the mirror image, or if it lies
/// on the border of the surface, unless it coincides with the mirror image.
Counterparts counterparts(const TriMesh& rest, const MidsagittalPlane& plane,
                          const std::vector<int>& side = {}, double reach_m = 0.010);

/// Asymmetry (mm) of a displaced face, one value per vertex; NaN if there is no counterpart. Let
/// x_i be the vertices, c(i) the counterpart of i, which moves with its triangle, and M the
/// reflection. The result is the length of the vector
///   a_i(t) = (x_i(t) - M x_c(i)(t)) - (x_i(0) - M x_c(i)(0)) = u_i(t) - R u_c(i)(t)
/// with R v = v - 2 (n . v) n. This is the difference between the face and its own mirror image,
/// minus that difference at rest. `displacement` (m) has one row per vertex.
Eigen::VectorXf asymmetry_mm(const MidsagittalPlane& plane, const Counterparts& pairs,
                             const PointsF& displacement);
/// The length of u_i - R u'_c(i): the same, but with the displacements u' of the counterparts taken
/// from `other`. With those of the mirrored twin of a run (mesh_floor.hpp), this is the part of the
/// asymmetry that results from the mesh and the shape of the face.
Eigen::VectorXf asymmetry_mm(const MidsagittalPlane& plane, const Counterparts& pairs,
                             const PointsF& displacement, const PointsF& other);

/// Summary of the asymmetry in one frame.
struct AsymmetrySummary {
  double face_rms_mm = 0, face_p95_mm = 0;    ///< over the region "face" (regions.hpp)
  double mouth_rms_mm = 0, mouth_p95_mm = 0;  ///< over the region "lips"
};

/// The quantities that do not depend on the motion.
struct RestAsymmetry {
  MidsagittalPlane plane;
  Counterparts pairs;
  /// Distance between the face at rest and its mirror image.
  double rest_rms_mm = 0, rest_p95_mm = 0;
  double paired_share = 0;       ///< share of the face's vertices that have a counterpart
  std::vector<int> face, mouth;  ///< vertices of the two regions that have a counterpart
};

/// Values are NaN if their region cannot be defined. Throws InputError if the landmarks do not
/// define a plane.
RestAsymmetry rest_asymmetry(const TriMesh& rest, const io::Landmarks& landmarks,
                             const std::vector<int>& side = {});

struct Asymmetry : RestAsymmetry {
  std::vector<AsymmetrySummary> frames;
  int worst_frame = 0;  ///< the frame with the largest face_rms_mm
  /// The part that results from mesh and shape, in the worst frame; nothing without a twin.
  std::optional<AsymmetrySummary> mesh_floor;
};

/// The asymmetry of a sequence. `frames`: displacements of the vertices (m). `twin`: the same for
/// the mirrored twin; empty: none.
Asymmetry asymmetry_of(const RestAsymmetry& rest, const std::vector<PointsF>& frames,
                       const std::vector<PointsF>& twin = {});

}  // namespace hyperex::metrics
