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
  bool operator==(const Recipe&) const = default;
};

/// Reads TOML files with a table for each shape, in the order of the files:
///   [happy]
///   mouthSmileLeft = 0.8
///   mouthSmileRight = 0.8
/// A name is of letters, digits and underscores. One of ARKit's names replaces that shape. Weights
/// are those of ARKit's shapes but tongueOut, which moves nothing. Throws InputError where a file
/// cannot be read, has no shape, names a corrective (expression/correctives.hpp), where a shape or
/// a weight is not known, or where two files have a shape of the same name.
std::vector<Recipe> read_recipes(const std::vector<std::filesystem::path>& files);

/// The recipes without the weights of shapes that end in one of `sides` ("Right", "Left") and begin
/// with "eye": those of lids and gaze.
std::vector<Recipe> without_eyes(std::vector<Recipe> recipes,
                                 const std::vector<std::string>& sides);

/// A name of ARKit's that the user may have meant by the recipe's, as mouthSmileLeft for
/// mouthSmileleft; empty where it is one of ARKit's or like none of them.
std::string probably_meant(const Recipe& recipe);

}  // namespace hyperex::rig
