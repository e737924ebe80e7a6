// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/core/note.hpp"
#include "hyperex/scene/region_names.hpp"

namespace hyperex::session {

/// The existing name that an unknown name was probably meant to be. A side is never guessed:
/// "cheek_r" and "right_cheek" are cheek_R, "chek" is cheek. Empty where no name is similar.

using scene::did_you_mean_region;
using scene::nearest_region;

/// Among the landmarks that the canonical face knows; "ibug_48" and "48" are ibug68_48.
std::string nearest_landmark(const std::string& name);

/// The end of a message, "; did you mean cheilion_R?", with the most similar of the names that
/// exist; empty where none is similar. For the name of a landmark that is its other name alone, and
/// an iBUG point of another number is never meant.
std::string did_you_mean(const std::string& name, const std::vector<std::string>& there_are);

/// `landmarks.misspelt` for landmarks of unknown names that look misspelt, "... did you mean
/// cheilion_L?", one each, at most five; removes those names from `unknown`.
std::vector<Note> misspelt_landmarks(std::vector<std::string>& unknown);

}  // namespace hyperex::session
