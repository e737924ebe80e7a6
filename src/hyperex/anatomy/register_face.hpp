// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <string>
#include <vector>

#include "hyperex/geometry/transform.hpp"
#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::anatomy {

struct RegisterOptions {
  /// Decreasing stiffness, one value per stage: the weight of differences between neighbouring
  /// vertices' maps.
  std::vector<double> stiffness = {30, 15, 8, 4, 2, 1, 0.5};
  int rounds_per_stage = 3;
  double landmark_weight = 4;    ///< of a given landmark, relative to one vertex on the surface
  double max_distance_m = 0.02;  ///< a vertex farther from the scan follows its neighbours
  double max_angle_deg = 60;     ///< between the normals of vertex and scan
};

struct RegisteredFace {
  Points points;                   ///< 468 x 3, the canonical vertices in the scan's frame, metres
  Similarity scan_from_canonical;  ///< of the landmarks alone
  double rms_landmarks_m = 0;      ///< of that similarity at the landmarks
  bool lip_line_found = false;     ///< the inner lips were laid on the crease between the lips
};

/// Registers the canonical face to a scan: first a similarity by the landmarks, then non-rigid
/// iterated closest points with one affine map per vertex, similar between neighbours (Amberg,
/// Romdhani, Vetter, "Optimal step nonrigid ICP algorithms for surface registration", CVPR 2007).
/// Where the scan has holes at the eyes or the mouth, lids and lips are registered to their
/// borders. `given`: three or more landmarks that the canonical face knows, not on one line
/// (asserted).
RegisteredFace register_canonical_face(const io::Landmarks& given, const TriMesh& scan,
                                       const RegisterOptions& options = {});

}  // namespace hyperex::anatomy
