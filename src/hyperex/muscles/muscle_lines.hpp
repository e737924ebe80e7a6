// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/io/landmarks.hpp"
#include "hyperex/muscles/muscle_template.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::muscles {

/// A muscle of one side on one face.
struct MuscleLine {
  std::string name;         ///< "zyg_major_L"
  int row = 0;              ///< of the template
  bool left = true;         ///< the subject's
  Points line;              ///< n x 3, m, scan frame: from origin to insertion
  std::vector<double> arc;  ///< of each point: arc length from the origin, m
  double scale = 1;         ///< of the face's size over the template's
};

/// Size of a face over that of the template's: by the distance of the outer eye corners.
double scale_of(const io::Landmarks& landmarks);

/// Arc length of a line (n x 3) from its first point to each, m.
std::vector<double> arc_of(const Points& line);

/// The template laid on a face, left and right of each in turn. Places are carried by their
/// landmarks, offsets turned and scaled with the face; the path is straight between places, laid on
/// the skin, then sunk by its depth into the tissue. `landmarks`: the 68 iBUG points.
std::vector<MuscleLine> muscle_lines(const std::vector<TemplateMuscle>& muscles,
                                     const tissue::TissueMesh& mesh,
                                     const io::Landmarks& landmarks);

/// The point of a muscle's line nearest to `p`.
struct OnLine {
  double distance_m = 0;
  double share = 0;              ///< of the way from origin (0) to insertion (1)
  Vec3 tangent = Vec3::UnitX();  ///< towards the insertion, unit length
};
OnLine nearest_on_line(const MuscleLine& muscle, const Vec3& p);

}  // namespace hyperex::muscles
