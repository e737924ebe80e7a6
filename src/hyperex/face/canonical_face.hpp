// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::face {

/// The canonical face of MediaPipe Face Mesh (npm package @mediapipe/face_mesh, Apache-2.0),
/// embedded in this library: +x the subject's left, +y up, +z forward, metres. Its size is 15.5 x
/// 17.7 x 10.0 cm.
struct CanonicalFace {
  TriMesh mesh;  ///< 468 vertices, 898 triangles, one border; eyes and mouth closed by triangles
  Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor> uv;  ///< |V| x 2, v down as in pictures
  /// Maps a landmark's name to the vertices whose mean it is (data/canonical_landmarks.csv): the 68
  /// iBUG points and the anatomical landmarks.
  std::map<std::string, std::vector<int>> landmarks;
  /// Rows of mesh.triangles that close an opening: 14, 14 and 18 of them.
  std::vector<int> right_eye, left_eye, mouth;

  /// Position of a landmark. `vertices`: the positions of the mesh's vertices, at rest or
  /// displaced.
  Vec3 landmark(const std::string& name, const Points& vertices) const;
};

/// Parsed at the first call. Always returns the same object.
const CanonicalFace& canonical_face();

/// The triangles of the mesh except those that close the openings.
Triangles opened_triangles(const CanonicalFace& face);

/// The inner contour of each opening: a closed path of vertices in order.
const std::vector<int>& right_eye_contour();
const std::vector<int>& left_eye_contour();
const std::vector<int>& lip_contour();

/// For each vertex, its mirror image in the midsagittal plane. A vertex on this plane is its own
/// mirror image.
const std::vector<int>& mirrored_vertices();

/// The corresponding landmark on the other side: "cheilion_L" -> "cheilion_R", "ibug68_48" ->
/// "ibug68_54". A landmark on the midline and an unknown name are returned unchanged.
std::string mirrored_landmark(const std::string& name);

}  // namespace hyperex::face
