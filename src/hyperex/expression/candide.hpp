// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <filesystem>
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::expression {

/// A unit as the file lists it. If a vertex is listed more than once, its displacements are added.
struct CandideUnit {
  std::string name;           ///< the comment above it
  std::vector<int> vertices;  ///< 0-based, in the file's order
  Points displacement;        ///< one row per entry, model units
};

/// A wireframe face of the CANDIDE family as stored in its .wfm file: +x to the subject's left, y
/// up, z forward, lengths in model units.
struct CandideFile {
  TriMesh mesh;
  std::vector<CandideUnit> animation_units, shape_units;
  Eigen::VectorXd animation_parameters, shape_parameters;             ///< one per unit
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> texture;  ///< |V| x 2 or empty
};

/// The sections of the file, in this order, each after a comment line with its name: VERTEX LIST,
/// FACE LIST, ANIMATION UNITS LIST, SHAPE UNITS LIST and, optionally, ANIMATION PARAMETERS, SHAPE
/// PARAMETERS, TEXTURE, END OF FILE. A section begins with the number of its items. A unit begins
/// with "# name" and the number of its entries "vertex dx dy dz". Throws InputError naming the line
/// if a section is missing or out of order, if there are too few or too many lines, if a number or
/// a count is invalid, if a vertex is out of range, or if a face uses a vertex twice.
CandideFile read_candide(const std::filesystem::path& file);

}  // namespace hyperex::expression
