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
  int row = 0;              ///< index of the muscle in the template
  bool left = true;         ///< whether it is on the subject's left side
  Points line;              ///< n x 3, m, scan frame: from origin to insertion
  std::vector<double> arc;  ///< arc length of each point from the origin, m
  double scale = 1;         ///< size of the face divided by that of the template's face
};

/// Size of a face divided by that of the template's face, from the distance between the outer eye
/// corners.
double scale_of(const io::Landmarks& landmarks);

/// Arc length of a line (n x 3) from its first point to each, m.
std::vector<double> arc_of(const Points& line);

/// The template's muscles on a face; each muscle gives two entries, left and right. Places follow
/// their landmarks; offsets are rotated and scaled with the face. Between places the path is
/// straight, projected onto the skin, then moved into the tissue by its depth. `landmarks`: the 68
/// iBUG points.
std::vector<MuscleLine> muscle_lines(const std::vector<TemplateMuscle>& muscles,
                                     const tissue::TissueMesh& mesh,
                                     const io::Landmarks& landmarks);

/// The point of a muscle's line nearest to `p`.
struct OnLine {
  double distance_m = 0;
  double share = 0;              ///< share of the arc length: origin 0, insertion 1
  Vec3 tangent = Vec3::UnitX();  ///< towards the insertion, unit length
};
OnLine nearest_on_line(const MuscleLine& muscle, const Vec3& p);

}  // namespace hyperex::muscles
