// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "hyperex/geometry/transform.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/render/image.hpp"
#include "hyperex/render/render.hpp"

namespace hyperex::tracking {

struct ScanLandmarkOptions {
  /// The directions from which the face is viewed, relative to its front: yaw to the subject's
  /// left, pitch upwards, degrees. Each view is evaluated twice, the second time as a mirror image.
  std::vector<std::pair<double, double>> views_deg = {{0, 0},  {-12, 0}, {12, 0}, {-25, 0},
                                                      {25, 0}, {0, 12},  {0, -12}};
  /// The approximate pose of the canonical face on the scan (to within about 20 degrees), if known.
  /// It saves the search from all directions, which takes most of the time. If no face is found
  /// there, the search is done all the same.
  std::optional<Similarity> scan_from_canonical;
  /// A view whose ray is this far (m) from the common point of all views has half the weight.
  double tolerance_m = 4e-3;
};

struct ScanLandmarks {
  io::Landmarks landmarks;  ///< all landmarks of face::CanonicalFace, on the scan's surface, m
  Points face_points;       ///< 468 x 3: the vertices of the canonical face on the surface, m
  /// The pose of the canonical face on the scan. The columns of its rotation are the left, up and
  /// front directions of the face.
  Similarity scan_from_canonical;
  int views = 0;                 ///< number of pictures in which the face was found
  double score = 0;              ///< score of the network, mean over those views, 0 to 1
  double spread_m = 0;           ///< median distance of a view's ray from the common point
  bool without_colours = false;  ///< with the scan's colours no face was found
};

/// Finds the landmarks of a face scan. The scan may have any orientation and needs no colour. The
/// face is found (find_front.hpp) and rendered from several directions, and the landmark network
/// (LandmarkTracker) gives 468 points in each picture. For each point, the position closest to all
/// its rays is computed by least squares; the weight of a view decreases with the distance of its
/// ray and with the inclination of the surface. The closest point of the surface is the result, for
/// a lid whose inner side that is, the edge in front of it (up to 4 mm aside). The same scan always
/// gives the same result. Where colours hide the face, it is looked for without them. Throws
/// InputError, naming `source`, if no face is found.
ScanLandmarks find_scan_landmarks(const TriMesh& scan, const render::VertexColours& colours,
                                  const std::string& source,
                                  const ScanLandmarkOptions& options = {});

/// Colours of a scan's vertices for rendering: its vertex colours, else those of its texture at the
/// vertices; empty if it has neither.
render::VertexColours picture_colours(const io::Scan& scan);

/// What pictures of the landmarks must show, m: the face's points, and the scan above them up to 60
/// mm, where the forehead ends, no wider or deeper than they are.
Points pictured_points(const TriMesh& scan, const ScanLandmarks& found);

/// Draws the scan from the front and from both sides, with the landmarks marked.
render::Image draw_scan_landmarks(const TriMesh& scan, const render::VertexColours& colours,
                                  const ScanLandmarks& found, const std::string& title);

}  // namespace hyperex::tracking
