// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

namespace hyperex::face {

/// The name of a point in plain words, for display. "ibug68_54" gives "corner of the mouth, left";
/// "cheilion_L" gives "corner of the mouth (cheilion), left". The name of a pair ("ibug68_48/54",
/// "cheilion") gives no side. All 68 iBUG points and the anatomical landmarks of canonical_face()
/// have different words. In any other name, underscores are replaced by spaces. Sides are the
/// subject's own.
std::string point_words(const std::string& name);

/// The name with its words, for messages: "ibug68_54 (corner of the mouth, left)", "cheilion_L
/// (corner of the mouth, left)". `more` follows the words, or stands alone where there are none:
/// "ibug68_8 (chin; 3.1 mm)", "head_1 (3.1 mm)". Names of no known landmark have no words.
std::string name_in_words(const std::string& name, const std::string& more = "");

}  // namespace hyperex::face
