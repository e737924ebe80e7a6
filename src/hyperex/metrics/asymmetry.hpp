// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/metrics/midsagittal.hpp"

namespace hyperex::metrics {

/// Where on the face at rest the reflection of each vertex lies: the closest point.
struct Counterparts {
  std::vector<std::array<int, 3>> vertices;  ///< of its triangle
  std::vector<Vec3> weights;                 ///< barycentric
  Eigen::VectorXd distance_m;                ///< from the reflected vertex: asymmetry at rest
  std::vector<char> found;                   ///< 0: none within reach, or on the outer border
};

/// `side`: per vertex 1 upper lip's, -1 lower lip's, 0 neither, so that a lip is not taken for the
/// other one through a closed mouth; empty: not distinguished. A foot farther than `reach_m` from
/// the reflected vertex, or on the border of the surface and not upon it, is no counterpart.
Counterparts counterparts(const TriMesh& rest, const MidsagittalPlane& plane,
                          const std::vector<int>& side = {}, double reach_m = 0.010);

/// Asymmetry of a displaced face (mm): with x_i the vertices, c(i) the counterpart carried along
/// and M the reflection, the vector
///   a_i(t) = (x_i(t) - M x_c(i)(t)) - (x_i(0) - M x_c(i)(0)) = u_i(t) - R u_c(i)(t),
/// R v = v - 2 (n . v) n: the face less its own reflection, less the same at rest. Its length, a
/// value per vertex; NaN without counterpart. `displacement` (m) has as many rows as the
/// counterparts.
Eigen::VectorXf asymmetry_mm(const MidsagittalPlane& plane, const Counterparts& pairs,
                             const PointsF& displacement);
/// u_i - R u'_c(i): the same with the counterparts' displacements taken from `other`. With those of
/// a run's mirrored twin (mesh_floor.hpp) what mesh and shape alone make of the map.
Eigen::VectorXf asymmetry_mm(const MidsagittalPlane& plane, const Counterparts& pairs,
                             const PointsF& displacement, const PointsF& other);

/// The asymmetry in one frame.
struct AsymmetrySummary {
  double face_rms_mm = 0, face_p95_mm = 0;    ///< over the region "face" (regions.hpp)
  double mouth_rms_mm = 0, mouth_p95_mm = 0;  ///< over the region "lips"
};

/// What does not depend on the motion.
struct RestAsymmetry {
  MidsagittalPlane plane;
  Counterparts pairs;
  double rest_rms_mm = 0, rest_p95_mm = 0;  ///< distance of the reflected face at rest from itself
  double paired_share = 0;                  ///< of the face's vertices that have a counterpart
  std::vector<int> face, mouth;             ///< vertices of both regions that have one
};

/// Numbers are NaN where a region cannot be defined. Throws InputError where the landmarks give no
/// plane.
RestAsymmetry rest_asymmetry(const TriMesh& rest, const io::Landmarks& landmarks,
                             const std::vector<int>& side = {});

struct Asymmetry : RestAsymmetry {
  std::vector<AsymmetrySummary> frames;
  int worst_frame = 0;  ///< largest face_rms_mm
  /// What mesh and shape of the face make of it in the worst frame; none without a twin.
  std::optional<AsymmetrySummary> mesh_floor;
};

/// Everything of a sequence: `frames` are displacements of the points at rest (m). `twin`: of the
/// mirrored twin, as many; empty: none.
Asymmetry asymmetry_of(const RestAsymmetry& rest, const std::vector<PointsF>& frames,
                       const std::vector<PointsF>& twin = {});

}  // namespace hyperex::metrics
