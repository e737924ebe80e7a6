// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::face {

/// The canonical face of MediaPipe Face Mesh (npm package @mediapipe/face_mesh, Apache-2.0),
/// carried inside this library: +x the subject's left, +y up, +z forward, metres, 15.5 x 17.7
/// x 10.0 cm.
struct CanonicalFace {
  TriMesh mesh;  ///< 468 vertices, 898 triangles, one border; eyes and mouth closed by triangles
  Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor> uv;  ///< |V| x 2, v down as in pictures
  /// Name -> vertices whose mean the landmark is (data/canonical_landmarks.csv): the 68 iBUG points
  /// and the anatomical ones.
  std::map<std::string, std::vector<int>> landmarks;
  /// Rows of mesh.triangles that close the openings: 14, 14 and 18.
  std::vector<int> right_eye, left_eye, mouth;

  /// Position of a landmark on `vertices`, the mesh's own or moved ones.
  Vec3 landmark(const std::string& name, const Points& vertices) const;
};

/// Parsed at the first call, the same object ever after.
const CanonicalFace& canonical_face();

/// mesh.triangles without those that close the openings.
Triangles opened_triangles(const CanonicalFace& face);

/// The inner contours of an opening, closed walks of vertices in order around it.
const std::vector<int>& right_eye_contour();
const std::vector<int>& left_eye_contour();
const std::vector<int>& lip_contour();

/// Per vertex the one opposite the midplane; those on it are their own.
const std::vector<int>& mirrored_vertices();

/// The same landmark on the other side: "cheilion_L" -> "cheilion_R", "ibug68_48" -> "ibug68_54"; a
/// midline or unknown name is its own mirror.
std::string mirrored_landmark(const std::string& name);

}  // namespace hyperex::face
