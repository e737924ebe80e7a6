// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

namespace hyperex::face {

/// A point's name as people read it; files keep the name itself. "ibug68_54" is "corner of the
/// mouth, left", "cheilion_L" is "corner of the mouth (cheilion), left", a pair of both sides
/// ("ibug68_48/54", "cheilion") has no side. All 68 iBUG points and the anatomical landmarks of
/// canonical_face() are known, each in words of its own; any other name comes back with its
/// underscores as spaces. Sides are the subject's own.
std::string point_words(const std::string& name);

}  // namespace hyperex::face
