// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::face {

/// Whether two different names denote the same landmark: an iBUG point and its anatomical name,
/// such as ibug68_48 and cheilion_R.
bool same_place(const std::string& a, const std::string& b);

/// The other name of a landmark, such as ibug68_48 for cheilion_R; empty if it has none.
std::string other_name(const std::string& name);

/// The number of the iBUG point at this place: 48 for ibug68_48, for its short names "48" and
/// "p48", and for cheilion_R; nothing where there is none.
std::optional<int> ibug_number_of_place(const std::string& name);

/// One name for each place: "ibug68_36" for "36", "p36", "ibug68_36" and "exocanthion_R". Names of
/// places that iBUG does not have are unchanged.
std::string place_name(const std::string& name);

/// The position of a landmark under this name or under its other name; nothing if neither is given
/// with finite coordinates.
std::optional<Vec3> find_place(const io::Landmarks& landmarks, const std::string& name);

}  // namespace hyperex::face
