// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace hyperex::rig {

/// A shape of the user's own: an expression that is simulated as one, like ARKit's shapes.
struct Recipe {
  std::string name;
  std::vector<std::pair<std::string, double>> weights;  ///< of ARKit's shapes, 0 to 1.5
};

/// Reads a TOML file with a table for each shape, in the order of the file:
///   [happy]
///   mouthSmileLeft = 0.8
///   mouthSmileRight = 0.8
/// A name is of letters, digits and underscores. One of ARKit's names replaces that shape. Weights
/// are those of ARKit's shapes but tongueOut, which moves nothing. Throws InputError where the file
/// cannot be read, has no shape, names a corrective (expression/correctives.hpp), or where a shape
/// or a weight is not known.
std::vector<Recipe> read_recipes(const std::filesystem::path& file);

}  // namespace hyperex::rig
