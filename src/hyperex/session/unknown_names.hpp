// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/core/note.hpp"

namespace hyperex::session {

/// What a name that does not exist was probably meant to be, in the spelling that exists. A side is
/// never guessed: "cheek_r" and "right_cheek" are cheek_R, "chek" is cheek. Empty where nothing is
/// alike.

/// Of the regions of the face (tissue::facial_regions); empty for one of them. Quotes around the
/// name, as problems show it, are put up with.
std::string nearest_region(std::string name);

/// Of the landmarks that the canonical face knows; "ibug_48" and "48" are ibug68_48.
std::string nearest_landmark(const std::string& name);

/// "; did you mean cheilion_R?" of the names that there are, to end a message; empty where none is
/// alike.
std::string did_you_mean(const std::string& name, const std::vector<std::string>& there_are);

/// `landmarks.misspelt` for landmarks of unknown names that look misspelt, "... did you mean
/// cheilion_L?", one each, at most five; those names are taken out of `unknown`.
std::vector<Note> misspelt_landmarks(std::vector<std::string>& unknown);

}  // namespace hyperex::session
