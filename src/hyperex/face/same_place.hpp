// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::face {

/// Whether two different names mean the same place of a face: the anatomical name of one of the 68
/// iBUG points, as cheilion_R and ibug68_48.
bool same_place(const std::string& a, const std::string& b);

/// The other name of a landmark's place, as ibug68_48 of cheilion_R; empty where it has none.
std::string other_name(const std::string& name);

/// Where a landmark is, under this name or else the other of its place; none where neither is given
/// or finite.
std::optional<Vec3> find_place(const io::Landmarks& landmarks, const std::string& name);

}  // namespace hyperex::face
