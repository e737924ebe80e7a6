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
  /// The sides from which the face is seen, about its own front: yaw to the subject's left, pitch
  /// upwards, degrees. Each is looked at twice, the second time in the mirror.
  std::vector<std::pair<double, double>> views_deg = {{0, 0},  {-12, 0}, {12, 0}, {-25, 0},
                                                      {25, 0}, {0, 12},  {0, -12}};
  /// Where it is known roughly how the canonical face lies on the scan (within some 20 degrees):
  /// most of the work is to look for it from all sides, which is done where none is found there.
  std::optional<Similarity> scan_from_canonical;
  /// A view whose point is so far from where the others see it counts half, m.
  double tolerance_m = 4e-3;
};

struct ScanLandmarks {
  io::Landmarks landmarks;  ///< all that face::CanonicalFace names, on the scan's surface, m
  Points face_points;       ///< 468 x 3: the canonical face's vertices on the surface, m
  /// How the canonical face lies on the scan: columns of its rotation are the face's left, up,
  /// front.
  Similarity scan_from_canonical;
  int views = 0;        ///< pictures in which the face was seen
  double score = 0;     ///< the network's, mean of those views, 0 to 1
  double spread_m = 0;  ///< median distance of a view's point from what all agree on
};

/// Finds the landmarks of a face scan, which may be turned in any way and needs no colour: the face
/// is found (find_front.hpp), seen from several sides and there given 468 points each by the
/// landmark network (LandmarkTracker); every point is brought to where its rays come nearest to
/// each other (least squares, a view's weight falling with its distance and with the slant of the
/// surface), and from there to the nearest place of the surface. Same scan, same answer. Throws
/// InputError, naming `source`, where no face is found.
ScanLandmarks find_scan_landmarks(const TriMesh& scan, const render::VertexColours& colours,
                                  const std::string& source,
                                  const ScanLandmarkOptions& options = {});

/// Colours of a scan's vertices for pictures: its own, else those of its texture at the vertices;
/// empty where it has neither.
render::VertexColours picture_colours(const io::Scan& scan);

/// The scan from the front and from both sides with the landmarks marked.
render::Image draw_scan_landmarks(const TriMesh& scan, const render::VertexColours& colours,
                                  const ScanLandmarks& found, const std::string& title);

}  // namespace hyperex::tracking
