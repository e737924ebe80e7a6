// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <filesystem>
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::expression {

/// A unit as the file lists it. A vertex may be listed twice: its displacements then add up.
struct CandideUnit {
  std::string name;           ///< the comment above it
  std::vector<int> vertices;  ///< 0-based, in the file's order
  Points displacement;        ///< one row per entry, model units
};

/// A wireframe face of the CANDIDE family as its .wfm file holds it: y up, z forward, +x the
/// subject's left, lengths in units of the model.
struct CandideFile {
  TriMesh mesh;
  std::vector<CandideUnit> animation_units, shape_units;
  Eigen::VectorXd animation_parameters, shape_parameters;             ///< one per unit
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> texture;  ///< |V| x 2 or empty
};

/// Sections in this order, each after a comment line with its name: VERTEX LIST, FACE LIST,
/// ANIMATION UNITS LIST, SHAPE UNITS LIST, and, where present, ANIMATION PARAMETERS, SHAPE
/// PARAMETERS, TEXTURE, END OF FILE. A section begins with its count; a unit with "# name" and the
/// number of its entries "vertex dx dy dz". Throws InputError naming the line: a section missing or
/// out of order, too few or too many lines, words that are no numbers, a vertex out of range, a
/// face that uses a vertex twice, a count that is none.
CandideFile read_candide(const std::filesystem::path& file);

}  // namespace hyperex::expression
