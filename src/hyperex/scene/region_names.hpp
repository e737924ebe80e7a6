// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

namespace hyperex::scene {

struct SidedName {
  std::string part;
  std::string side;  ///< "_L", "_R" or empty
};

/// "right_cheek", "cheek_right", "cheek_r" and "cheek_R" are cheek, "_R".
SidedName sided(std::string name);

/// `part` itself if it is known, else the nearest of `parts`: all are names without sides. Empty
/// where none is similar.
std::string nearest_part(const std::string& part, const std::vector<std::string>& parts);

/// The region of the face (tissue::facial_regions()) that an unknown name was probably meant to be,
/// with the side that was given; a side is never guessed. "side", "half" and "head" are the face.
/// Empty for a region, and where none is similar. Quotes around the name are ignored.
std::string nearest_region(std::string name);

/// The end of a message on a field of the tissue, "; did you mean cheek_R?", where `key` names a
/// region, "region[0].name"; empty where no region is similar.
std::string did_you_mean_region(const std::string& key, const std::string& name);

}  // namespace hyperex::scene
