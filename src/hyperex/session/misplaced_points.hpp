// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "hyperex/core/note.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/motion/motion.hpp"

namespace hyperex::session {

/// How well a recording's first sample fits the scan's landmarks of the same names after a
/// similarity.
struct Misfit {
  double rms_mm = 0, scale = 1;
  std::size_t common = 0;  ///< number of points compared
};

/// Points of a recording that lie elsewhere than the scan's landmarks of the same names, as far as
/// a difference between two people or two trackers cannot explain it.
struct MisplacedPoints {
  struct Point {
    std::string name;
    double off_m = 0;
    /// Two axes by whose exchange the point comes to its place: "x and y"; empty: none.
    std::string exchanged_axes = "";
    double off_exchanged_m = 0;  ///< as off_m, with these axes exchanged
  };
  std::vector<Point> points;  ///< the farthest first
  Misfit others;              ///< of the points that are not misplaced
};

/// Compares the first sample with the landmarks after a similarity that wrong points do not pull:
/// iteratively reweighted least squares with Cauchy's weights, from the best fit that leaves out
/// one point. A point is misplaced if two distances exceed max(8 mm, 4 x the median distance): its
/// own distance from its landmark, and that distance less the median of its three nearest
/// neighbours' (as vectors; none on the other lip), since faces differ smoothly from each other.
/// In place of 8 mm, 30 mm hold for points that trackers and people place differently (the outline
/// beside the chin, anatomical points that are no iBUG points), and where fewer than 20 points are
/// common. Points exchanged with their mirror images are not misplaced. Axes are named as exchanged
/// where that brings the point within max(8 mm, 4 x the median distance). Finds nothing where fewer
/// than six points are common.
MisplacedPoints misplaced_points(const motion::Motion& stabilised, const io::Landmarks& landmarks);

/// " (0.4 mm with its x and y exchanged)" where two axes of a point seem to be exchanged; else
/// empty.
std::string exchanged_axes_words(const MisplacedPoints::Point& point);

/// `recording.point_off`: names up to three misplaced points.
std::optional<Note> misplaced_warning(const MisplacedPoints& misplaced);

}  // namespace hyperex::session
