// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/face/canonical_face.hpp"
#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::anatomy {

// The canonical face itself is in the room face, because tracking uses it too.
using face::canonical_face;
using face::CanonicalFace;
using face::left_eye_contour;
using face::lip_contour;
using face::mirrored_landmark;
using face::right_eye_contour;

/// The face that is used where no scan is given.
struct EmbeddedFace {
  TriMesh mesh;             ///< metres
  io::Landmarks landmarks;  ///< all of CanonicalFace::landmarks, on the mesh
  /// |V| x 2: texture coordinates of the vertices, in the same picture as CanonicalFace::uv; v
  /// points down.
  Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor> uv;
};

/// The canonical face with eyes and mouth opened, refined by two rounds of Loop's subdivision (C.
/// T. Loop, 1987; borders as cubic B-splines) to about 7,000 vertices. The subdivided surface
/// nearly passes through the canonical vertices: its control mesh is corrected for the shrinkage.
/// Its lips, 5.5 mm apart there, are closed (face/close_lips.hpp).
EmbeddedFace embedded_face();

}  // namespace hyperex::anatomy
